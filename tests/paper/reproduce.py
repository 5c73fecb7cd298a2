#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's tables and figures, made anew on the models at hand, as one folder with a page.

Tables 1 and 2 with the paper's rows beside those of the project's modes and of other remeshers, one process at a time;
figures 3(d), 4(c) and 4(d), the mean of 10 seeds, on all cores; figures 5 to 10 as pictures.
"""
import argparse
import json
import os
import shutil
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
    parser.add_argument("--time-limit", type=float, default=120, help="wall seconds of one run (default 120)")
    parser.add_argument("--out", default=OUT, help="the folder to write (default build/paper)")
    return parser.parse_args()


def main():
    options = arguments()
    shutil.rmtree(options.out, ignore_errors=True)
    os.makedirs(os.path.join(options.out, "meshes"))
    cases, plank = models.cases(options.quick), models.plank(options.quick)
    command = ["./run.sh paper", *sys.argv[1:]]
    data = {**provenance(" ".join(command)), "load": os.getloadavg()[0], "real": models.REAL, "quick": options.quick,
            "before": {c.name: measure(models.source(c))["vertices"] for c in (*cases, plank)}}
    data["tables"] = {"printed": tables.printed(), **tables.measure_tables(cases, options.out, options)}
    print("curves", flush=True)
    data["curves"] = curves.measure_curves(plank, options.out, curves.QUICK if options.quick else curves.FULL)
    with open(os.path.join(options.out, "paper.json"), "w", encoding="utf-8") as out:
        json.dump(data, out, indent=1)
    write(data, cases, plank, options)
    return 0


def write(data, cases, plank, options):
    for number in (1, 2):
        tables.write_csv(os.path.join(options.out, f"table_{number}.csv"),
                         tables.records(data["tables"], number, data["before"]))
    curves.write_csv(os.path.join(options.out, "curves.csv"), data["curves"])
    print("pictures", flush=True)
    curves.draw(data["curves"], options.out)
    pictures.draw(cases, options.quick, [p["name"] for p in data["tables"]["peers"]], options.out)
    paper_page.write(data, cases, plank, options.out)
    print("page: " + os.path.join(options.out, "index.md"))


if __name__ == "__main__":
    sys.exit(main())
