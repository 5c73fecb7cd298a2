# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be remeshed is refused with the reason, and nothing is lost."""
import os
import sys

import ccdm
import numpy as np
import pytest
from saved_mesh import SavedMesh, read_ply

sys.path.insert(0, os.path.join(ccdm.ROOT, "tests", "support"))
import plyfile  # noqa: E402


def refused(dialog, reason):
    """Applies; the box and the log say why not."""
    m = dialog.meshlab
    layers = m.layers()
    since = dialog.apply()
    text = m.failure()
    assert "CCDM remeshing was not done: " in text and reason in text
    lines = m.wait_log("^Filter failed", since)
    assert any(reason in line for line in lines)
    assert m.is_alive() and m.layers() == layers


@pytest.mark.parametrize("new_layer", [True, False])
def test_mesh_that_is_no_surface(meshlab, tmp_path, new_layer):
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
    faces = [(0, 1, 2), (1, 0, 3), (0, 1, 4)]
    m = meshlab(plyfile.write_ply(str(tmp_path / "fin.ply"), points, faces))
    dialog = ccdm.open_dialog(m)
    ccdm.set_parameters(dialog, {"vertex_count": 100, "new_layer": new_layer})
    refused(dialog, "1 edge has more than two faces")
    dialog.close()
    left = read_ply(m.export_mesh(tmp_path / "left.ply"))
    assert np.array_equal(left[0], points) and np.array_equal(left[1], faces)


def test_wrong_values(meshlab, samples, tmp_path):
    m = meshlab(f"{samples}/two_components.ply")
    dialog = ccdm.open_dialog(m)
    ccdm.set_parameters(dialog, {"new_layer": False, "vertex_count": 3})
    refused(dialog, "vertex_count must lie between 4 and 100000000, not 3")
    ccdm.set_parameters(dialog, {"vertex_count": 600, "feature_angle": "a lot"})
    refused(dialog, "feature_angle must lie between 0.001 and 180, not 0")
    ccdm.set_parameters(dialog, {"feature_angle": 40, "density": "Vertex quality"})
    refused(dialog, "no vertex quality")
    dialog.close()
    unchanged = read_ply(m.export_mesh(tmp_path / "left.ply"))
    for a, b in zip(unchanged, read_ply(f"{samples}/two_components.ply")):
        assert np.array_equal(a, b)
    # The dialog keeps its values; with right ones it does its work.
    dialog = ccdm.open_dialog(m)
    ccdm.remesh(dialog, vertex_count=600, density="Uniform", new_layer=False)
    dialog.close()
    assert SavedMesh(m.export_mesh(tmp_path / "done.ply")).vertices == 600


def test_second_run_during_the_first(meshlab, samples):
    m = meshlab(f"{samples}/cad_part.ply")
    dialog = ccdm.open_dialog(m)
    ccdm.set_parameters(dialog, {"vertex_count": 20000})
    # The bus would keep the second press until the first run is over.
    button = dialog.body.child("push button", "Apply").centre
    since = dialog.apply()
    m.wait_log("to 20000 vertices", since)
    m.click(*button)
    assert "this filter is running already" in m.failure()
    m.wait_log("^Applied filter", since)
    assert m.is_alive() and m.layers() == [("cad_part", False), ("cad_part_ccdm", True)]


def start_in_place(m):
    """Starts a run of some seconds by a click: the bus would keep what is pressed until a run that it started is
    over."""
    dialog = ccdm.open_dialog(m)
    ccdm.set_parameters(dialog, {"vertex_count": 40000, "new_layer": False})
    since = len(m.log())
    m.click(*dialog.body.child("push button", "Apply").centre)
    m.wait_log("to 40000 vertices", since)
    return dialog


def test_layer_that_is_deleted_during_the_run(meshlab, samples):
    m = meshlab(f"{samples}/cad_part.ply")
    delete = m.item("Filters", "Mesh Layer", "Delete Current Mesh")
    start_in_place(m)
    delete.press()
    # When the box is closed, this MeshLab goes on with the dialog of the first filter, which the second has replaced:
    # some runs of any filter end it.
    box = m.window("alert", "Filter Failure")
    assert "not done: the layer was deleted while the filter was running" in box.find("label").name
    assert m.is_alive() and m.layers() == []


def test_layer_that_is_changed_during_the_run(meshlab, samples, tmp_path):
    part, other = tmp_path / "part.ply", read_ply(f"{samples}/plate.ply")
    part.write_bytes(open(f"{samples}/cad_part.ply", "rb").read())
    m = meshlab(part)
    reload_file = m.item("File", "Reload")
    dialog = start_in_place(m)
    plyfile.write_ply(part, other[0].tolist(), other[1].tolist())
    reload_file.press()
    assert "not done: the layer was changed while the filter was running" in m.failure()
    assert m.is_alive() and m.layers() == [("part", True)]
    dialog.close()
    for a, b in zip(read_ply(m.export_mesh(tmp_path / "left.ply")), other):
        assert np.array_equal(a, b)
