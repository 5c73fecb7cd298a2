#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's tables and figures, made anew on the models at hand, as one folder with a page.

Tables 1 and 2 with the paper's rows beside those of the project's modes and of other remeshers, one process at a time;
figures 3(d), 4(c) and 4(d), the mean of 10 seeds, on all cores; figures 5 to 10 as pictures.
"""
import argparse
import json
import os
import sys

import models
from common import ROOT, measure, provenance
import curves
import paper_page
import pictures
import tables

OUT = os.path.join(ROOT, "build", "paper")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="a tenth of the vertices, few seeds and rounds, no other remeshers")
    parser.add_argument("--peers", nargs="*", metavar="WORD",
                        help="of the other remeshers of ./run.sh bench peers those whose name has one of the words")
    parser.add_argument("--redraw", action="store_true",
                        help="only the pictures and the page, anew from the figures that are in the folder")
    parser.add_argument("--time-limit", type=float, default=120, help="wall seconds of one run (default 120)")
    parser.add_argument("--out", default=OUT, help="the folder to write (default build/paper)")
    return parser.parse_args()


def main():
    options = arguments()
    if options.redraw:
        with open(data_file(options.out), encoding="utf-8") as text:
            data = json.load(text)
    else:
        data = run(options)
    write(data, options.out)
    return 0


def data_file(folder):
    return os.path.join(folder, "paper.json")


def run(options):
    """All that is measured, kept in the folder."""
    meshes = os.path.join(options.out, "meshes")
    os.makedirs(meshes, exist_ok=True)
    for name in os.listdir(meshes):
        if name.endswith(".ply"):
            os.remove(os.path.join(meshes, name))  # which would pass for one of this run
    cases, plank = models.cases(options.quick), models.plank(options.quick)
    command = ["./run.sh paper", *sys.argv[1:]]
    data = {**provenance(" ".join(command)), "load": os.getloadavg()[0], "real": models.REAL, "quick": options.quick,
            "before": {c.name: measure(models.source(c))["vertices"] for c in (*cases, plank)}}
    data["tables"] = {"printed": tables.printed(), **tables.measure_tables(cases, options.out, options)}
    print("curves", flush=True)
    data["curves"] = curves.measure_curves(plank, options.out, curves.QUICK if options.quick else curves.FULL)
    with open(data_file(options.out), "w", encoding="utf-8") as out:
        json.dump(data, out, indent=1)
    return data


def write(data, folder):
    """Tables, curves, pictures and the page from what was measured."""
    cases, plank = models.cases(data["quick"]), models.plank(data["quick"])
    for number in (1, 2):
        tables.write_csv(os.path.join(folder, f"table_{number}.csv"),
                         tables.records(data["tables"], number, data["before"]))
    curves.write_csv(os.path.join(folder, "curves.csv"), data["curves"])
    print("pictures", flush=True)
    curves.draw(data["curves"], folder)
    pictures.draw(cases, plank, [p["name"] for p in data["tables"]["peers"]], folder)
    paper_page.write(data, cases, plank, folder)
    print("page: " + os.path.join(folder, "index.md"))


if __name__ == "__main__":
    sys.exit(main())
