#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The project beside other remeshers, on the same models, one process at a time.

Every process runs on one core. Its time is user + system seconds, reading and writing included, less what
starting Python and importing a package took; the least of the runs counts. Each remesher gets the same feature
angle, that which is the command line's default or each model's own, and a size calibrated until the vertex count is
within 3 %. What cannot be installed, fails or takes too long is a row with the reason. All results are measured by
the project's own metrics. Writes build/bench/peers.json, tests/bench/PEERS.md, its pictures, and the README's
tables; with the models' own angles peers_own_angles.json and PEERS_OWN_ANGLES.md.
"""
import argparse
import math
import os
import shutil
import sys
import tempfile
from collections import namedtuple

import peers_in_readme
import peers_page
from common import NO_CREASES, OWN_ANGLES, cases, measure, model, provenance, usage_of, write_figures
from peers import all_peers

FEATURE_ANGLE = 40  # degrees, the command line's default
TIME_LIMIT = 300  # wall seconds of one run
DISTANCE_SAMPLES = 1000000  # points on each surface
LONG_RUN = 20  # processor seconds from which on a run is not repeated
TOLERANCE = 0.03  # of the vertex count
TRIES = 6
Settings = namedtuple("Settings", "feature_angle repeats time_limit distance_samples",
                      defaults=(FEATURE_ANGLE, 3, TIME_LIMIT, DISTANCE_SAMPLES))


def pinned(command):
    """The command on the last of the cores, so that no peer gains or loses by threads."""
    return ["taskset", "-c", str(max(os.sched_getaffinity(0))), *command]


class Bench:
    """One peer on one model, from the prepared input to its row."""

    def __init__(self, peer, source, settings, folder):
        self.peer, self.settings = peer, settings
        self.target = os.path.join(folder, "result.ply")
        self.best = os.path.join(folder, "best.ply")
        self.input = peer.prepare(source, folder)

    def run(self, size):
        """Seconds of one run, its result left in the target file."""
        for path in (self.target, self.target + ".start"):
            if os.path.exists(path):
                os.remove(path)
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        command = self.peer.command(self.input, self.target, size, self.settings.feature_angle)
        usage = usage_of(pinned(command), self.settings.time_limit, env=environment)
        start = 0.0
        if os.path.exists(self.target + ".start"):
            start = float(open(self.target + ".start", encoding="ascii").read())
        return {"cpu": usage.cpu - start, "start": start, "wall": usage.wall}

    def calibrate(self, size, n):
        """Secant in logarithms; size and run whose vertex count comes nearest to n, the mesh kept in `best`."""
        slope, previous, best = self.peer.slope, None, None
        for _ in range(TRIES):
            run = self.run(size)
            result = self.peer.finish(self.target)
            off = math.log(max(1, measure(result)["vertices"]) / n)
            if best is None or abs(off) < best[0]:
                best = (abs(off), size, run)
                os.replace(result, self.best)
            if best[0] <= math.log(1 + TOLERANCE):
                break
            if previous and size != previous[0]:
                secant = (off - previous[1]) / math.log(size / previous[0])
                slope = secant if 0.3 < secant / self.peer.slope < 3 else self.peer.slope
            previous = (size, off)
            size *= math.exp(-off / slope)
        return best[1:]

    def row(self, source, size, n):
        size, first = self.calibrate(size, n)
        metrics = measure(source, self.best, samples=self.settings.distance_samples)
        runs = [first]
        while len(runs) < self.settings.repeats and first["cpu"] < LONG_RUN:
            runs.append(self.run(size))
        return {"size": size, "runs": len(runs), **min(runs, key=lambda r: r["cpu"]), **metrics,
                "count_met": abs(metrics["vertices"] / n - 1) <= TOLERANCE}


def first_size(peer, area, n):
    """Edge length of n vertices in equilateral triangles, or n itself."""
    return math.sqrt(2 * area / (math.sqrt(3) * n)) if peer.slope < 0 else float(n)


def bench_model(name, n, peers, settings, keep=None):
    """Rows of all peers on one model; those that cannot be run say why. `keep(peer)`: where its result goes."""
    source, rows, sizes = model(name), [], {}
    area = measure(source)["area"]
    for peer in peers:
        row = {"model": name, "n": n, "feature_angle": settings.feature_angle, "peer": peer.name,
               "family": peer.family, "ours": peer.ours, "reason": peer.reason}
        with tempfile.TemporaryDirectory() as folder:
            try:
                if not peer.reason:
                    size = sizes.get(peer.family, first_size(peer, area, n))
                    bench = Bench(peer, source, settings, folder)
                    row.update(bench.row(source, size, n))
                    if keep:
                        shutil.move(bench.best, keep(peer))
                    sizes[peer.family] = row["size"]
            except (RuntimeError, OSError, ValueError) as fault:
                row["reason"] = str(fault)
        rows.append(row)
        print(line_of(row), flush=True)
    return rows


def line_of(row):
    head = f"{row['model']:<13}{row['n']:>6}  {row['peer']:<34}"
    if row["reason"]:
        return head + row["reason"]
    return head + (f"{row['cpu']:>8.2f}{row['vertices']:>8}{row['angle_min_avg']:>7.2f}{row['angle_min']:>6.1f}"
                   f"{1e3 * row['hausdorff']:>8.2f}{1e3 * row['rms']:>7.3f}{row['pct_valence6']:>6.1f}"
                   f"  {'kept' if row['topology_kept'] else 'changed'}")


def install(peers):
    for peer in peers:
        try:
            peer.install()
        except (RuntimeError, OSError) as fault:
            peer.reason = str(fault)
        print(f"{peer.name:<36}{peer.reason or peer.version}", flush=True)


def angle(text):
    return text if text == "own" else float(text)


def angle_for(name, wanted):
    return OWN_ANGLES.get(name, NO_CREASES) if wanted == "own" else wanted


def arguments():
    names = [p.name for p in all_peers()]
    models = [name for name, _ in cases()]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", nargs="+", choices=models, metavar="MODEL",
                        help="only these of: " + ", ".join(models))
    parser.add_argument("--peers", nargs="+", metavar="WORD",
                        help="the project's default, and those whose name has one of the words: " + "; ".join(names))
    parser.add_argument("--repeats", type=int, default=3, help="runs of each, the least time counts (default 3)")
    parser.add_argument("--feature-angle", type=angle, default=FEATURE_ANGLE, metavar="DEGREES|own",
                        help=f"of all remeshers (default {FEATURE_ANGLE}); {NO_CREASES}: boundaries only; own: at "
                             "which each model has creases worth keeping")
    return parser.parse_args()


def main():
    options = arguments()
    peers = [p for k, p in enumerate(all_peers()) if k == 0 or not options.peers or any(
        word.lower() in p.name.lower() for word in options.peers)]
    install(peers)
    settings = Settings(options.feature_angle, options.repeats)
    rows = []
    for name, n in cases(options.models):
        own = settings._replace(feature_angle=angle_for(name, options.feature_angle))
        rows += bench_model(name, n, peers, own)
    data = {**provenance(" ".join(["./run.sh bench peers", *sys.argv[1:]])), "feature_angle": options.feature_angle,
            "repeats": options.repeats, "time_limit": TIME_LIMIT, "peers": [p.described() for p in peers], "rows": rows}
    write_figures("peers_own_angles.json" if options.feature_angle == "own" else "peers.json", data)
    peers_page.write(data)
    peers_in_readme.write()
    print("\n".join(peers_page.conclusions(data)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
