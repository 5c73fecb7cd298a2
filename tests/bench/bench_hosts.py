#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor time of the paper's optimiser against MeshLab's own isotropic remesher.

Whole processes, user + system seconds, reading and writing included; MeshLab's "Isotropic Explicit
Remeshing" with 20 iterations, its edge length calibrated until the vertex count is within 3 %. Both
in turn, three times, the median counts. Writes build/bench/hosts.json and the section on hosts of
tests/bench/README.md.
"""
import argparse
import os
import statistics
import sys
import tempfile

import pages
from common import PROGRAM, SERVER, count_vertices, cpu_seconds, model, provenance, write_figures

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
import display  # noqa: E402

CASES = (("joint", 6000, 40), ("foot", 6000, 180), ("bunny_scan", 10000, 180), ("igea", 20000, 180))
RUNS = 3
TRIES = 8
EXPLICIT = """<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Remeshing: Isotropic Explicit Remeshing">
  <Param name="Iterations" type="RichInt" value="20"/>
  <Param name="Adaptive" type="RichBool" value="false"/>
  <Param name="SelectedOnly" type="RichBool" value="false"/>
  <Param name="TargetLen" type="RichAbsPerc" value="{length}" min="0" max="{diagonal}"/>
  <Param name="FeatureDeg" type="RichFloat" value="{angle}"/>
  <Param name="CheckSurfDist" type="RichBool" value="true"/>
  <Param name="MaxSurfDist" type="RichAbsPerc" value="{distance}" min="0" max="{diagonal}"/>
  <Param name="SplitFlag" type="RichBool" value="true"/>
  <Param name="CollapseFlag" type="RichBool" value="true"/>
  <Param name="SwapFlag" type="RichBool" value="true"/>
  <Param name="SmoothFlag" type="RichBool" value="true"/>
  <Param name="ReprojectFlag" type="RichBool" value="true"/>
 </filter>
</FilterScript>
"""


def explicit(source, length, diagonal, angle, folder):
    script, out = os.path.join(folder, "explicit.mlx"), os.path.join(folder, "explicit.ply")
    with open(script, "w", encoding="ascii") as text:
        text.write(EXPLICIT.format(length=length, diagonal=diagonal, angle=min(angle, 179), distance=diagonal / 100))
    # A display that is there already, so that its processor time stays out of the figures.
    cpu, _ = cpu_seconds([SERVER, "-i", source, "-s", script, "-o", out], env=display.environment())
    return cpu, count_vertices(out)


def geometry(source):
    """(area, bounding-box diagonal) of a mesh, from its points."""
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "sample_meshes"))
    import numpy as np
    import render
    points, faces = render.read_ply(source)
    p = points[faces]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2
    used = points[np.unique(faces)]
    return float(area), float(np.linalg.norm(used.max(0) - used.min(0)))


def ccdm(source, n, angle, folder):
    """Processor seconds and MB of the paper's method."""
    return cpu_seconds([PROGRAM, source, os.path.join(folder, "o.ply"), "--vertices", str(n), "--feature-angle",
                        str(angle), "--optimizer", "annealing", "--sampler", "random", "--threads", "1", "--quiet"])


def calibrated(source, n, angle, folder):
    """Edge length whose vertex count is within 3 % of n, with that count and the diagonal."""
    area, diagonal = geometry(source)
    length = (2 * area / (3 ** 0.5 * n)) ** 0.5
    for _ in range(TRIES):
        _, got = explicit(source, length, diagonal, angle, folder)
        if abs(got / n - 1) < 0.03:
            break
        length *= (got / n) ** 0.5
    return length, got, diagonal


def bench_case(case, n, angle, folder):
    source = model(case)
    length, got, diagonal = calibrated(source, n, angle, folder)
    ours, theirs = [], []
    for _ in range(RUNS):
        ours.append(ccdm(source, n, angle, folder))
        theirs.append(explicit(source, length, diagonal, angle, folder)[0])
    row = {"model": os.path.splitext(os.path.basename(source))[0], "n": n, "angle": angle, "explicit_n": got,
           "ccdm": statistics.median(cpu for cpu, _ in ours), "megabytes": max(megabytes for _, megabytes in ours),
           "explicit": statistics.median(theirs)}
    row["ratio"] = row["ccdm"] / row["explicit"]
    return row


TEXT = """Processor seconds of the whole process on one thread, the paper's method (annealing, random samples) with
its default budget against MeshLab's "Isotropic Explicit Remeshing", 20 iterations, edge length calibrated to the
same count, median of {runs} runs in turn."""


def write_section(rows):
    cells = [[r["model"], f"{r['n']:,}", str(r["angle"]), f"{r['ccdm']:.2f}", f"{r['megabytes']:.0f}",
              f"{r['explicit']:.2f}", f"{r['explicit_n']:,}", f"{r['ratio']:.2f}"] for r in rows]
    head = ("model", "vertices", "feature angle", "CCDM s", "CCDM MB", "explicit s", "its vertices", "ratio")
    pages.write_section("hosts", [*pages.stamp(provenance("./run.sh bench hosts"), "this section"), "",
                                  *pages.paragraph(TEXT.format(runs=RUNS)), "", *pages.table(head, cells, ("model",))])


def main():
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'model':<12}{'n':>7}{'CCDM s':>9}{'MB':>7}{'explicit s':>12}{'n':>8}{'ratio':>8}")
        for case, n, angle in CASES:
            row = bench_case(case, n, angle, folder)
            rows.append(row)
            print(f"{case:<12}{n:>7}{row['ccdm']:>9.2f}{row['megabytes']:>7.0f}{row['explicit']:>12.2f}"
                  f"{row['explicit_n']:>8}{row['ratio']:>8.3f}", flush=True)
    write_figures("hosts.json", rows)
    write_section(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
