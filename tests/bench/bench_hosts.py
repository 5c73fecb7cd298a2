#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor time of the paper's optimiser against MeshLab's own isotropic remesher.

Whole processes, user + system seconds, reading and writing included; MeshLab's "Isotropic Explicit
Remeshing" with 20 iterations, its edge length calibrated until the vertex count is within 3 %. Both
in turn, three times, the median counts. Prints a table and writes build/bench/hosts.json.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

from common import OUT, PROGRAM, SERVER, count_vertices, cpu_seconds, model

CASES = (("joint", 6000, 40), ("foot", 6000, 180), ("bunny_scan", 10000, 180), ("igea", 20000, 180))
RUNS = 3
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


def start_display():
    """A display of our own, so that its processor time stays out of the figures."""
    for number in range(90, 120):
        process = subprocess.Popen(["Xvfb", f":{number}", "-screen", "0", "640x480x24", "-nolisten", "tcp"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(1)
        if process.poll() is None:
            return process, f":{number}"
    raise RuntimeError("no display could be started")


def explicit(source, length, diagonal, angle, folder, display):
    script, out = os.path.join(folder, "explicit.mlx"), os.path.join(folder, "explicit.ply")
    with open(script, "w", encoding="ascii") as text:
        text.write(EXPLICIT.format(length=length, diagonal=diagonal, angle=min(angle, 179), distance=diagonal / 100))
    cpu, _ = cpu_seconds([SERVER, "-i", source, "-s", script, "-o", out], env={**os.environ, "DISPLAY": display})
    return cpu, count_vertices(out)


def geometry(source, folder):
    """(area, bounding-box diagonal) of a mesh, from its points."""
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "sample_meshes"))
    import numpy as np
    import render
    points, faces = render.read_ply(source)
    p = points[faces]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2
    used = points[np.unique(faces)]
    return float(area), float(np.linalg.norm(used.max(0) - used.min(0)))


def main():
    os.makedirs(OUT, exist_ok=True)
    display, name = start_display()
    rows = []
    try:
        with tempfile.TemporaryDirectory() as folder:
            print(f"{'model':<12}{'n':>7}{'CCDM s':>9}{'MB':>7}{'explicit s':>12}{'n':>8}{'ratio':>8}")
            for case, n, angle in CASES:
                source = model(case)
                area, diagonal = geometry(source, folder)
                length = (2 * area / (3 ** 0.5 * n)) ** 0.5
                for _ in range(8):
                    _, got = explicit(source, length, diagonal, angle, folder, name)
                    if abs(got / n - 1) < 0.03:
                        break
                    length *= (got / n) ** 0.5
                ours, theirs, memory = [], [], 0
                for _ in range(RUNS):
                    cpu, megabytes = cpu_seconds([PROGRAM, source, os.path.join(folder, "o.ply"), "-n", str(n), "--feature-angle",
                                                  str(angle), "--optimizer", "annealing", "--sampler", "random", "--threads", "1", "--quiet"])
                    ours.append(cpu)
                    memory = max(memory, megabytes)
                    theirs.append(explicit(source, length, diagonal, angle, folder, name)[0])
                row = {"model": os.path.basename(source), "n": n, "ccdm": statistics.median(ours), "megabytes": memory,
                       "explicit": statistics.median(theirs), "explicit_n": got}
                row["ratio"] = row["ccdm"] / row["explicit"]
                rows.append(row)
                print(f"{case:<12}{n:>7}{row['ccdm']:>9.2f}{memory:>7.0f}{row['explicit']:>12.2f}{got:>8}{row['ratio']:>8.3f}",
                      flush=True)
    finally:
        display.terminate()
    with open(os.path.join(OUT, "hosts.json"), "w", encoding="ascii") as out:
        json.dump(rows, out, indent=1)
    return 0


if __name__ == "__main__":
    sys.exit(main())
