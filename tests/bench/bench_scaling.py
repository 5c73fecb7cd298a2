#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time per vertex and relocation from 10,000 to 1,000,000 vertices on one surface.

Optimiser time over the relocations that it counts, from the JSON reports. Prints a table and draws
build/bench/scaling.png.
"""
import json
import os
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from common import OUT, PROGRAM, ROOT

SIZES = (10000, 30000, 100000, 300000, 1000000)


def main():
    os.makedirs(OUT, exist_ok=True)
    subprocess.run([os.path.join(ROOT, "build", "bin", "make_sample_meshes"), OUT, "--large"], check=True)
    source = os.path.join(OUT, "bumpy_large.ply")
    rows = []
    print(f"{'n':>9}{'us / vertex and relocation':>28}{'build s':>9}{'total s':>9}")
    for n in SIZES:
        report = os.path.join(OUT, "r.json")
        rounds = max(8, min(40, 4000000 // n))
        subprocess.run([PROGRAM, source, os.path.join(OUT, "o.ply"), "-n", str(n), "--feature-angle", "180",
                        "--optimizer", "annealing", "--sampler", "random", "--threads", "1",
                        "--global-iterations", str(rounds), "--report", report, "--quiet"], check=True)
        with open(report, encoding="utf-8") as text:
            data = json.load(text)
        cost = 1e6 * data["seconds"]["optimising"] / data["relocations"]
        rows.append((n, cost))
        print(f"{n:>9}{cost:>28.3f}{data['seconds']['building the initial mesh']:>9.2f}{data['seconds']['total']:>9.2f}",
              flush=True)
    costs = [c for _, c in rows]
    print(f"largest over smallest: {max(costs) / min(costs):.2f}")
    plt.figure(figsize=(6, 4))
    plt.semilogx([n for n, _ in rows], costs, "o-")
    plt.ylim(0, 1.3 * max(costs))
    plt.xlabel("vertices")
    plt.ylabel("microseconds per vertex and relocation")
    plt.grid(alpha=0.3)
    plt.tight_layout()
    plt.savefig(os.path.join(OUT, "scaling.png"), dpi=110)
    os.remove(os.path.join(OUT, "o.ply"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
