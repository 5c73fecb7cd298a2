# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin inside MeshLab 2020.09's headless server, as scripts drive it."""
import math
import os
import re
import signal
import subprocess
import sys
import xml.etree.ElementTree as tree

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
import display  # noqa: E402
import plyfile  # noqa: E402

SCRIPTS = os.environ["CCDM_SCRIPTS"]
SAMPLES = os.environ["CCDM_SAMPLES"]
MESHES = os.path.join(os.environ.get("CCDM_SHARED", ""), "meshes")


def script_names():
    return sorted(n for n in os.listdir(SCRIPTS) if n.endswith(".mlx"))


def call_server(*arguments):
    server = os.path.join(os.environ["CCDM_HOST"], "bin", "meshlabserver")
    return subprocess.run([server, *map(str, arguments)], env=display.environment(), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=240, check=False)


def run_server(source, script, out, *extra):
    return call_server("-i", source, "-s", script, "-o", out, *extra)


def variant(tmp_path, **changes):
    """The uniform script with some values changed; None drops the parameter."""
    document = tree.parse(os.path.join(SCRIPTS, "ccdm_uniform.mlx"))
    element = document.getroot().find("filter")
    for parameter in list(element):
        value = changes.get(parameter.get("name"), "same")
        if value is None:
            element.remove(parameter)
        elif value != "same":
            parameter.set("value", str(value))
    path = tmp_path / "script.mlx"
    path.write_bytes(b"<!DOCTYPE FilterScript>\n" + tree.tostring(document.getroot()))
    return path


@pytest.mark.parametrize("name", script_names())
def test_shipped_script_runs(tmp_path, name):
    out = tmp_path / "o.ply"
    run = run_server(f"{SAMPLES}/cad_part.ply", os.path.join(SCRIPTS, name), out)
    assert run.returncode == 0, run.stdout[-2000:]
    if name == "ccdm_max_error.mlx":
        asked, reached = map(float, re.search(r"largest error \(% of the diagonal\): asked (\S+), reached (\S+) in",
                                              run.stdout).groups())
        assert asked == 0.5 and reached <= asked
    elif name == "ccdm_selected_faces.mlx":
        assert "topology of the remeshed part preserved" in run.stdout
        assert "mean edge length (% of the diagonal): asked 1.5, " in run.stdout and "(not met)" not in run.stdout
        return
    else:
        assert plyfile.count_ply(out)[0] == 5000
    assert "topology preserved (Euler characteristic -2" in run.stdout


def test_real_mesh(tmp_path):
    if not os.path.isdir(MESHES):
        pytest.skip("the real models are not at hand")
    for name in ("klein_bottle", "pig"):
        out = tmp_path / "o.ply"
        run = run_server(f"{MESHES}/{name}.ply", variant(tmp_path, vertex_count=2000, feature_angle=60), out)
        assert run.returncode == 0, run.stdout[-2000:]
        assert plyfile.count_ply(out)[0] == 2000
        assert "topology preserved" in run.stdout


def test_same_result_as_the_command_line(tmp_path):
    out, cli = tmp_path / "o.ply", tmp_path / "c.ply"
    assert run_server(f"{SAMPLES}/bumpy.ply", variant(tmp_path, vertex_count=1500, seed=3), out).returncode == 0
    subprocess.run([os.environ["CCDM_REMESH"], f"{SAMPLES}/bumpy.ply", cli, "-n", "1500", "--seed", "3", "--quiet"],
                   check=True)

    def faces(path):
        data = open(path, "rb").read()
        return data[-13 * plyfile.count_ply(path)[1]:]
    assert faces(out) == faces(cli), "same connectivity; positions differ by the host's single precision alone"


def test_density_curvature_and_in_place_or_new_layer(tmp_path):
    results = {}
    for density in (0, 1):
        for layer in ("true", "false"):
            out = tmp_path / "o.ply"
            run = run_server(f"{SAMPLES}/bumpy.ply", variant(tmp_path, vertex_count=800, global_iterations=3,
                                                             density=density, new_layer=layer), out)
            assert run.returncode == 0
            results[density, layer] = out.read_bytes()
    assert results[0, "true"] == results[0, "false"]
    assert results[0, "true"] != results[1, "true"]


@pytest.mark.parametrize("changes, reason", [
    ({"vertex_count": 0}, "vertex_count must lie between 4"), ({"vertex_count": 3}, "vertex_count must lie between 4"),
    ({"feature_angle": 0}, "feature_angle must lie"), ({"lambda": 7}, "lambda must lie"),
    ({"global_iterations": -2}, "global_iterations must lie between 0 and 1000000, or be -1, not -2"),
    ({"local_iterations": 0}, "local_iterations must lie"),
    ({"density": 2}, "no vertex quality"), ({"seed": -4}, "seed must lie"), ({"edge_length": -1}, "edge_length must lie"),
    ({"max_error": 200}, "max_error must lie"), ({"edge_length": 1, "max_error": 1}, "only one of them"),
    ({"selected_edges": 3}, "selected_edges must lie"), ({"boundary": 3}, "boundary must lie"),
    ({"selected_faces_only": "true"}, "no face is selected"), ({"optimizer": -1}, "optimizer must lie"),
    ({"approximation": 2}, "approximation must lie"), ({"min_angle": 50}, "min_angle must lie"),
    ({"min_angle": -2}, "min_angle must lie between 0 and 45, or be -1, not -2")])
def test_wrong_value_is_refused_with_the_reason(tmp_path, changes, reason):
    out = tmp_path / "o.ply"
    run = run_server(f"{SAMPLES}/sphere.ply", variant(tmp_path, **changes), out)
    assert run.returncode == 255
    assert "CCDM remeshing was not done" in run.stdout and reason in run.stdout
    assert not out.exists()


def test_missing_parameter_is_refused(tmp_path):
    run = run_server(f"{SAMPLES}/sphere.ply", variant(tmp_path, seed=None), tmp_path / "o.ply")
    assert run.returncode == -signal.SIGABRT, "the host's own assertion"
    assert not (tmp_path / "o.ply").exists()


def test_non_manifold_input_is_refused(tmp_path):
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
    source = plyfile.write_ply(str(tmp_path / "fin.ply"), points, [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
    run = run_server(source, variant(tmp_path, vertex_count=100), tmp_path / "o.ply")
    assert run.returncode == 255 and "1 edge has more than two faces" in run.stdout
    assert not (tmp_path / "o.ply").exists()


def test_no_mesh_is_refused(tmp_path):
    run = call_server("-s", os.path.join(SCRIPTS, "ccdm_uniform.mlx"), "-o", tmp_path / "o.ply")
    assert run.returncode == 255 and "there is no current layer" in run.stdout


@pytest.mark.parametrize("optimizer, plan", [
    (0, "accelerated optimizer, 14 x 3 iterations, lambda 0.2, smallest angle 40 deg"),
    (1, "annealing optimizer, 40 x 3 iterations, lambda 0.2, smallest angle 34 deg")])
def test_minus_one_is_what_the_optimizer_has(tmp_path, optimizer, plan):
    run = run_server(f"{SAMPLES}/sphere.ply", variant(tmp_path, vertex_count=300, optimizer=optimizer,
                                                      global_iterations=-1, min_angle=-1), tmp_path / "o.ply")
    assert run.returncode == 0 and plan in run.stdout


def test_edge_length_in_percent_of_the_diagonal(tmp_path):
    run = run_server(f"{SAMPLES}/sphere.ply", variant(tmp_path, edge_length=5, global_iterations=4), tmp_path / "o.ply")
    assert run.returncode == 0
    asked, reached = map(float, re.search(r"mean edge length \(% of the diagonal\): asked (\S+), reached (\S+) in",
                                          run.stdout).groups())
    assert asked == 5 and abs(reached / asked - 1) < 0.021


def test_log_before_and_after(tmp_path):
    run = run_server(f"{SAMPLES}/cad_part.ply", variant(tmp_path, vertex_count=800, selected_edges=1), tmp_path / "o.ply")
    lines = [m[1] for m in re.finditer(r"^LOG: \d CCDM: (.*)$", run.stdout, re.M)]
    assert lines[0] == "remeshing 178 vertices, 360 faces to 800 vertices; in place"
    assert "edges that turn by more than 40 deg and the selected edges (0 sides" in lines[1]
    assert "note: no face edge is selected" in lines
    table = {tuple(line.rsplit(None, 2)) for line in lines}
    assert ("vertices", "178", "800") in table and ("Euler characteristic", "-2", "-2") in table


def write_tube(path, n=24, m=9):
    """A tube with colours, quality and selection of its vertices, colours of its faces, and a texture strip around it
    whose ends meet in a seam."""
    with open(path, "w", encoding="ascii") as out:
        out.write(f"ply\nformat ascii 1.0\ncomment TextureFile strip.png\nelement vertex {n * m}\n")
        out.writelines(f"property float {k}\n" for k in "xyz")
        out.writelines(f"property uchar {k}\n" for k in ("red", "green", "blue", "alpha"))
        out.write(f"property float quality\nelement face {2 * n * (m - 1)}\nproperty list uchar int vertex_indices\n"
                  "property list uchar float texcoord\n")
        out.writelines(f"property uchar {k}\n" for k in ("red", "green", "blue", "alpha"))
        out.write("end_header\n")
        for j in range(m):
            for i in range(n):
                x, y, z = math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 2 * j / (m - 1)
                out.write(f"{x} {y} {z} {round(120 + 100 * x)} {round(120 + 100 * y)} {round(100 * z)} 255 "
                          f"{x + 2 * y + 3 * z}\n")
        for j in range(m - 1):
            for i in range(n):
                corner = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                for t in ((0, 1, 2), (0, 2, 3)):
                    out.write("3 " + " ".join(str(corner[k][1] * n + corner[k][0] % n) for k in t) + " 6 " + " ".join(
                        f"{corner[k][0] / n} {corner[k][1] / (m - 1)}" for k in t) + f" {10 * j} 0 0 255\n")
    return path


@pytest.mark.parametrize("new_layer", ["true", "false"])
def test_attributes_through_files(tmp_path, new_layer):
    source, out = write_tube(str(tmp_path / "tube.ply")), tmp_path / "o.ply"
    script = variant(tmp_path, vertex_count=500, feature_angle=100, global_iterations=3, new_layer=new_layer)
    run = run_server(source, script, out, "-m", "vc", "vq", "fc", "wt")
    assert run.returncode == 0, run.stdout[-2000:]
    assert re.search(r"carried: vertex colour, vertex quality, face colour, texture coordinates per wedge", run.stdout)
    assert "8 seam edges" in run.stdout
    assert b"TextureFile strip.png" in out.read_bytes()[:2000]
    mesh = plyfile.read_ply(out)
    vertices = mesh["vertex"]
    assert len(vertices) == 500
    for v in vertices:
        assert abs(v["quality"] - (v["x"] + 2 * v["y"] + 3 * v["z"])) < 1e-5
        assert abs(v["red"] - (120 + 100 * v["x"])) < 1.01 and abs(v["green"] - (120 + 100 * v["y"])) < 1.01
    area = 0
    for f in mesh["face"]:
        corner = [vertices[k] for k in f["vertex_indices"]]
        uv = [f["texcoord"][2 * k:2 * k + 2] for k in range(3)]
        for v, (s, t) in zip(corner, uv):
            assert abs(t - v["z"] / 2) < 1e-5
            off = abs(s - math.atan2(v["y"], v["x"]) % (2 * math.pi) / (2 * math.pi))
            assert min(off, abs(1 - off)) < 1e-3
        (a, b), (c, d), (e, g) = uv
        signed = ((c - a) * (g - b) - (e - a) * (d - b)) / 2
        assert signed > 0, "no triangle straddles the seam"
        area += signed
        ring = f["red"] / 10
        assert ring == round(ring) and abs(sum(v["z"] for v in corner) / 3 * 4 - 0.5 - ring) <= 0.51
    assert abs(area - 1) < 1e-4


def test_selected_faces_through_files(tmp_path):
    """The shipped script: what was not selected comes out again, to the last bit."""
    out = tmp_path / "o.ply"
    run = run_server(f"{SAMPLES}/bumpy.ply", os.path.join(SCRIPTS, "ccdm_selected_faces.mlx"), out)
    assert run.returncode == 0, run.stdout[-2000:]

    def triangles(mesh):
        points = [(v["x"], v["y"], v["z"]) for v in mesh["vertex"]]
        return [tuple(points[k] for k in f["vertex_indices"]) for f in mesh["face"]]
    before, after = triangles(plyfile.read_ply(f"{SAMPLES}/bumpy.ply")), triangles(plyfile.read_ply(out))
    rest = [t for t in before if not sum(p[2] for p in t) > 0]
    assert 0 < len(rest) < len(before) and after[:len(rest)] == rest
    assert len(after) > len(rest)
