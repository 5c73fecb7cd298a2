# SPDX-License-Identifier: GPL-3.0-or-later
"""Features that the user marks with MeshLab's own filter."""
import os
import sys

import ccdm
import numpy as np
from saved_mesh import SavedMesh

sys.path.insert(0, os.path.join(ccdm.ROOT, "tests", "support"))
import plyfile  # noqa: E402


def ridge_length(mesh):
    """Length of the mesh's edges that lie on the line x = 0.5, z = 0.1."""
    ends = mesh.points[mesh.edges]
    on = (np.abs(ends[:, :, 0] - 0.5) < 1e-5).all(1) & (np.abs(ends[:, :, 2] - 0.1) < 1e-5).all(1)
    return np.abs(ends[on, 0, 1] - ends[on, 1, 1]).sum()


def test_selected_crease_instead_of_the_angle(meshlab, tmp_path):
    # A roof whose ridge turns by 23 degrees, less than the feature angle.
    points, faces = plyfile.grid(20)
    points = [(x, y, 0.2 * min(x, 1 - x)) for x, y, _ in points]
    m = meshlab(plyfile.write_ply(str(tmp_path / "roof.ply"), points, faces))
    dialog = ccdm.open_dialog(m)
    lines = ccdm.remesh(dialog, vertex_count=250, new_layer=False, selected_edges="Ignored")
    assert not any("selected" in line for line in lines)
    dialog.close()
    without = SavedMesh(m.export_mesh(tmp_path / "without.ply"))
    m.close()

    m = meshlab(str(tmp_path / "roof.ply"))
    crease = m.open_filter(ccdm.MENU, "Select Crease Edges")
    for label in crease.labels():
        crease.set(label, -10 if float(crease.get(label)) < 0 else 10)
    m.wait_applied(crease.apply())
    crease.close()
    dialog = ccdm.open_dialog(m)
    lines = ccdm.remesh(dialog, vertex_count=250, new_layer=False, selected_edges="Instead of the angle")
    assert "features: boundaries only and the selected edges (40 sides of faces)" in lines[1]
    dialog.close()
    kept = SavedMesh(m.export_mesh(tmp_path / "kept.ply"))
    assert kept.vertices == without.vertices == 250
    assert ridge_length(kept) > 0.9999
    assert ridge_length(without) < 0.5
