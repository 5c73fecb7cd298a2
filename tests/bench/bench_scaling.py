#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory from 10,000 to 1,000,000 vertices, with one thread up to as many as there are cores.

Two parts. Growth: whole runs of the default on a large scan, wall and processor seconds and peak memory of the
process, reading and writing included; the least wall time of the runs counts. Cost: optimiser time of the
paper's method over the relocations that it counts, from the JSON reports, on a bumpy sphere and one thread.
Writes build/bench/scaling.json, the section on scaling of tests/bench/README.md, and its picture.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import scaling_page
from common import PROGRAM, ROOT, model, provenance, undisturbed, usage_of, write_figures

sys.path.insert(0, os.path.join(ROOT, "sample_meshes"))
import numpy as np
from meshfile import read_ply, write_ply

SIZES = (10000, 30000, 100000, 300000, 1000000)
REPEATED = 100000  # vertices up to which runs are repeated
FEATURE_ANGLE = 180  # degrees: the scans have no creases


def subdivided(points, faces):
    """Every triangle in four, by the midpoints of its sides."""
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges, middle = np.unique(sides, axis=0, return_inverse=True)
    middle = middle.reshape(-1, 3) + len(points)
    a, b, c = faces.T
    ab, bc, ca = middle.T
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return (np.concatenate([points, points[edges].mean(axis=1)]),
            np.concatenate([np.stack(corners, axis=1) for corners in quarters]))


def thread_counts():
    """1, 2, 4, ... and the number of cores."""
    cores = os.cpu_count()
    return sorted({cores, *(2 ** k for k in range(cores.bit_length()) if 2 ** k <= cores)})


def remesh(source, target, n, threads, *options):
    return usage_of([PROGRAM, source, target, "--vertices", str(n), "--feature-angle", str(FEATURE_ANGLE), "--threads",
                     str(threads), "--quiet", *options])


def bench_growth(source, sizes, repeats, folder):
    rows = []
    target = os.path.join(folder, "o.ply")
    for n in sizes:
        for threads in thread_counts():
            cost = undisturbed(lambda: remesh(source, target, n, threads), repeats if n <= REPEATED else 1)
            rows.append({"n": n, "threads": threads, **cost})
            print(f"{n:>9} vertices, {threads:>3} threads: {rows[-1]['wall']:>8.2f} s wall, {rows[-1]['cpu']:>8.2f} s "
                  f"processor, {cost['megabytes']:>6.0f} MB, others {cost['others']:.1f} cores", flush=True)
    return rows


def bench_inputs(folder, sizes, repeats):
    """The growth on a subdivided model; and one run on the model as it is, which tells what an input face takes."""
    original, source = model("igea"), os.path.join(folder, "subdivided.ply")
    points, faces = read_ply(original)
    write_ply(source, *subdivided(points, faces))
    small = remesh(original, os.path.join(folder, "o.ply"), sizes[0], 1)
    return {"model": os.path.splitext(os.path.basename(original))[0], "faces": 4 * len(faces),
            "original": {"faces": len(faces), "n": sizes[0], "megabytes": small.megabytes},
            "rows": bench_growth(source, sizes, repeats, folder)}


def bench_cost(sizes, folder):
    """Microseconds per vertex and relocation."""
    subprocess.run([os.path.join(ROOT, "build", "bin", "make_sample_meshes"), folder, "--large"], check=True)
    source, report = os.path.join(folder, "bumpy_large.ply"), os.path.join(folder, "r.json")
    rows = []
    for n in sizes:
        remesh(source, os.path.join(folder, "o.ply"), n, 1, "--optimizer", "annealing", "--sampler", "random",
               "--global-iterations", str(max(8, min(40, 4000000 // n))), "--report", report)
        with open(report, encoding="utf-8") as text:
            data = json.load(text)
        rows.append({"n": n, "microseconds": 1e6 * data["seconds"]["optimising"] / data["relocations"]})
        print(f"{n:>9} vertices: {rows[-1]['microseconds']:.3f} us for a vertex and relocation", flush=True)
    return rows


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", nargs="+", type=int, default=list(SIZES), metavar="N",
                        help="numbers of vertices (default " + " ".join(map(str, SIZES)) + ")")
    parser.add_argument("--repeats", type=int, default=2, help=f"runs of up to {REPEATED} vertices (default 2)")
    options = parser.parse_args()
    options.sizes = sorted(set(options.sizes))
    return options


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as folder:
        data = {**provenance(" ".join(["./run.sh bench scaling", *sys.argv[1:]])),
                "growth": bench_inputs(folder, options.sizes, options.repeats),
                "cost": bench_cost(options.sizes, folder)}
    write_figures("scaling.json", data)
    scaling_page.write(data)
    return 0


if __name__ == "__main__":
    sys.exit(main())
