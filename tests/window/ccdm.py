# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter under test: what it is called, its parameters' labels, its log."""
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "support"))
from filter_parameters import declared, page_rows  # noqa: E402

MENU = "Remeshing, Simplification and Reconstruction"
TITLE = "Remeshing: Isotropic CCDM (constrained centroidal Delaunay mesh)"
LABELS = {name: label for _, name, label, _ in declared()}
DEFAULTS = {row[1].strip("`"): row[5].strip("'") for row in page_rows()}
MARK = "CCDM: "


def open_dialog(meshlab):
    return meshlab.open_filter(MENU, TITLE)


def set_parameters(dialog, changes):
    """`changes`: values by the names in scripts."""
    for name, value in changes.items():
        dialog.set(LABELS[name], value)


def remesh(dialog, **changes):
    """Changes parameters, runs, waits for the end; the filter's lines in the log."""
    set_parameters(dialog, changes)
    since = dialog.apply()
    return own_lines(dialog.meshlab.wait_applied(since))


def own_lines(lines):
    """The filter's lines, without its mark."""
    return [line[len(MARK):] for line in lines if line.startswith(MARK)]


def table(lines):
    """{name: (before, after)} of the table that ends a run."""
    found = {}
    for line in lines:
        cells = line.rsplit(None, 2)
        try:
            found[cells[0]] = float(cells[1]), float(cells[2])
        except (IndexError, ValueError):
            pass
    return found
