# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's example for the window, line by line."""
import os
import sys

import ccdm
from saved_mesh import SavedMesh

sys.path.insert(0, os.path.join(ccdm.ROOT, "tests", "support"))
import pages  # noqa: E402


def test_example_of_the_readme(meshlab, tmp_path):
    (block,) = [b for b in pages.blocks() if b.language == "text"]
    command, menu, *settings, last = block.text.splitlines()
    program, mesh = command.split()
    menu, *path = menu.split(" > ")
    assert (program, menu, last) == ("build/host/bin/meshlab", "Filters", "Apply")
    m = meshlab(os.path.join(ccdm.ROOT, mesh))
    dialog = m.open_filter(*path)
    wanted = dict(setting.split(": ") for setting in settings)
    for label, value in wanted.items():
        dialog.set(label, value)
    lines = ccdm.own_lines(m.wait_applied(dialog.apply()))
    dialog.close()
    assert f"features: edges that turn by more than {wanted['Feature angle (deg)']} deg" in lines[1]
    assert SavedMesh(m.export_mesh(tmp_path / "result.ply")).vertices == int(wanted["Vertex count"])
