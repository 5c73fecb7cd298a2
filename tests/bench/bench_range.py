#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time from 4 vertices to five times the input's: processor seconds of whole runs of the default on one thread.

Writes build/bench/range.json and the section on the range of tests/bench/README.md.
"""
import os
import sys
import tempfile

import pages
from common import (PROGRAM, cases, count_vertices, model, models_asked_for, provenance, undisturbed, usage_of,
                    write_figures)

MODELS = ("joint", "twist", "moai", "bunny_scan", "igea", "cad_part", "twisted_bar", "bumpy", "bust")  # those at hand
FEW = (4, 40, 400)
RUNS = 2  # the quicker one counts

TEXT = """Processor seconds of whole runs of the default on one thread, reading and writing included, from 4 vertices
to five times the V of the input; the quicker of two runs. Where the topology or the features take more vertices than
were asked for, the result has those (in brackets). A few vertices can take longer than many: what cannot be met with
them is attempted anew, by other means, with more vertices at last. The last column holds 1 if the time grows in
proportion to the vertices from V on; less where the work on the input dominates, or where V is too small to be
refined from a coarse level, which is the quicker way."""


def bench(source, n, folder):
    result = os.path.join(folder, "o.ply")
    command = [PROGRAM, source, result, "--vertices", str(n), "--threads", "1", "--quiet"]
    cost = undisturbed(lambda: usage_of(command), RUNS)
    return {"n": n, "vertices": count_vertices(result), "cpu": cost["cpu"]}


def bench_model(name, folder):
    source = model(name)
    size = count_vertices(source)
    rows = []
    for n in (*FEW, size, 5 * size):
        rows.append(bench(source, n, folder))
        print(f"{name:>12}: {n:>9} vertices, {rows[-1]['cpu']:>8.2f} s", flush=True)
    return {"model": os.path.splitext(os.path.basename(source))[0], "vertices": size, "runs": rows}


def cell(run):
    return f"{run['cpu']:.2f}" + (f" ({run['vertices']:,})" if run["vertices"] != run["n"] else "")


def section(data):
    lines = []
    for entry in data["models"]:
        *few, once, last = entry["runs"]
        growth = (last["cpu"] - once["cpu"]) / once["cpu"] / (last["vertices"] / once["vertices"] - 1)
        lines.append([entry["model"], f"{entry['vertices']:,}", *map(cell, few), cell(once), cell(last),
                      f"{growth:.2f}"])
    head = ["model", "V", *map(str, FEW), "V", "5 V", "growth"]
    return pages.stamp(data, "this section") + ["", *pages.paragraph(TEXT), "",
                                                *pages.table(head, lines, texts=("model",))]


def main():
    names = models_asked_for(__doc__, MODELS)
    with tempfile.TemporaryDirectory() as folder:
        data = {**provenance(" ".join(["./run.sh bench range", *sys.argv[1:]])),
                "models": [bench_model(name, folder) for name, _ in cases(names)]}
    write_figures("range.json", data)
    pages.write_section("range", section(data))
    return 0


if __name__ == "__main__":
    sys.exit(main())
