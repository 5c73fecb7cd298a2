#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's few lines on other remeshers, from the tables of PEERS.md and PEERS_OWN_ANGLES.md. bench_peers.py
writes them, and so does a run of this file; a test compares the pages."""
import re
import statistics
import textwrap
from pathlib import Path

from common import put_between

HERE = Path(__file__).resolve().parent
PAGES = {"PEERS.md": "at the command line's default feature angle", "PEERS_OWN_ANGLES.md":
         "at the feature angle at which each model has creases worth keeping, without creases where it has none"}
README = HERE.parents[1] / "README.md"
BEGIN, END = "<!-- peers: written by tests/bench/peers_in_readme.py -->", "<!-- peers: end -->"
HEAD = ("CCDM", "average smallest angle", "best other's", "fastest other's time / ours",
        "Hausdorff at most the best's", "RMS at most the best's")
FIGURES = ("fastest peer's / ours", "our angle", "best peer's")
DISTANCES = ("Hausdorff at most", "RMS at most")  # with yes and no


def is_number(text):
    return re.fullmatch(r"\d+\.?\d*", text) is not None


def tables(page, section):
    """{mode: the rows of its table in a section, by the names of the columns}; of equal names the first."""
    part = page.split(f"\n## {section}\n")[1].split("\n## ")[0]
    found = {}
    for text in part.split("\n### ")[1:]:
        head, _, *rows = [[cell.strip() for cell in line.strip("|").split(" | ")]
                          for line in text.splitlines() if line.startswith("|")]
        found[text.splitlines()[0]] = [dict(reversed(list(zip(head, row)))) for row in rows]
    return found


def spread(values, digits):
    return f"{min(values):.{digits}f} to {max(values):.{digits}f}"


def row(mode, figures, verdicts):
    def met(name):
        said = [r[name] for r in verdicts if "yes" in r[name] or "no" in r[name]]
        return f"{sum('yes' in word for word in said)} of {len(said)}"
    known = [[r[name] for name in FIGURES] for r in figures]
    times, ours, others = zip(*([float(x) for x in r] for r in known if all(map(is_number, r))))
    return [mode.removeprefix("CCDM, "), spread(ours, 1), spread(others, 1),
            f"{spread(times, 2)}, median {statistics.median(times):.2f}", *map(met, DISTANCES)]


def part(name):
    """The table of one page, and where it is from."""
    page = (HERE / name).read_text(encoding="utf-8")
    stamp = " ".join(page.split("\n\n")[1].split()).split(". That command")[0]
    verdicts = tables(page, "Conclusions")
    rows = [row(mode, figures, verdicts[mode]) for mode, figures in tables(page, "Summary").items()]
    text = (f"Each cell over all models, {PAGES[name]}; angles in degrees. From {stamp}; that command writes "
            f"[tests/bench/{name}](tests/bench/{name}), where each model and each remesher is, and this table.")
    return ["| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD),
            *("| " + " | ".join(r) + " |" for r in rows), "",
            *textwrap.wrap(text, 119, break_long_words=False, break_on_hyphens=False)]


def lines():
    first, second = map(part, PAGES)
    return [*first, "", *second]


def write():
    put_between(README, BEGIN, END, lines())


if __name__ == "__main__":
    write()
