# SPDX-License-Identifier: GPL-3.0-or-later
"""PEERS.md or PEERS_OWN_ANGLES.md and its pictures, from the rows that bench_peers.py measured in one run."""
import os
import statistics

import pages
from common import HERE
from pages import paragraph, plain_ticks, plt, save

PAGE, OWN_PAGE = os.path.join(HERE, "PEERS.md"), os.path.join(HERE, "PEERS_OWN_ANGLES.md")
FEATURES = """- *Features*: every remesher, ours too, got the feature angle {feature_angle:g} degrees on all models; 40 is
  the command line's default. Who takes every edge that turns by more for a crease does badly on noise.
  [PEERS_OWN_ANGLES.md](PEERS_OWN_ANGLES.md) compares at each model's own angle."""
OWN_FEATURES = ("- *Features*: every remesher, ours too, got the feature angle at which the model has creases worth "
                "keeping: {angles}. [PEERS.md](PEERS.md) compares at one angle, the command line's default, on all "
                "models.")
COLUMNS = ("remesher", "CPU s", "CPU / ours", "start s", "vertices", "average smallest angle", "smallest angle",
           "angles < 30 %", "[FB99] average", "Hausdorff", "RMS", "valence 6 %", "topology")
TEXTS = ("model", "remesher", "which", "version", "takes", "settings", "state", "topology", "Hausdorff at most",
         "RMS at most")
# The remeshers of the field, by the families of peers.py: those that follow creases and take an edge length.
FIELD = {"explicit": "MeshLab's explicit remeshing", "cgal": "CGAL",
         "botsch": "gpytoolbox's Botsch-Kobbelt (the kind that PMP has too)", "gmsh": "Gmsh", "mmgs": "mmgs"}


def table(head, rows):
    return pages.table(head, rows, TEXTS)


def measured(data, name):
    """The rows of one model that have figures."""
    return [r for r in data["rows"] if r["model"] == name and not r["reason"]]


def models_of(data):
    return list(dict.fromkeys((r["model"], r["n"]) for r in data["rows"]))


def reference(data, name):
    """The row that ratios refer to: the project's default."""
    return next((r for r in measured(data, name) if r["ours"]), None)


def rivals(data, name):
    """The other remeshers' rows whose vertex count came out as asked for."""
    return [r for r in measured(data, name) if not r["ours"] and r["count_met"]]


def cells(row, ours):
    ratio = f"{row['cpu'] / ours['cpu']:.2f}" if ours else ""
    name = f"**{row['peer']}**" if row["ours"] else row["peer"]
    return [name, f"{row['cpu']:.2f}", ratio, f"{row['start']:.2f}",
            f"{row['vertices']:,}" + ("" if row["count_met"] else " (off)"), f"{row['angle_min_avg']:.2f}",
            f"{row['angle_min']:.1f}", f"{row['pct_lt30']:.3f}", f"{row['q_fb99_avg']:.3f}",
            f"{1e3 * row['hausdorff']:.2f}", f"{1e3 * row['rms']:.3f}", f"{row['pct_valence6']:.1f}",
            "kept" if row["topology_kept"] else "**changed**"]


def model_section(data, name, n):
    rows = sorted(measured(data, name), key=lambda r: -r["angle_min_avg"])
    lines = ["", f"### {name}, {n:,} vertices", ""]
    lines += table(COLUMNS, [cells(r, reference(data, name)) for r in rows])
    known = {p["name"] for p in data["peers"] if p["reason"]}
    failed = [r for r in data["rows"] if r["model"] == name and r["reason"] and r["peer"] not in known]
    return lines + ([""] if failed else []) + [f"- {r['peer']}: no result, {r['reason']}" for r in failed]


def marked(row):
    """A remesher's name in the summary, with a sign where it changed the topology."""
    return row["peer"] + ("" if row["topology_kept"] else " †")


def verdict(data, ours):
    """Of one row of ours: whether it is at least as close as the best of the field, and the ratio of the times."""
    field = [r for r in rivals(data, ours["model"]) if r["family"] in FIELD]
    if not field:
        return None
    best = {key: min(field, key=lambda r: r[key]) for key in ("hausdorff", "rms")}
    fast = min(rivals(data, ours["model"]), key=lambda r: r["cpu"])
    return {"model": ours["model"], "angle": ours["angle_min_avg"], "ratio": ours["cpu"] / fast["cpu"], "fast": fast,
            **{key: (ours[key] <= row[key], row) for key, row in best.items()}}


def verdicts(data, mode):
    """Those of one of the project's modes, of the models where there is something to compare with."""
    found = [verdict(data, r) for r in data["rows"] if r["peer"] == mode["name"] and not r["reason"]]
    return [v for v in found if v]


def conclusion(mode, found):
    """One sentence."""
    ratios = [v["ratio"] for v in found]
    near, even = (sum(v[key][0] for v in found) for key in ("hausdorff", "rms"))
    lower = [v["angle"] - row["angle_min_avg"] for v in found for key in ("hausdorff", "rms")
             for ok, row in [v[key]] if not ok]
    price = f" The averages of those that are closer are lower by {min(lower):.1f} to {max(lower):.1f} degrees." \
        if lower else ""
    return (f"{mode['name']}: of {len(found)} models, Hausdorff at most that of the best of the field on {near}, RMS "
            f"on {even}; processor time over the fastest remesher's {min(ratios):.2f} to {max(ratios):.2f}, median "
            f"{statistics.median(ratios):.2f}, at most 1 on {sum(r <= 1 for r in ratios)}.{price}")


def field_of(data):
    """The remeshers of the field that have a result, in words."""
    there = {r["family"] for r in data["rows"] if not r["reason"]}
    *names, last = [name for family, name in FIELD.items() if family in there] or ["none"]
    return (", ".join(names) + " and " if names else "") + last


def our_modes(data):
    return [p for p in data["peers"] if p["ours"] and not p["reason"]]


def conclusions(data):
    """A sentence for each of the project's modes."""
    return [conclusion(mode, found) for mode in our_modes(data) for found in [verdicts(data, mode)] if found]


def conclusions_section(data):
    lines = []
    for sentence in conclusions(data):
        first, *rest = paragraph(sentence)
        lines += ["- " + first, *("  " + line for line in rest)]
    for mode in our_modes(data):
        rows = [[v["model"]] + [text for key in ("hausdorff", "rms") for text in (
                    "yes" if v[key][0] else "**no**", marked(v[key][1]))]
                + [f"{v['ratio']:.2f}", marked(v["fast"])] for v in verdicts(data, mode)]
        head = ("model", "Hausdorff at most", "which", "RMS at most", "which", "our CPU / fastest peer's", "which")
        lines += ["", f"### {mode['name']}", ""] + table(head, rows) if rows else []
    return lines


def summary_row(data, name, ours):
    others = rivals(data, name)
    fast, near, even, best = (min(others, key=key) for key in (
        lambda r: r["cpu"], lambda r: r["hausdorff"], lambda r: r["rms"], lambda r: -r["angle_min_avg"]))
    return [name, f"{ours['cpu']:.2f}", f"{fast['cpu'] / ours['cpu']:.2f}", marked(fast),
            f"{near['hausdorff'] / ours['hausdorff']:.2f}", marked(near), f"{even['rms'] / ours['rms']:.2f}",
            marked(even), f"{ours['angle_min_avg']:.2f}", f"{best['angle_min_avg']:.2f}", marked(best)]


def summary(data):
    """One table for each of the project's modes that has figures."""
    lines = []
    head = ("model", "our CPU s", "fastest peer's / ours", "which", "least Hausdorff / ours", "which",
            "least RMS / ours", "which", "our angle", "best peer's", "which")
    for peer in our_modes(data):
        rows = [summary_row(data, r["model"], r) for r in data["rows"]
                if r["peer"] == peer["name"] and not r["reason"] and rivals(data, r["model"])]
        lines += ["", f"### {peer['name']}", ""] + table(head, rows)
    return lines


def peers_section(data):
    rows = [[p["name"], p["version"] or "-", p["takes"], p["settings"], p["reason"] or "ran"] for p in data["peers"]]
    return table(("remesher", "version", "takes", "settings", "state"), rows)


def colours(data):
    """One colour for each remesher, the same in all pictures: strong ones first."""
    palette = plt.get_cmap("tab20").colors
    palette = palette[0::2] + palette[1::2]
    return {p["name"]: palette[k % len(palette)] for k, p in enumerate(data["peers"])}


def draw_quality(data, picture):
    """A dot for each model and remesher, and a large one at each remesher's medians."""
    figure, axes = plt.subplots(figsize=(9, 5.5))
    for name, colour in colours(data).items():
        points = [(r["cpu"] / reference(data, r["model"])["cpu"], r["angle_min_avg"]) for r in data["rows"]
                  if r["peer"] == name and not r["reason"] and r["count_met"] and reference(data, r["model"])]
        if points:
            x, y = zip(*points)
            axes.plot(x, y, ".", color=colour, alpha=0.5, markersize=5)
            marker = "*" if name.startswith("CCDM") else "o"
            axes.plot(statistics.median(x), statistics.median(y), marker, color=colour, markeredgecolor="black",
                      markersize=14 if marker == "*" else 9, label=name, linestyle="none")
    axes.set_xscale("log")
    plain_ticks(axes.xaxis)
    axes.set_xlabel("processor time / that of the project's default (large: median over the models)")
    axes.set_ylabel("average smallest angle, degrees")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, picture)


def draw_histograms(data, names, picture):
    """All angles of the project's default and of the three others with the best average."""
    figure, axes = plt.subplots(1, len(names), figsize=(4.2 * len(names), 3.4), squeeze=False)
    for ax, name in zip(axes[0], names):
        best = sorted(rivals(data, name), key=lambda r: -r["angle_min_avg"])[:3]
        for row in [reference(data, name)] + best:
            bins = row["angle_histogram"]
            width = 180 / len(bins)
            share = [100 * count / sum(bins) for count in bins]
            ax.step([width * k for k in range(len(bins))], share, where="post", label=row["peer"],
                    color=colours(data)[row["peer"]], linewidth=2 if row["ours"] else 1.2)
        ax.set_xlim(20, 110)
        ax.set_title(name, fontsize=10)
        ax.set_xlabel("angle, degrees")
        ax.legend(fontsize=6)
    axes[0][0].set_ylabel("% of all angles")
    save(figure, picture)


def draw(data):
    """The pictures; returns the lines that show those that could be drawn."""
    suffix = "_own_angles" if has_own_angles(data) else ""
    draw_quality(data, f"quality{suffix}.png")
    lines = ["", f"![Quality against time](pictures/quality{suffix}.png)"]
    shown = [name for name, _ in models_of(data) if reference(data, name) and rivals(data, name)]
    if shown:
        # The first, the middle and the last stand for parts, for small shapes and for large ones.
        picked = list(dict.fromkeys((shown[0], shown[len(shown) // 2], shown[-1])))
        draw_histograms(data, picked, f"angles{suffix}.png")
        lines += ["", f"![Angles](pictures/angles{suffix}.png)"]
    return lines


INTRODUCTION = """Absolute times depend on the machine; the ratios are what counts.

- *Time*: user + system seconds of the whole process on one core, reading and writing included, less the
  seconds ("start") that starting Python and importing a package took. The least of the runs counts
  ({repeats} at most). A run may take {time_limit} s.
{features}
- *Size*: who takes an edge length, or does not meet a vertex count, got a size calibrated until the count was
  within 3 %; "off" marks where that could not be had.
- *Figures*: angles in degrees; Hausdorff and RMS in 1e-3 of the bounding box's diagonal, the larger of both
  directions; topology is Euler characteristic, components, boundary loops, orientability, manifoldness. All
  measured by the project's `mesh_quality.h`.
"""
CONCLUSIONS = """The field: {field}; each column takes the best row of these; the fastest is that of all remeshers. Rows
whose count is off are left out; † changed the topology."""
SUMMARY = """Ratios above 1: the best of the others needs more time, or is farther from the input, than ours. Rows
whose count is off are left out; each column has its own best; † changed the topology."""


def has_own_angles(data):
    return data["feature_angle"] == "own"


def features(data):
    """What the remeshers were told of creases."""
    if not has_own_angles(data):
        return FEATURES.format(**data)
    angles = [f"{angle:g} degrees for {', '.join(name for (name,) in pages.groups(rows, 'model'))}"
              for (angle,), rows in sorted(pages.groups(data["rows"], "feature_angle").items())]
    first, *rest = paragraph(OWN_FEATURES.format(angles="; ".join(angles)))
    return "\n".join([first, *("  " + line for line in rest)])


def write(data):
    own = has_own_angles(data)
    title = "# Beside other remeshers" + (", at each model's own feature angle" if own else "")
    lines = [title, ""] + pages.stamp(data, "this page")
    lines += ["", INTRODUCTION.format(features=features(data), **data), "## Conclusions", ""]
    lines += [*pages.paragraph(CONCLUSIONS.format(field=field_of(data))), "", *conclusions_section(data)]
    lines += ["", "## Summary", "", SUMMARY] + summary(data) + draw(data)
    lines += ["", "## Remeshers", ""] + peers_section(data) + ["", "## Models"]
    for name, n in models_of(data):
        lines += model_section(data, name, n)
    pages.write_page(OWN_PAGE if own else PAGE, lines)
