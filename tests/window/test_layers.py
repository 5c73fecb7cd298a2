# SPDX-License-Identifier: GPL-3.0-or-later
"""Where results go."""
import ccdm
from saved_mesh import SavedMesh


def test_each_run_makes_a_layer_of_its_own(meshlab, samples, tmp_path):
    m = meshlab(f"{samples}/sphere.ply")
    dialog = ccdm.open_dialog(m)
    ccdm.remesh(dialog, vertex_count=500)
    assert m.layers() == [("sphere", False), ("sphere_ccdm", True)]
    lines = ccdm.remesh(dialog, vertex_count=300)
    assert lines[0].startswith("remeshing 500 vertices"), "the new layer is the current one"
    assert m.layers() == [("sphere", False), ("sphere_ccdm", False), ("sphere_ccdm_ccdm", True)]
    dialog.close()
    assert SavedMesh(m.export_mesh(tmp_path / "last.ply")).vertices == 300


def test_in_place_keeps_one_layer(meshlab, samples, tmp_path):
    m = meshlab(f"{samples}/sphere.ply")
    dialog = ccdm.open_dialog(m)
    for count in (500, 300):
        ccdm.remesh(dialog, vertex_count=count, new_layer=False)
        assert m.layers() == [("sphere", True)]
    dialog.close()
    assert SavedMesh(m.export_mesh(tmp_path / "last.ply")).vertices == 300
