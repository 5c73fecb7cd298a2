# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshing of the selected faces only, and the kinds of boundary."""
import os
import re
import sys

import numpy
import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from host import (FILTER, add_points, content, custom, everything, load, log_of, meshes, pymeshlab,  # noqa: E402
                  refused, same, set_of, uv_areas)
import plyfile  # noqa: E402
from test_attributes import cylinder, field, textured, wedges, write_textured_obj  # noqa: E402


def edge_uses(faces):
    edges = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return numpy.unique(edges, axis=0, return_counts=True)


def boundary_vertices(faces):
    edges, count = edge_uses(faces)
    return numpy.unique(edges[count == 1])


def with_attributes(points, faces):
    random = numpy.random.default_rng(3)
    ms = set_of(points, faces, v_scalar_array=field(points), v_color_matrix=random.random((len(points), 4)),
                f_color_matrix=random.random((len(faces), 4)), f_scalar_array=random.random(len(faces)))
    ms.compute_texcoord_by_function_per_vertex(u="x/7", v="z/5")
    ms.current_mesh().add_vertex_custom_scalar_attribute(field(points) / 3, "third")
    add_points(ms, "numbers", "fi/7", "fi*fi", "x0", of="face")
    return ms


def split(ms):
    """Which vertices and faces of the current mesh have to stay, and which vertices lie off the new part."""
    m = ms.current_mesh()
    points, faces = content(ms)
    chosen = m.face_selection_array().astype(bool)
    kept = numpy.ones(len(points), bool)
    kept[faces[chosen]] = False
    away = kept.copy()
    kept[faces[~chosen]] = True
    return kept, ~chosen, away


@pytest.mark.parametrize("new_layer", [True, False])
@pytest.mark.parametrize("name, condition", [("bumpy", "z0 + z1 + z2 > 0.3"), ("cad_part", "x0 + x1 + x2 > 0"),
                                             ("klein_bottle", "x0 > 0"),
                                             ("sphere", "sin(9*x0)*sin(9*y0)*sin(9*z0) > 0")])
def test_the_rest_stays_to_the_last_bit(name, condition, new_layer):
    ms = with_attributes(*content(load(name)))
    ms.compute_selection_by_condition_per_vertex(condselect="y > 0.2")
    ms.compute_selection_by_condition_per_face(condselect=condition)
    kept, rest, away = split(ms)
    assert 0 < rest.sum() < len(rest)
    m = ms.current_mesh()
    before = everything(m)
    before["third"], before["numbers"] = custom(m, "third"), custom(m, "numbers", of="face", kind="point")
    count = len(kept) + 400
    out = ms.apply_filter(FILTER, vertex_count=count, global_iterations=3, selected_faces_only=True,
                          new_layer=new_layer)
    assert meshes(ms) == 1 + new_layer
    m = ms.current_mesh()
    after = everything(m)
    after["third"], after["numbers"] = custom(m, "third"), custom(m, "numbers", of="face", kind="point")
    n, f = kept.sum(), rest.sum()
    assert (out["kept_vertices"], out["kept_faces"]) == (n, f)
    assert m.vertex_number() == count + out["extra_vertices"]
    # Kept vertices and faces come first, in their order.
    number = numpy.cumsum(kept) - 1
    assert same(after["faces"][:f], number[before["faces"][rest]].astype(after["faces"].dtype))
    for key in ("points", "vertex_scalar_array", "vertex_color_matrix", "vertex_tex_coord_matrix", "vertex selection",
                "third"):
        assert same(after[key][:n], before[key][kept]), key
    for key in ("face_scalar_array", "face_color_matrix", "face normals", "numbers"):
        assert same(after[key][:f], before[key][rest]), key
    off = away[kept]
    assert same(after["vertex normals"][:n][off], before["vertex normals"][away]), "away from the new part"
    assert not after["face selection"][:f].any() and after["face selection"][f:].all(), "the new faces are selected"
    # One surface, joined without a gap.
    assert (edge_uses(after["faces"])[1] == 2).all() and (edge_uses(before["faces"])[1] == 2).all()
    now = after["points"]
    assert numpy.abs(after["vertex_scalar_array"] - field(now)).max() < 1e-9 * numpy.abs(field(now)).max()
    topology = ms.get_topological_measures()
    assert topology["is_mesh_two_manifold"]
    assert out["euler_characteristic_after"] == out["euler_characteristic_before"]
    assert out["components"] == topology["connected_components_number"]


def test_a_partial_run_always_keeps_the_attributes():
    ms = with_attributes(*content(load("sphere")))
    ms.compute_selection_by_condition_per_face(condselect="z0 > 0.2")
    kept, rest, _ = split(ms)
    before = everything(ms.current_mesh())
    ms.apply_filter(FILTER, vertex_count=len(kept) + 50, global_iterations=1, selected_faces_only=True,
                    keep_attributes=False)
    after = everything(ms.current_mesh())
    assert same(after["vertex_color_matrix"][:kept.sum()], before["vertex_color_matrix"][kept])
    assert same(after["face_scalar_array"][:rest.sum()], before["face_scalar_array"][rest])


def test_again_and_again_in_place():
    """The new faces are selected, so a second run goes on with them; the rest is as it was at first."""
    ms = with_attributes(*content(load("bumpy")))
    ms.compute_selection_by_condition_per_face(condselect="z0 > 0.2")
    kept, rest, _ = split(ms)
    points, faces = content(ms)
    for count in (len(points) + 300, len(points) + 100, len(points) + 500):
        ms.apply_filter(FILTER, vertex_count=count, global_iterations=2, selected_faces_only=True, new_layer=False,
                        feature_angle=180)
        now, _ = content(ms)
        assert len(now) == count and same(now[:kept.sum()], points[kept])
    assert ms.current_mesh().selected_face_number() == ms.current_mesh().face_number() - rest.sum()


def test_texture_of_the_rest_and_of_the_new_part(tmp_path):
    ms = textured(tmp_path, *cylinder())
    ms.compute_selection_by_condition_per_face(condselect="x0 + x1 + x2 > -1.5")
    _, rest, _ = split(ms)
    before = wedges(ms.current_mesh())
    ms.apply_filter(FILTER, vertex_count=450, global_iterations=3, feature_angle=100, selected_faces_only=True)
    after = wedges(ms.current_mesh())
    assert same(after[:rest.sum()], before[rest])
    assert uv_areas(after).min() > 0 and uv_areas(after).sum() == pytest.approx(0.72, rel=1e-4)
    assert numpy.ptp(after[:, :, 0], axis=1).max() < 0.1, "no triangle straddles the seam"


def test_polygons_of_the_rest_stay(tmp_path):
    n = 9
    points = [(i, j, 0.05 * i * j) for i in range(n) for j in range(n)]
    quads = [(n * i + j, n * i + j + n, n * i + j + n + 1, n * i + j + 1) for i in range(n - 1) for j in range(n - 1)]
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(plyfile.write_ply(str(tmp_path / "quads.ply"), points, quads))
    ms.compute_selection_by_condition_per_face(condselect="x0 + x1 + x2 > 12 && fi != 90")
    chosen = ms.current_mesh().face_selection_array().astype(bool)
    whole = sum(1 for k in range(len(quads)) if not chosen[2 * k:2 * k + 2].any())
    ms.apply_filter(FILTER, vertex_count=150, global_iterations=2, selected_faces_only=True)
    sizes = [len(f) for f in ms.current_mesh().polygonal_face_list()]
    assert sizes.count(4) == whole > 10 and set(sizes) == {3, 4}


@pytest.mark.parametrize("target", ["edge_length", "max_error"])
def test_other_targets_are_in_percent_of_the_whole(target):
    ms = load("bumpy")
    diagonal = ms.current_mesh().bounding_box().diagonal()
    ms.compute_selection_by_condition_per_face(condselect="z0 + z1 + z2 > 0.9")
    out = ms.apply_filter(FILTER, selected_faces_only=True, **{target: 2 if target == "edge_length" else 0.5})
    assert out["target_met"]
    if target == "max_error":
        assert 0 < out["hausdorff"] < 0.0051
        return
    points, faces = content(ms)
    new = faces[out["kept_faces"]:]
    edges = edge_uses(new)[0]
    lengths = numpy.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    assert lengths.mean() == pytest.approx(0.02 * diagonal, rel=0.05)


def test_what_cannot_be_done_is_refused():
    ms = load("bumpy")
    refused(ms, "no face is selected", selected_faces_only=True)
    ms.compute_selection_by_condition_per_face(condselect="z0 > 0.5")
    for new_layer in (True, False):
        refused(ms, "the vertex count must be at least", selected_faces_only=True, vertex_count=10,
                new_layer=new_layer)


def test_an_error_that_is_not_reached_is_told_in_percent_of_the_whole():
    """In a process of its own: after a failure PyMeshLab's progress still goes to the log of a MeshSet that is gone."""
    lines = log_of("""
ms.load_new_mesh(SAMPLES + "/sphere.ply")
ms.compute_selection_by_condition_per_face(condselect="z0 + z1 + z2 > 2.7")
try:
    ms.apply_filter(FILTER, selected_faces_only=True, max_error=0.0001, global_iterations=0, local_iterations=1)
except pymeshlab.PyMeshLabException as error:
    print("LOG: 0 CCDM:", str(error).partition("CCDM remeshing was not done: ")[2], file=sys.stderr)
""")
    assert re.fullmatch(r"an error of 0\.0001 % of the diagonal was not reached in \d run\(s\); the closest came within "
                        r"0\.00\d+ %", lines[-1])


def test_log_counts_what_faces_use_and_the_seams_of_the_part(tmp_path):
    """A tube whose lower half is remeshed, with half of its seam, and a vertex that no face uses."""
    points, faces, uv = cylinder()
    source = write_textured_obj(tmp_path, numpy.vstack([points, [0, 0, 1]]), faces, uv)
    lines = log_of(f"""
ms.load_new_mesh({source!r})
ms.compute_selection_by_condition_per_face(condselect="z0 + z1 + z2 < 3")
ms.apply_filter(FILTER, vertex_count=400, global_iterations=1, selected_faces_only=True, feature_angle=100)
print("LOG: 0 CCDM: counted", ms.current_mesh().vertex_number(), len(numpy.unique(ms.current_mesh().face_matrix())))
""")
    table = {cells[0]: cells[1:] for cells in (line.rsplit(None, 2) for line in lines) if len(cells) == 3}
    every, used = map(int, table["counted"])
    assert every == used + 1 and table["vertices"] == [str(len(points)), str(used)]
    assert "4 seam edges of the texture coordinates were kept as features" in lines


def test_log_of_a_partial_run():
    lines = log_of("""
ms.load_new_mesh(SAMPLES + "/bumpy.ply")
ms.compute_selection_by_condition_per_face(condselect="z0 > 0.5")
ms.apply_filter(FILTER, global_iterations=1, selected_faces_only=True)
""")
    assert re.fullmatch(r"only the \d+ selected faces; all else stays as it is", lines[1])
    assert any(line.startswith("topology of the remeshed part preserved") for line in lines)


def test_kinds_of_boundary():
    """A cut-open surface: each old boundary vertex stays to the last bit, or none need stay."""
    ms = load("bumpy")
    ms.compute_selection_by_condition_per_face(condselect="z0 + z1 + z2 > 0.4")
    ms.meshing_remove_selected_faces()
    ms.meshing_remove_unreferenced_vertices()
    points, faces = content(ms)
    rim = {tuple(p) for p in points[boundary_vertices(faces)]}
    assert len(rim) > 30
    stay = {}
    for kind in ("Sliding", "Fixed", "Smooth"):
        for new_layer in (True, False):
            ms = set_of(points, faces)
            ms.apply_filter(FILTER, vertex_count=len(points) + 200, global_iterations=3, feature_angle=180,
                            boundary=kind, new_layer=new_layer)
            now, triangles = content(ms)
            assert len(now) == len(points) + 200
            stay[kind] = len(rim & {tuple(p) for p in now[boundary_vertices(triangles)]})
    # Many vertices of the jagged rim are corners.
    assert stay["Fixed"] == len(rim) > stay["Sliding"] > stay["Smooth"] and stay["Smooth"] < len(rim) / 10
