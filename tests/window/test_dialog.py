# SPDX-License-Identifier: GPL-3.0-or-later
"""What the dialog shows."""
import os

import ccdm
import pictures
from accessible import wait_until
from saved_mesh import SavedMesh


def test_every_parameter_with_its_label_help_and_default(meshlab, samples, pictures_folder):
    m = meshlab(f"{samples}/cad_part.ply")
    dialog = ccdm.open_dialog(m)
    assert dialog.labels() == list(ccdm.LABELS.values())
    for name, label in ccdm.LABELS.items():
        assert len(dialog.help(label)) > 20, label
        value = dialog.get(label)
        shown = str(value).lower() if isinstance(value, bool) else value
        assert shown == ("178" if name == "vertex_count" else ccdm.DEFAULTS[name]), label
    for row in ccdm.page_rows():
        if row[3] == "RichEnum":
            assert ", ".join(f"'{w}'" for w in dialog.words(row[0])) == row[4]
    path = os.path.join(pictures_folder, "dialog.png")
    pictures.dialog_with_help(dialog, path)
    assert os.path.getsize(path) > 10000


def test_search_box_finds_it_and_default_takes_changes_back(meshlab, samples):
    m = meshlab(f"{samples}/plate.ply")
    dialog = m.search_filter("ccdm", ccdm.TITLE)
    count = dialog.get(ccdm.LABELS["vertex_count"])
    assert count == str(SavedMesh(f"{samples}/plate.ply").vertices)
    ccdm.set_parameters(dialog, {"vertex_count": 77, "density": "Curvature", "new_layer": False})
    dialog.press("Default")
    wait_until(lambda: dialog.get(ccdm.LABELS["vertex_count"]) == count, "default")
    assert dialog.get(ccdm.LABELS["density"]) == "Uniform" and dialog.get(ccdm.LABELS["new_layer"]) is True
