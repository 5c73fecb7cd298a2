#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The relocation rules beside one another: the meshes that they make, in what time, and of what density.

Three parts: rules, all rules with both optimisers and with uniform and curvature density on the models at hand;
time, the average smallest angle for several numbers of iterations; slope, how the vertex density follows the
wanted one for several gammas. Seconds are processor seconds of the whole process on one thread, reading and
writing included. Writes build/bench/rules.json, tests/bench/RULES.md and its pictures.
"""
import argparse
import os
import sys
import tempfile

import density_slope
import rules_page
from common import MESHES, PROGRAM, cases, measure, model, provenance, usage_of, write_figures
from density_slope import np, read_ply

FEATURE_ANGLE = 40  # degrees, the command line's default
PARTS = ("rules", "time", "slope")
RULES = ("cpt", "cvt", "odt")
OPTIMISERS = {"accelerated": (), "annealing": ("--sampler", "random")}
GAMMAS = {"accelerated": 2.0, "annealing": 0.2}  # the defaults of --density-exponent
DENSITIES = ("uniform", "curvature")
ITERATIONS = (2, 5, 10, 20, 40, 80)
REAL = os.path.isdir(MESHES)
TIME_MODELS = ("joint", "pig", "bunny_scan") if REAL else ("cad_part", "bumpy", "bust")
SLOPE_MODELS = ("pig", "gargoyle", "lion_vase") if REAL else ("bumpy", "high_genus", "bust")
SLOPE_GAMMAS = (1, 2, 3)
ANALYTIC = ("analytic", 10000)  # stands among the models for density_slope.analytic_sphere()


class Runner:
    """Runs the program into a folder of its own."""

    def __init__(self, folder, repeats):
        self.folder, self.repeats = folder, repeats
        self.result = os.path.join(folder, "result.ply")
        self.analytic = os.path.join(folder, "analytic.ply")

    def run(self, source, n, optimiser, rule, *options):
        """Processor seconds, the least of the repeats; the mesh is in `result`."""
        command = [PROGRAM, source, self.result, "--vertices", str(n), "--feature-angle", str(FEATURE_ANGLE),
                   "--optimizer", optimiser, *OPTIMISERS[optimiser], "--relocation", rule, "--threads", "1", "--quiet",
                   *options]
        return min(usage_of(command).cpu for _ in range(self.repeats))

    def source(self, name):
        if name != ANALYTIC[0]:
            return model(name)
        if not os.path.exists(self.analytic):
            density_slope.analytic_sphere(self.analytic)
        return self.analytic


def combinations(*values):
    """Every rule with every optimiser and with each of the values."""
    return [(optimiser, rule, value) for value in values for optimiser in OPTIMISERS for rule in RULES]


def energy(source, result, density, optimiser):
    points, faces = read_ply(result)
    phi = np.ones(len(points))
    if density != "uniform":
        phi = density_slope.wanted_density(source, result, density, FEATURE_ANGLE, optimiser == "accelerated")[1]
    return density_slope.energy_excess(points, faces, phi, GAMMAS[optimiser])


def rows_of(models, varied, values, figures):
    """A row for each model, optimiser, rule and value of what is varied, with what figures(row) adds to it.

    Those that fail are left out, and said to be.
    """
    rows = []
    for name, n in models:
        for optimiser, rule, value in combinations(*values):
            row = {"model": name, "n": n, "optimiser": optimiser, "rule": rule, varied: value}
            text = f"{name:<13}{optimiser:<12}{rule:<5}{varied} {value:<10}"
            try:
                row.update(figures(row))
                rows.append(row)
            except RuntimeError as fault:
                text += str(fault)
            print(text + rules_page.line_of(row), flush=True)
    return rows


def bench_rules(runner, models):
    def figures(row):
        source = model(row["model"])
        cpu = runner.run(source, row["n"], row["optimiser"], row["rule"], "--density", row["density"])
        return {"cpu": cpu, "energy": energy(source, runner.result, row["density"], row["optimiser"]),
                **measure(source, runner.result)}
    return rows_of(models, "density", DENSITIES, figures)


def bench_time(runner, models):
    def figures(row):
        cpu = runner.run(model(row["model"]), row["n"], row["optimiser"], row["rule"], "--global-iterations",
                         str(row["iterations"]))
        return {"cpu": cpu, "angle": measure(runner.result)["angle_min_avg"]}
    return rows_of(models, "iterations", ITERATIONS, figures)


def bench_slope(runner, models):
    def figures(row):
        source, kind = runner.source(row["model"]), "quality" if row["model"] == ANALYTIC[0] else "curvature"
        runner.run(source, row["n"], row["optimiser"], row["rule"], "--density", kind, "--density-exponent",
                   str(row["gamma"]))
        limited = kind == "curvature" and row["optimiser"] == "accelerated"
        return {"limited": limited, **density_slope.slopes(source, runner.result, kind, FEATURE_ANGLE, limited)}
    return rows_of(models, "gamma", SLOPE_GAMMAS, figures)


def arguments():
    models = [name for name, _ in cases()]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", nargs="+", choices=models + [ANALYTIC[0]], metavar="MODEL",
                        help=f"only these, in every part, of: {', '.join(models)}; {ANALYTIC[0]}: the part slope only")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS, help="only these parts")
    parser.add_argument("--repeats", type=int, default=1, help="runs of each, the least time counts (default 1)")
    return parser.parse_args()


def main():
    options = arguments()
    models = cases(options.models)
    analytic = [ANALYTIC] if not options.models or ANALYTIC[0] in options.models else []
    data = {**provenance(" ".join(["./run.sh bench rules", *sys.argv[1:]])), "feature_angle": FEATURE_ANGLE,
            "real": REAL, "rules": [], "time": [], "slope": []}
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(folder, options.repeats)
        if "rules" in options.parts:
            data["rules"] = bench_rules(runner, models)
        if "time" in options.parts:
            data["time"] = bench_time(runner, [case for case in models if case[0] in TIME_MODELS])
        if "slope" in options.parts:
            data["slope"] = bench_slope(runner, [case for case in models if case[0] in SLOPE_MODELS] + analytic)
    write_figures("rules.json", data)
    rules_page.write(data)
    return 0


if __name__ == "__main__":
    sys.exit(main())
