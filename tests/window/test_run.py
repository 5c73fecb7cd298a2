# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs from opening a mesh to the saved result, with what the log and the status bar say meanwhile."""
import os
import time

import ccdm
import pictures
import pytest
from saved_mesh import SavedMesh


def agree(lines, before, after):
    """The log's table says of both meshes what their files say."""
    table = ccdm.table(lines)
    for column, mesh in enumerate((before, after)):
        assert table["vertices"][column] == mesh.vertices
        assert table["faces"][column] == len(mesh.faces)
        assert table["Euler characteristic"][column] == mesh.euler
        assert table["boundary loops"][column] == mesh.boundary_loops
        assert table["average smallest angle (deg)"][column] == pytest.approx(mesh.smallest_angles.mean(), abs=0.006)
        assert table["smallest angle (deg)"][column] == pytest.approx(mesh.smallest_angles.min(), abs=0.006)
    assert table["average smallest angle (deg)"][1] > 50


def test_changed_parameters_into_a_new_layer(meshlab, samples, tmp_path, pictures_folder):
    m = meshlab()
    m.import_mesh(f"{samples}/plate.ply")
    dialog = ccdm.open_dialog(m)
    before = SavedMesh(f"{samples}/plate.ply")
    lines = ccdm.remesh(dialog, vertex_count=1234, feature_angle=60, density="Curvature", new_layer=True,
                        global_iterations=15, local_iterations=2, **{"lambda": 0.3}, min_angle=35, seed=5)
    assert lines[0] == (f"remeshing {before.vertices} vertices, {len(before.faces)} faces to 1234 vertices; "
                        "into a new layer")
    assert lines[1] == "features: edges that turn by more than 60 deg; boundary: sliding; density: by curvature"
    assert lines[2].startswith("accelerated optimizer, 15 x 2 iterations, lambda 0.3, smallest angle 35 deg")
    assert lines[2].endswith("seed 5")
    (summary,) = [line for line in lines if "global iterations accepted" in line]
    assert "of 15 global iterations" in summary and summary.endswith(" s"), "the time that it took"
    assert lines[-1].startswith("note: features are closer together than the spacing"), "warnings come last"
    dialog.close()
    after = SavedMesh(m.export_mesh(tmp_path / "result.ply"))
    assert after.vertices == 1234
    assert after.is_manifold and after.topology == before.topology
    agree(lines, before, after)
    path = os.path.join(pictures_folder, "result.png")
    pictures.side_by_side(m, path)
    shares = [pictures.dark_share(path, x, x + 0.45) for x in (0.02, 0.52)]
    assert min(shares) > 0.01, "the lines of the triangles"


def test_annealing_in_place_with_its_own_numbers(meshlab, samples, tmp_path):
    m = meshlab(f"{samples}/high_genus.ply")
    dialog = ccdm.open_dialog(m)
    lines = ccdm.remesh(dialog, vertex_count=1500, optimizer="Annealing", new_layer=False)
    assert lines[0].endswith("to 1500 vertices; in place")
    assert lines[2].startswith("annealing optimizer, 40 x 3 iterations, lambda 0.2, smallest angle 34 deg")
    dialog.close()
    assert m.layers() == [("high_genus", True)]
    before, after = SavedMesh(f"{samples}/high_genus.ply"), SavedMesh(m.export_mesh(tmp_path / "result.ply"))
    assert after.vertices == 1500
    assert after.is_manifold and after.topology == before.topology
    agree(lines, before, after)


def test_plan_comes_first_and_progress_moves(meshlab, samples, pictures_folder):
    count = 200000  # seconds on a fast machine too
    m = meshlab(f"{samples}/cad_part.ply")
    dialog = ccdm.open_dialog(m)
    ccdm.set_parameters(dialog, {"vertex_count": count})
    bar = m.progress_bar()
    since = dialog.apply()
    early = ccdm.own_lines(m.wait_log(f"to {count} vertices", since))
    assert not ccdm.table(early), "the plan is there before the table"
    seen = []
    end = time.monotonic() + 60
    while not any(line.startswith("Applied filter") for line in m.log()[since:]):
        seen.append(pictures.progress(m.desktop, bar))
        assert time.monotonic() < end, "the run does not end"
    # When the run is over, the bar is emptied.
    while seen and seen[-1] == 0:
        seen.pop()
    between = [x for x in seen if 0.02 < x < 0.98]
    assert len(set(between)) >= 3, seen
    assert seen == sorted(seen), "it never falls"
    lines = ccdm.own_lines(m.log()[since:])
    assert lines[:len(early)] == early and ccdm.table(lines)["vertices"] == (178, count)
