# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 3(d), 4(c) and 4(d): the average smallest angle from iteration to iteration, mean over several seeds."""
import csv
import json
import os
import statistics
import subprocess
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor

from models import source
from common import PROGRAM
from pages import plt, save

ANGLE_CURVE = os.path.join(os.path.dirname(PROGRAM), "angle_curve")
Budget = namedtuple("Budget", "seeds local_iterations global_iterations many lambdas few")
# `many`: the NL with which every round reaches a local optimum; `few`: the NL of figure 4(d) besides.
FULL = Budget(10, 50, 100, 50, (0.05, 0.1, 0.2, 0.4, 0.8), (1, 2, 3, 4))
QUICK = Budget(2, 10, 6, 5, (0.1, 0.2, 0.4), (1, 2, 3))
LAMBDA = 0.2  # the paper's choice
STAGES = ("initial", "local", "global")  # whose meshes are kept


def stage_file(folder, stage):
    return os.path.join(folder, "meshes", f"plank_{stage}.ply")


def run(case, result, seed, *settings):
    """The curve and the seconds of one run."""
    command = [ANGLE_CURVE, source(case), result, str(case.vertices), str(seed), *map(str, settings)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"angle_curve: {done.stderr.strip()}")
    return json.loads(done.stdout)


def summary(runs):
    """Mean over the seeds, iteration by iteration, and how far the seeds differ at the end."""
    ends = [r["angles"][-1] for r in runs]
    return {"mean": [statistics.fmean(column) for column in zip(*(r["angles"] for r in runs))],
            "ends": ends, "deviation": statistics.stdev(ends)}


def measure_curves(case, folder, budget):
    """The curves of all three figures; those of the same settings once."""
    rounds = budget.global_iterations
    settings = [("local", budget.local_iterations)]
    settings += [("global", x, budget.many, rounds) for x in budget.lambdas]
    settings += [("global", LAMBDA, nl, rounds) for nl in budget.few]
    kept = {("local", budget.local_iterations): "local", ("global", LAMBDA, budget.many, rounds): "global"}

    def one(job):
        setting, seed = job
        keep = kept.get(setting) if seed == 1 else None
        return run(case, stage_file(folder, keep) if keep else "-", seed, *setting)

    jobs = [(setting, seed) for setting in settings for seed in range(1, budget.seeds + 1)]
    run(case, stage_file(folder, "initial"), 1, "local", 0)
    alone = one(jobs[0])  # for the time
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        runs = dict(zip(jobs, pool.map(one, jobs)))
    means = {setting: summary([runs[setting, seed] for seed in range(1, budget.seeds + 1)]) for setting in settings}
    return {"model": case.name, "vertices": case.vertices, **budget._asdict(), "seconds": alone["seconds"],
            "local": means[settings[0]],
            "lambda": {str(x): means["global", x, budget.many, rounds] for x in budget.lambdas},
            "NL": {str(nl): means["global", LAMBDA, nl, rounds] for nl in (*budget.few, budget.many)}}


def draw_local(data, folder):
    figure, axes = plt.subplots(figsize=(9, 4))
    mean = data["local"]["mean"]
    axes.plot(range(len(mean)), mean, ".-", label=f"{data['model']},\n{data['vertices']:,} vertices")
    axes.axvline(5, color="gray", linestyle=":", label="the paper: little\nis gained after 5")
    finish(figure, axes, "local iterations", "figure_3d.png", folder)


def draw_global(data, kind, name, folder):
    """Figure 4(c), over lambda, or 4(d), over NL; the reference line belongs to lambda 0.2 and NL 50."""
    figure, axes = plt.subplots(figsize=(9, 4))
    for value, curve in data[kind].items():
        axes.plot(range(len(curve["mean"])), curve["mean"], label=f"{'λ' if kind == 'lambda' else kind} = {value}")
    axes.axhline(54, color="gray", linestyle=":", label="the paper: above 54°\nafter 100 (λ = 0.2, NL = 50)")
    finish(figure, axes, "global iterations", name, folder)


def finish(figure, axes, label, name, folder):
    axes.set_xlabel(label)
    axes.set_ylabel("average smallest angle, degrees")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, name, folder)


def draw(data, folder):
    draw_local(data, folder)
    draw_global(data, "lambda", "figure_4c.png", folder)
    draw_global(data, "NL", "figure_4d.png", folder)


def write_csv(path, data):
    """One line for each iteration of each curve."""
    with open(path, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(("figure", "setting", "iteration", "mean_smallest_angle"))
        curves = [("3(d)", "local", data["local"])] + [
            (figure, f"{kind} = {value}", curve) for figure, kind in (("4(c)", "lambda"), ("4(d)", "NL"))
            for value, curve in data[kind].items()]
        for figure, setting, curve in curves:
            writer.writerows((figure, setting, k, angle) for k, angle in enumerate(curve["mean"]))
