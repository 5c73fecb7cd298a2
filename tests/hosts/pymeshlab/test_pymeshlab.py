# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin inside PyMeshLab, as its users drive it. Run by the Python that has PyMeshLab."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree

import numpy
import pymeshlab
import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from host import (FILTER, PLUGIN, PLUGINS, SAMPLES, SCRIPTS, VERSION, content, load, meshes, refused,  # noqa: E402
                  set_of)
import display  # noqa: E402
import plyfile  # noqa: E402
from filter_parameters import page_rows  # noqa: E402


def remesh(name, **parameters):
    ms = load(name)
    out = ms.apply_filter(FILTER, **parameters)
    return ms, out


def command_line(source, tmp_path, *options):
    out, report = str(tmp_path / "c.ply"), str(tmp_path / "c.json")
    subprocess.run([os.environ["CCDM_REMESH"], source, out, *map(str, options), "--quiet", "--report", report],
                   check=True)
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(out)
    return content(ms), json.load(open(report, encoding="utf-8"))


@pytest.mark.parametrize("name, euler", [("bumpy", 2), ("cad_part", -2), ("plate", None), ("two_components", 2)])
def test_figures_agree_with_the_hosts_own_measures(name, euler):
    ms, out = remesh(name, vertex_count=1200, global_iterations=8)
    assert out["vertex_number"] == ms.current_mesh().vertex_number() == 1200
    assert out["face_number"] == ms.current_mesh().face_number()
    topology = ms.get_topological_measures()
    assert topology["is_mesh_two_manifold"] and topology["unreferenced_vertices"] == 0
    own = topology["vertices_number"] - topology["edges_number"] + topology["faces_number"]
    assert out["euler_characteristic_after"] == out["euler_characteristic_before"] == own
    assert euler is None or own == euler
    assert out["components"] == topology["connected_components_number"]
    assert out["boundary_loops"] == topology["number_holes"]
    assert out["topology_preserved"] is True and out["target_met"] is True
    geometry = ms.get_geometric_measures()
    assert out["mean_edge_length"] == pytest.approx(geometry["avg_edge_length"], rel=1e-6)
    assert out["surface_area"] == pytest.approx(geometry["surface_area"], rel=1e-6)
    ways = [ms.get_hausdorff_distance(sampledmesh=a, targetmesh=1 - a, samplevert=True, sampleface=True,
                                      sampleedge=True, samplenum=100000) for a in (0, 1)]
    diagonal = ms.mesh(0).bounding_box().diagonal()
    assert out["hausdorff"] == pytest.approx(max(w["max"] for w in ways) / diagonal, rel=0.1)


@pytest.mark.parametrize("name", ["bumpy", "cad_part"])
def test_angles_agree_with_numpy(name):
    ms, out = remesh(name, vertex_count=900, global_iterations=5)
    points, faces = content(ms)
    corner = points[faces]
    angles = []
    for k in range(3):
        a, b = corner[:, (k + 1) % 3] - corner[:, k], corner[:, (k + 2) % 3] - corner[:, k]
        cosine = (a * b).sum(1) / numpy.linalg.norm(a, axis=1) / numpy.linalg.norm(b, axis=1)
        angles.append(numpy.degrees(numpy.arccos(cosine)))
    angles = numpy.array(angles)
    assert out["smallest_angle"] == pytest.approx(angles.min(), abs=1e-6)
    assert out["largest_angle"] == pytest.approx(angles.max(), abs=1e-6)
    assert out["average_smallest_angle"] == pytest.approx(angles.min(0).mean(), abs=1e-6)
    assert out["percent_angles_below_30"] == pytest.approx(100 * (angles < 30).mean(), abs=1e-9)
    assert out["triangles_below_min_angle"] == (angles.min(0) < 40 - 1e-9).sum()
    edges = [numpy.linalg.norm(corner[:, (k + 1) % 3] - corner[:, k], axis=1) for k in range(3)]
    area = numpy.linalg.norm(numpy.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2
    shape = 2 * math.sqrt(3) * area / (sum(edges) / 2 * numpy.max(edges, 0))
    assert out["average_aspect_ratio"] == pytest.approx(shape.mean(), abs=1e-9)
    assert out["smallest_aspect_ratio"] == pytest.approx(shape.min(), abs=1e-9)


@pytest.mark.parametrize("parameters, options", [
    ({}, ()), ({"density": "Curvature", "seed": 7}, ("--density", "curvature", "--seed", 7)),
    ({"feature_angle": 180, "lambda_": 0.35, "local_iterations": 2},
     ("--feature-angle", 180, "--lambda", 0.35, "--local-iterations", 2)),
    ({"optimizer": "Annealing"}, ("--optimizer", "annealing", "--sampler", "random")),
    ({"optimizer": "Annealing", "global_iterations": 12, "min_angle": 30},
     ("--optimizer", "annealing", "--sampler", "random", "--global-iterations", 12, "--min-angle", 30)),
    ({"approximation": 0.8, "min_angle": 30}, ("--approximation", 0.8, "--min-angle", 30))])
def test_equals_the_command_line(tmp_path, parameters, options):
    source = os.path.join(SAMPLES, "cad_part.ply")
    ms, out = remesh("cad_part", vertex_count=700, **parameters)
    points, faces = content(ms)
    (other_points, other_faces), report = command_line(source, tmp_path, "-n", 700, *options)
    assert numpy.array_equal(faces, other_faces)
    assert numpy.abs(points - other_points).max() <= 1e-6 * numpy.ptp(points)
    result = report["result"]
    for key, name in [("vertex_number", "vertices"), ("face_number", "faces"), ("average_smallest_angle", "angle_min_avg"),
                      ("smallest_angle", "angle_min"), ("percent_angles_below_30", "pct_lt30"), ("rms", "rms"),
                      ("average_aspect_ratio", "q_fb99_avg"), ("percent_valence_6", "pct_valence6"),
                      ("hausdorff", "hausdorff"), ("euler_characteristic_after", "euler"),
                      ("mean_edge_length", "mean_edge_length"), ("extra_vertices", "extra_vertices")]:
        assert out[key] == pytest.approx(result[name], rel=1e-4, abs=1e-9), key
    assert out["energy_before"] == pytest.approx(report["energy"][0])
    assert out["energy"] == pytest.approx(report["energy"][-1])
    assert out["iterations"] == len(report["energy"]) - 1 and out["iterations_accepted"] == report["accepted"]
    assert out["warnings"] == len(report["warnings"])


def test_three_hosts_give_one_mesh(tmp_path):
    """Command line, meshlabserver 2020.09 (single precision), PyMeshLab (double)."""
    source = os.path.join(SAMPLES, "bumpy.ply")
    document = tree.parse(os.path.join(SCRIPTS, "ccdm_uniform.mlx"))
    for parameter in document.getroot().iter("Param"):
        parameter.set("value", {"vertex_count": "1500", "seed": "3"}.get(parameter.get("name"), parameter.get("value")))
    script, served = tmp_path / "s.mlx", tmp_path / "s.ply"
    script.write_bytes(b"<!DOCTYPE FilterScript>\n" + tree.tostring(document.getroot()))
    server = os.path.join(os.environ["CCDM_HOST"], "bin", "meshlabserver")
    environment = {k: v for k, v in display.environment().items() if k != "LD_LIBRARY_PATH"}
    subprocess.run([server, "-i", source, "-s", script, "-o", served], check=True, timeout=240,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(served))
    results = [content(ms), command_line(source, tmp_path, "-n", 1500, "--seed", 3)[0],
               content(remesh("bumpy", vertex_count=1500, seed=3)[0])]
    for points, faces in results[1:]:
        assert numpy.array_equal(faces, results[0][1])
        assert numpy.abs(points - results[0][0]).max() <= 1e-6 * numpy.ptp(points)


def test_numpy_arrays_in_and_out():
    n = 24
    u, v = numpy.meshgrid(numpy.linspace(0, 1, n), numpy.linspace(0, 1, n), indexing="ij")
    points = numpy.column_stack([u.ravel(), v.ravel(), 0.1 * numpy.sin(6 * u.ravel())])
    a = (numpy.arange(n - 1)[:, None] * n + numpy.arange(n - 1)).ravel()
    faces = numpy.vstack([numpy.column_stack([a, a + n, a + n + 1]), numpy.column_stack([a, a + n + 1, a + 1])])
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(points, faces), "sheet")
    out = ms.apply_filter(FILTER, vertex_count=300)
    new_points, new_faces = content(ms)
    assert new_points.shape == (300, 3) and new_points.dtype == numpy.float64
    assert new_faces.shape == (out["face_number"], 3) and new_faces.min() == 0 and new_faces.max() == 299
    assert out["boundary_loops"] == 1 and out["euler_characteristic_after"] == 1
    assert numpy.allclose(new_points.min(0)[:2], 0, atol=1e-9) and numpy.allclose(new_points.max(0)[:2], 1, atol=1e-9)


def test_new_layer_or_in_place():
    ms, _ = remesh("sphere", vertex_count=500)
    assert meshes(ms) == 2 and ms.current_mesh_id() == 1 and ms.current_mesh().vertex_number() == 500
    ms.set_current_mesh(0)
    assert all(numpy.array_equal(a, b) for a, b in zip(content(ms), content(load("sphere"))))
    if hasattr(ms.current_mesh(), "label"):
        assert ms.mesh(1).label() == "sphere_ccdm"
    ms, _ = remesh("sphere", vertex_count=500, new_layer=False)
    assert meshes(ms) == 1 and ms.current_mesh().vertex_number() == 500
    normals = ms.current_mesh().face_normal_matrix()
    assert numpy.allclose(numpy.linalg.norm(normals, axis=1), 1)


def test_transform_goes_to_the_new_layer():
    ms = load("sphere")
    ms.set_matrix(transformmatrix=numpy.diag([2.0, 3.0, 4.0, 1.0]), freeze=False)
    ms.apply_filter(FILTER, vertex_count=300)
    assert numpy.ptp(content(ms)[0][:, 2]) < 2.01, "the points stay as they are"
    if hasattr(ms.current_mesh(), "transform_matrix"):
        assert numpy.allclose(ms.current_mesh().transform_matrix(), numpy.diag([2.0, 3.0, 4.0, 1.0]))


def test_default_count_is_the_current_one():
    ms, out = remesh("two_components", global_iterations=2)
    assert out["vertex_number"] == ms.mesh(0).vertex_number()


def test_other_targets():
    ms, out = remesh("bumpy", edge_length=4, global_iterations=6)
    assert out["target_met"]
    wanted = 0.04 * ms.mesh(0).bounding_box().diagonal()
    assert ms.get_geometric_measures()["avg_edge_length"] == pytest.approx(wanted, rel=0.021)
    _, out = remesh("cad_part", max_error=0.6)
    assert out["target_met"] and 0 < out["hausdorff"] <= 0.00606


def test_selected_edges():
    points, faces = plyfile.box()
    def run(select, **parameters):
        ms = set_of(numpy.array(points, float), numpy.array(faces))
        if select:
            ms.compute_selection_crease_per_edge(angledegneg=-60, angledegpos=60)
        return ms.apply_filter(FILTER, vertex_count=400, global_iterations=3, **parameters)
    assert run(False)["feature_curves"] == 12 and run(False)["feature_corners"] == 8
    assert run(False, feature_angle=100)["feature_curves"] == 0
    assert run(True, feature_angle=100)["feature_curves"] == 0
    assert run(True, feature_angle=100, selected_edges="With the angle")["feature_curves"] == 12
    assert run(True, selected_edges="Instead of the angle")["feature_curves"] == 12
    assert run(False, selected_edges="Instead of the angle")["feature_curves"] == 0


def test_density_from_vertex_quality():
    ms = load("sphere")
    points, faces = content(ms)
    quality = numpy.where(points[:, 2] > 0, 4.0, 1.0)
    ms = set_of(points, faces, v_scalar_array=quality)
    ms.apply_filter(FILTER, vertex_count=1500, density="Vertex quality")
    upper = (content(ms)[0][:, 2] > 0).mean()
    assert 0.7 < upper < 0.87, "four times as many vertices above as below"


@pytest.mark.parametrize("parameters, reason", [
    ({"vertex_count": 3}, "vertex_count must lie between 4"), ({"vertex_count": -5}, "vertex_count must lie"),
    ({"feature_angle": 0}, "feature_angle must lie"), ({"feature_angle": 181}, "feature_angle must lie"),
    ({"lambda_": math.nan}, "lambda must lie"), ({"lambda_": math.inf}, "lambda must lie"),
    ({"global_iterations": -2}, "global_iterations must lie"), ({"local_iterations": 0}, "local_iterations must lie"),
    ({"min_angle": 46}, "min_angle must lie"), ({"min_angle": -0.5}, "min_angle must lie"),
    ({"approximation": -0.1}, "approximation must lie"),
    ({"seed": -1}, "seed must lie"), ({"edge_length": -1}, "edge_length must lie"),
    ({"max_error": 101}, "max_error must lie"), ({"edge_length": 1, "max_error": 1}, "only one of them"),
    ({"density": "Vertex quality"}, "the layer has no vertex quality")])
@pytest.mark.parametrize("new_layer", [True, False])
def test_wrong_values_are_refused_with_the_reason(parameters, reason, new_layer):
    ms = load("two_components")
    refused(ms, "CCDM remeshing was not done: .*" + reason, new_layer=new_layer, **parameters)
    assert ms.apply_filter(FILTER, vertex_count=200, global_iterations=1)["vertex_number"] == 200


@pytest.mark.parametrize("parameters", [{"density": "Dense"}, {"density": 3}, {"optimizer": -1},
                                        {"vertex_count": "many"}, {"vertex_count": 2.5}, {"new_layer": "x y"},
                                        {"lambda_": None}])
def test_wrong_types_are_refused_by_the_host(parameters):
    ms = load("two_components")
    with pytest.raises(Exception):
        ms.apply_filter(FILTER, **parameters)
    assert meshes(ms) == 1


BAD = {
    "fin": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)], [(0, 1, 2), (1, 0, 3), (0, 1, 4)],
            "1 edge has more than two faces"),
    "bow tie": ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, -1, 0)], [(0, 1, 2), (0, 3, 4)],
                "1 vertex"),
    "double": ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 2)], "."),
    "not a number": ([(0, 0, 0), (1, 0, math.nan), (0, 1, 0)], [(0, 1, 2)], "1 vertex"),
    "infinite": ([(0, 0, 0), (1, 0, math.inf), (0, math.inf, 0)], [(0, 1, 2)], "2 vertices"),
    "flat to a point": ([(1, 1, 1)] * 3, [(0, 1, 2)], "."),
}


@pytest.mark.parametrize("name", sorted(BAD))
def test_bad_input_is_refused_with_the_reason(name):
    points, faces, reason = BAD[name]
    ms = set_of(numpy.array(points, float), numpy.array(faces))
    refused(ms, "CCDM remeshing was not done: .*" + reason, vertex_count=50)


def test_what_is_no_surface_is_cut_apart_on_request():
    points = numpy.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)], float)
    faces = numpy.array([(0, 1, 2), (1, 0, 3), (0, 1, 4)])
    refused(set_of(points, faces), "1 edge has more than two faces: vertices 0-1", vertex_count=60)
    ms = set_of(points, faces)
    out = ms.apply_filter(FILTER, vertex_count=60, repair="Cut apart")
    assert out["topology_preserved"] and out["components"] == 3 and out["vertex_number"] == 60
    assert out["euler_characteristic_before"] == out["euler_characteristic_after"] == 3


def test_soup_is_sewn_and_crossings_are_counted():
    points, faces = content(load("cad_part"))
    ms = set_of(points[faces].reshape(-1, 3), numpy.arange(3 * len(faces)).reshape(-1, 3))
    out = ms.apply_filter(FILTER, vertex_count=2000)
    assert out["topology_preserved"] and out["components"] == 1 and out["boundary_loops"] == 0
    assert out["crossing_pairs_before"] == out["crossing_pairs_after"] == 0
    out = load("klein_bottle").apply_filter(FILTER, vertex_count=2000)
    assert out["crossing_pairs_before"] > 10 and out["crossing_pairs_after"] > 10
    assert out["faces_in_new_crossings"] == 0


def test_bad_density_is_refused_with_the_count():
    points, faces = content(load("sphere"))
    quality = numpy.ones(len(points))
    quality[:3] = -1
    quality[3] = math.nan
    ms = set_of(points, faces, v_scalar_array=quality)
    refused(ms, r"\b4 ", vertex_count=50, density=2)


def test_empty_set_and_points_are_refused():
    ms = pymeshlab.MeshSet()
    with pytest.raises(pymeshlab.PyMeshLabException):
        ms.apply_filter(FILTER)
    ms.add_mesh(pymeshlab.Mesh(numpy.eye(3)))
    with pytest.raises(pymeshlab.PyMeshLabException):
        ms.apply_filter(FILTER)


def test_several_sets_at_once():
    """In a process of its own: after a failure PyMeshLab leaves its output redirected, which threads do not bear."""
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "threads.py")
    run = subprocess.run([sys.executable, program, PLUGIN, os.path.join(SAMPLES, "two_components.ply")],
                         capture_output=True, text=True, timeout=240, check=False)
    assert run.returncode == 0 and run.stdout.split()[-2:] == ["60", "equal"], run.stdout + run.stderr


def test_the_hosts_own_examples_pass_with_the_plugin_loaded(tmp_path):
    """A copy of them, as they write beside themselves. Left out: one that counts the plugins, and those that end the
    process without a display, with or without this plugin."""
    left_out = ["number_plugins", "texture_map_defragmentation", "u3d"]
    if VERSION < "2023":
        left_out.append("ambient_occlusion")
    copy = str(tmp_path / "host_tests")
    shutil.copytree(os.path.join(os.path.dirname(pymeshlab.__file__), "tests"), copy)
    with open(tmp_path / "ccdm_loaded.py", "w", encoding="utf-8") as out:
        out.write(f"import pymeshlab\npymeshlab.load_plugin({PLUGIN!r})\n")
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "ccdm_loaded", copy,
         "-o", "python_files=example_*.py test_*.py", "-o", "python_functions=example_* test_*",
         "-k", "not " + " and not ".join(left_out)],
        cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path)}, capture_output=True, text=True, timeout=300,
        check=False)
    assert run.returncode == 0 and re.search(r"\b2\d passed", run.stdout), run.stdout[-3000:]


@pytest.mark.parametrize("name", sorted(n for n in os.listdir(SCRIPTS) if n.endswith(".mlx")))
def test_shipped_script_runs(name):
    ms = load("cad_part")
    ms.load_filter_script(os.path.join(SCRIPTS, name))
    ms.apply_filter_script()
    assert meshes(ms) == (2 if name == "ccdm_new_layer.mlx" else 1)
    count = ms.current_mesh().vertex_number()
    if name == "ccdm_selected_faces.mlx":
        assert 0 < ms.current_mesh().selected_face_number() < ms.current_mesh().face_number()
        return
    assert 178 < count < 3000 if name == "ccdm_max_error.mlx" else count == 5000


def test_script_equals_the_call():
    ms = load("cad_part")
    ms.load_filter_script(os.path.join(SCRIPTS, "ccdm_cad.mlx"))
    ms.apply_filter_script()
    other, _ = remesh("cad_part", vertex_count=5000, feature_angle=30, global_iterations=40)
    assert all(numpy.array_equal(a, b) for a, b in zip(content(ms), content(other)))


def test_page_has_the_hosts_names_types_and_defaults():
    """What the host itself lists for the filter, against PARAMETERS.md."""
    code = f"import pymeshlab; pymeshlab.load_plugin({PLUGIN!r}); pymeshlab.print_filter_parameter_list({FILTER!r})"
    listed = re.findall(r"^\s+(\w+) : (\w+) = (.*)$", subprocess.run([sys.executable, "-c", code], text=True, check=True,
                                                                     capture_output=True).stdout, re.M)
    rows = page_rows()
    types = {"RichInt": "int", "RichFloat": "float", "RichEnum": "str", "RichBool": "bool"}
    default = {"the current count": "8"}
    assert [(name, kind, value.lower()) for name, kind, value in listed] == \
        [(row[2].strip("`"), types[row[3]], default.get(row[5], row[5]).lower()) for row in rows]
    page = open(os.path.join(os.path.dirname(SCRIPTS), "PARAMETERS.md"), encoding="utf-8").read()
    keys = set(re.findall(r"`(\w+)`", page[page.index("## What PyMeshLab returns"):])) - {"apply_filter", "min_angle"}
    assert keys == set(remesh("two_components", vertex_count=100, global_iterations=1)[1])


@pytest.mark.parametrize("other", ["2020.09", "2022.02", "2025.07"])
def test_plugin_of_another_version_is_refused_politely(other):
    if other == VERSION:
        pytest.skip("this host's own")
    path = os.path.join(PLUGINS, other, "libfilter_ccdm.so")
    if not os.path.exists(path):
        pytest.skip("not built")
    code = f"""
import pymeshlab
before = pymeshlab.filter_list()
try:
    pymeshlab.load_plugin({path!r})
except pymeshlab.PyMeshLabException as error:
    print("refused:", error)
assert pymeshlab.filter_list() == before
ms = pymeshlab.MeshSet()
ms.create_cube()
pymeshlab.load_plugin({PLUGIN!r})
print("alive:", ms.apply_filter({FILTER!r}, vertex_count=50)["vertex_number"])
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert run.returncode == 0 and "refused:" in run.stdout and "alive: 50" in run.stdout, run.stdout + run.stderr


def test_filter_becomes_a_method():
    setattr(pymeshlab.MeshSet, FILTER, pymeshlab.bind_function(FILTER))
    assert load("sphere").meshing_isotropic_ccdm(vertex_count=200)["vertex_number"] == 200
    assert FILTER in pymeshlab.filter_list()


def test_log_when_verbose():
    code = f"""
import pymeshlab
pymeshlab.load_plugin({PLUGIN!r})
for turn in range(2):
    ms = pymeshlab.MeshSet(verbose=turn == 0)
    ms.create_cube()
    try:
        ms.apply_filter({FILTER!r}, vertex_count=1 if turn == 0 else 61)
    except pymeshlab.PyMeshLabException:
        del ms # its log must not be used by the next set
ms = pymeshlab.MeshSet(verbose=True)
ms.create_cube()
ms.apply_filter({FILTER!r}, vertex_count=60)
"""
    run = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                         timeout=120, check=False)
    assert run.returncode == 0, run.stdout
    lines = re.findall(r"^LOG: \d (?:CCDM: )?(.*)$", run.stdout, re.M)
    assert "vertex_count must lie between 4" in "".join(line for line in lines if "not done" in line)
    plan = next(i for i, line in enumerate(lines) if re.match("remeshing 8 vertices, 12 faces to 60 vertices", line))
    table = next(i for i, line in enumerate(lines) if line.split() == ["vertices", "8", "60"])
    assert plan < table
    assert not any("61" in line for line in lines), "the quiet one says nothing"
