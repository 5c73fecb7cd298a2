# SPDX-License-Identifier: GPL-3.0-or-later
"""RULES.md and its pictures, from what bench_rules.py measured in one run."""
import os
import statistics

import pages
from common import HERE
from pages import groups, paragraph, plain_ticks, plt, save

PAGE = os.path.join(HERE, "RULES.md")
TEXTS = ("model", "field", "density", "optimiser", "rule")
COLOURS = {"cpt": "tab:blue", "cvt": "tab:orange", "odt": "tab:green"}
DASHES = {"accelerated": "-", "annealing": "--"}
FIGURES = ("CPU s", "average smallest angle", "smallest angle", "valence 6 %", "RMS", "F over ideal %")

INTRODUCTION = """The rules of `--relocation`: where a vertex goes. *cpt*: the centroid of its star; *cvt*: that of
its Voronoi cell; *odt*: the mean of the circumcentres around it. The accelerated optimiser does its last
relocations by cpt whatever the rule, and its polish of the angles follows. Annealing starts from random samples.
Feature angle {feature_angle:g} degrees; everything else at its default."""
SAMPLES = """The real models are not at hand: these are the project's samples."""
RULES = """CPU: processor seconds of the whole process on one thread. Angles in degrees, RMS in 1e-3 of the bounding
box's diagonal, both by the project's `mesh_quality.h`. F: the energy of the result with the weight that its run
had (gamma 2 with accelerated, 0.2 with annealing), above that of as many equilateral triangles of the ideal
density on a plane of the same area, in percent: comparable between rules, and between models; only for uniform
density between optimisers too."""
SUMMARY = """Sum of the CPU seconds, medians of the other figures, over {count} models."""
TIME = """Whole runs with {iterations} global iterations, uniform density."""
SLOPE = """The slope of log(vertex density) over log(phi), by least squares over the vertices of the result that
are not on a boundary; vertex density is 1 over a third of the area of the star, phi is interpolated in the
nearest triangle of the input by the remesher's own functions (`measure_density`). With the weight phi^gamma the
minimum of the energy has slope gamma / 2; the centroid of the star is no such minimum where the density
changes, and its fixed point is about twice as steep (on a line 2 gamma / 3 instead of gamma / 3); more
iterations come nearer to it. With curvature the accelerated optimiser limits how fast the spacing may grow: the
slope is against that limited phi, and in parentheses over the vertices where the limit changes nothing, with
their share. *analytic*: the sample sphere with exp(1.5 z) as vertex quality, which nothing limits."""


def value(x, digits):
    return "-" if x is None else f"{x:.{digits}f}"


def figures(row):
    return [f"{row['cpu']:.2f}", f"{row['angle_min_avg']:.2f}", f"{row['angle_min']:.1f}", f"{row['pct_valence6']:.1f}",
            f"{1e3 * row['rms']:.3f}", f"{100 * row['energy']:.2f}"]


def line_of(row):
    """The figures of a row of any part, for the terminal."""
    if "energy" in row:
        return "  ".join(figures(row))
    if "angle" in row:
        return f"{row['cpu']:.2f}  {row['angle']:.2f}"
    return "slope " + slope_cell(row) if "slope" in row else ""


def summary(rows):
    lines = []
    for (density, optimiser, rule), part in groups(rows, "density", "optimiser", "rule").items():
        over = {key: statistics.median(r[key] for r in part)
                for key in ("angle_min_avg", "angle_min", "pct_valence6", "rms", "energy")}
        lines.append([density, optimiser, rule] + figures({"cpu": sum(r["cpu"] for r in part), **over}))
    return pages.table(("density", "optimiser", "rule") + FIGURES, lines, TEXTS)


def rules_section(data):
    rows = data["rules"]
    if not rows:
        return []
    count = len(groups(rows, "model"))
    return ["", "## Rules", "", *paragraph(RULES), "", *paragraph(SUMMARY.format(count=count)), "", *summary(rows)]


def models_section(data):
    if not data["rules"]:
        return []
    lines = ["", "## Models"]
    for (name, n), rows in groups(data["rules"], "model", "n").items():
        cells = [[r["density"], r["optimiser"], r["rule"]] + figures(r) for r in rows]
        lines += ["", f"### {name}, {n:,} vertices", ""]
        lines += pages.table(("density", "optimiser", "rule") + FIGURES, cells, TEXTS)
    return lines


def time_section(data):
    if not data["time"]:
        return []
    draw_time(data["time"])
    iterations = ", ".join(str(i) for (i,) in groups(data["time"], "iterations"))
    return ["", "## Quality against time", "", *paragraph(TIME.format(iterations=iterations)), "",
            "![Quality against time](pictures/rules_time.png)"]


def draw_time(rows):
    models = groups(rows, "model", "n")
    figure, axes = plt.subplots(1, len(models), figsize=(4.2 * len(models), 3.8), squeeze=False)
    for ax, ((name, n), part) in zip(axes[0], models.items()):
        for (optimiser, rule), line in groups(part, "optimiser", "rule").items():
            ax.plot([r["cpu"] for r in line], [r["angle"] for r in line], DASHES[optimiser] + "o", color=COLOURS[rule],
                    markersize=3, label=f"{optimiser}, {rule}")
        ax.set_xscale("log")
        plain_ticks(ax.xaxis)
        ax.set_title(f"{name}, {n:,} vertices", fontsize=10)
        ax.set_xlabel("processor seconds")
        ax.grid(alpha=0.3)
    axes[0][0].set_ylabel("average smallest angle, degrees")
    axes[0][-1].legend(fontsize=7)
    save(figure, "rules_time.png")


def slope_cell(row):
    if not row["limited"]:
        return value(row["slope"], 2)
    return f"{value(row['slope'], 2)} ({value(row['free_slope'], 2)}, {100 * row['free_share']:.0f} %)"


def slope_section(data):
    rows = data["slope"]
    if not rows:
        return []
    draw_slope(rows)
    gammas = [gamma for (gamma,) in groups(rows, "gamma")]
    cells = [[name, optimiser, rule] + [
                 next((slope_cell(r) for r in part if r["gamma"] == gamma), "failed") for gamma in gammas]
             for (name, optimiser, rule), part in groups(rows, "model", "optimiser", "rule").items()]
    head = ["field", "optimiser", "rule"] + [f"gamma {g}: {g / 2:g} wanted" for g in gammas]
    return ["", "## Density slope", "", *paragraph(SLOPE), "", *pages.table(head, cells, TEXTS), "",
            "![Vertex density against phi](pictures/rules_slope.png)"]


def draw_slope(rows):
    """The default rule, cvt, with the accelerated optimiser."""
    models = groups([r for r in rows if r["optimiser"] == "accelerated" and r["rule"] == "cvt"], "model")
    figure, axes = plt.subplots(1, len(models), figsize=(3.4 * len(models), 3.4), squeeze=False)
    for ax, ((name,), part) in zip(axes[0], models.items()):
        for row, colour in zip(part, ("tab:purple", "tab:orange", "tab:red")):
            x, low, middle, high = zip(*row["curve"])
            ax.fill_between(x, low, high, color=colour, alpha=0.15)
            ax.loglog(x, middle, "o-", color=colour, markersize=3, label=f"gamma {row['gamma']}")
            ax.loglog((x[0], x[-1]), [end ** (row["gamma"] / 2) for end in (x[0], x[-1])], ":", color=colour)
        for axis in (ax.xaxis, ax.yaxis):
            plain_ticks(axis)
        ax.tick_params(labelsize=7)
        ax.set_title(name, fontsize=10)
        ax.set_xlabel("phi / its median")
        ax.grid(alpha=0.3)
    axes[0][0].set_ylabel("vertex density / its median (dotted: wanted)", fontsize=8)
    axes[0][-1].legend(fontsize=7)
    save(figure, "rules_slope.png")


def rules_answer(rows):
    """For each optimiser the rules by the median of the average smallest angle, the best first; uniform density."""
    sentences = []
    uniform = [r for r in rows if r["density"] == "uniform"]
    for (optimiser,), part in groups(uniform, "optimiser").items():
        found = sorted(((statistics.median(r["angle_min_avg"] for r in some), sum(r["cpu"] for r in some), rule)
                        for (rule,), some in groups(part, "rule").items()), reverse=True)
        sentences.append(f"{optimiser}: " + ", ".join(f"{rule} {angle:.2f} degrees in {cpu:.1f} s"
                                                      for angle, cpu, rule in found))
    return ["Median of the average smallest angle and processor seconds of all models, uniform density, the best rule "
            "first: " + "; ".join(sentences) + "."] if sentences else []


def slope_answer(rows):
    """The slopes with the default of the accelerated optimiser: gamma 2, cvt."""
    found = [r for r in rows if (r["optimiser"], r["rule"], r["gamma"]) == ("accelerated", "cvt", 2) and "slope" in r]
    return ["With the default (accelerated, cvt, gamma 2) the vertex density follows phi with the slopes " +
            ", ".join(f"{value(r['slope'], 2)} ({r['model']})" for r in found) + "; 1 is wanted."] if found else []


def answer(data):
    sentences = rules_answer(data["rules"]) + slope_answer(data["slope"])
    return ["", "## In short", "", *paragraph(" ".join(sentences))] if sentences else []


def write(data):
    lines = ["# Relocation rules", ""] + pages.stamp(data, "this page")
    lines += ["", *paragraph(INTRODUCTION.format(**data) + ("" if data["real"] else " " + SAMPLES))]
    lines += answer(data)
    lines += rules_section(data) + time_section(data) + slope_section(data) + models_section(data)
    pages.write_page(PAGE, lines)
