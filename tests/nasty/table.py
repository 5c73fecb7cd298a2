#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""table.py: puts every nasty input through the program that CCDM_REMESH names, and writes README.md."""
import os
import sys
import tempfile
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "support"))

from nasty_meshes import CASES  # noqa: E402
from outcome import DONE, Outcome  # noqa: E402

HEAD = """\
# Nasty inputs

Whatever comes in, a proven mesh or a clear refusal comes out. `nasty_meshes.py` makes the inputs, `test_nasty.py`
puts each through the command line and checks the written file with code of its own (`../support/surface.py`):
manifold, of the topology that is known from how the input was made, the vertices that were asked for and those
reported as extra, finite, within the input's bounding box, the corners in place, no part of the input farther away
than one and a half spacings, three tenths of its area or more, and the same as the report says. `table.py` writes
this page.

Every run has `--global-iterations 4`, so that the angles are not the best there are, and few vertices. *faces*: of
the input as it is written; *asked*, *vertices*: of the result; *angles*: the average and the least of the smallest
angles, in degrees; *off*: the largest distance between input and result, in diagonals of the bounding box; *cross*:
pairs of faces that cross, before and after."""

FAILING = """\
What is not as it should be, which the tests expect until it is mended:"""


def figures(outcome):
    told, before = outcome.report["result"], outcome.report["input"]
    return [str(told["vertices"]), f"{told['angle_min_avg']:.1f}, {told['angle_min']:.1f}", f"{told['hausdorff']:.1g}",
            f"{before['self_intersections']}, {told['self_intersections']}"]


def row(case):
    with tempfile.TemporaryDirectory() as folder:
        outcome = Outcome(case, folder)
    if outcome.status == DONE:
        cells = figures(outcome) + ["; ".join(map(brief, outcome.report["warnings"]))]
    else:
        cells = ["", "", "", "", f"exit {outcome.status}: {outcome.reason}"]
    cells[-1] = ("**not as it should be** " if case.fails else "") + cells[-1]
    asked = " ".join([str(case.vertices), *map(str, case.args)])
    return [f"`{case.name}`", case.nasty, str(len(outcome.faces)), asked, *cells]


def brief(note):
    """Up to where places are listed."""
    return note.split(": ")[0]


def main():
    head = ["input", "what is nasty", "faces", "asked", "vertices", "angles", "off", "cross", "reason or notes"]
    lines = [HEAD, "", "| " + " | ".join(head) + " |", "|---|---|--:|---|--:|--:|--:|--:|---|"]
    lines += ["| " + " | ".join(row(case)) + " |" for case in CASES]
    failing = [f"- `{case.name}`: {case.fails}" for case in CASES if case.fails]
    if failing:
        lines += ["", FAILING, ""]
        for line in failing:
            lines += textwrap.wrap(line, 118, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
    with open(os.path.join(HERE, "README.md"), "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
