#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a smallest angle costs, and what closeness to the input costs: two sweeps over one parameter each.

Writes build/bench/tradeoffs.json, tests/bench/ANGLES.md, tests/bench/APPROXIMATION.md and their pictures.
"""
import json
import os
import sys
import tempfile

import tradeoffs_page
from common import (PROGRAM, cases, measure, model, models_asked_for, provenance, undisturbed, usage_of,
                    write_figures)

MODELS = ("joint", "wingnut", "pig", "moai", "bunny_scan", "koala", "cad_part", "bumpy", "bust")
SWEEPS = {"min-angle": (0, 20, 30, 35, 40, 42, 44), "approximation": (0, 0.25, 0.5, 0.6, 0.75, 1)}
RUNS = 2  # the quicker one counts


def run(name, n, option, value, folder):
    result, report = os.path.join(folder, "o.ply"), os.path.join(folder, "r.json")
    command = [PROGRAM, model(name), result, "--vertices", str(n), "--threads", "1", "--quiet",
               "--" + option, str(value)]
    cost = undisturbed(lambda: usage_of(command), RUNS)
    usage_of([*command, "--report", report])
    with open(report, encoding="utf-8") as text:
        told = json.load(text)
    figures = measure(model(name), result)
    row = {"model": name, "n": n, option: value, "cpu": cost["cpu"], "faces": told["result"]["faces"],
           **{key: told["smallest_angle"][key] for key in ("below", "reasons")},
           **{key: figures[key] for key in ("angle_min_avg", "angle_min", "hausdorff", "rms")}}
    print(f"{name:<13}{option} {value:<6}" + "  ".join(tradeoffs_page.figures(row)), flush=True)
    return row


def main():
    names = models_asked_for(__doc__, MODELS)
    data = provenance(" ".join(["./run.sh bench tradeoffs", *sys.argv[1:]]))
    with tempfile.TemporaryDirectory() as folder:
        for option, values in SWEEPS.items():
            data[option] = [run(name, n, option, value, folder) for name, n in cases(names)
                            for value in values]
    write_figures("tradeoffs.json", data)
    tradeoffs_page.write(data)
    return 0


if __name__ == "__main__":
    sys.exit(main())
