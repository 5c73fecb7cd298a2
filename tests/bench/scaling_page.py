# SPDX-License-Identifier: GPL-3.0-or-later
"""The section on scaling of README.md and its pictures, from what bench_scaling.py measured in one run."""
import pages
from pages import paragraph, plain_ticks, plt, save

MB = 1 << 20

GROWTH = """Whole runs of the default on {model}, subdivided once by midpoints ({faces:,} faces), feature angle 180
degrees: wall and processor seconds, reading and writing included, and peak memory. {others}"""
QUIET = "Other processes kept at most {most:.1f} cores busy meanwhile."
DISTURBED = """Other processes kept up to {most:.1f} cores busy meanwhile: the wall times, and the gain by threads, are
not to be trusted."""
COST = """Microseconds per vertex and relocation, Delaunay flips, projection and acceptance included: the paper's
method on a bumpy sphere of 82,000 faces, one thread."""


def at(rows, n, threads):
    return next(r for r in rows if r["n"] == n and r["threads"] == threads)


def counts(rows):
    return sorted({r["n"] for r in rows}), sorted({r["threads"] for r in rows})


def growth_table(rows):
    sizes, threads = counts(rows)
    head = ["vertices"] + [f"{t} thread{'s' * (t > 1)}: wall s" for t in threads]
    head += ["gain", "CPU s, 1 thread", f"CPU s, {threads[-1]} threads", f"MB, {threads[-1]} threads"]
    lines = []
    for n in sizes:
        one, most = at(rows, n, threads[0]), at(rows, n, threads[-1])
        lines.append([f"{n:,}"] + [f"{at(rows, n, t)['wall']:.2f}" for t in threads] + [
            f"{one['wall'] / most['wall']:.2f}", f"{one['cpu']:.2f}", f"{most['cpu']:.2f}", f"{most['megabytes']:.0f}"])
    return pages.table(head, lines)


def memory(growth):
    """Bytes by which the peak grows with a face of the input, and with a vertex of the result."""
    rows, original = growth["rows"], growth["original"]
    sizes, _ = counts(rows)
    first, last = at(rows, sizes[0], 1), at(rows, sizes[-1], 1)
    face = (first["megabytes"] - original["megabytes"]) * MB / (growth["faces"] - original["faces"])
    vertex = (last["megabytes"] - first["megabytes"]) * MB / (sizes[-1] - sizes[0]) if len(sizes) > 1 else None
    return face, vertex


def growth_introduction(growth):
    most = max(r["others"] for r in growth["rows"])
    others = (QUIET if most < 0.15 else DISTURBED).format(most=most)
    return GROWTH.format(model=growth["model"], faces=growth["faces"], others=others)


def growth_text(growth):
    rows = growth["rows"]
    sizes, threads = counts(rows)
    largest = at(rows, sizes[-1], threads[-1])
    face, vertex = memory(growth)
    text = (f"{sizes[-1]:,} vertices on all cores ({threads[-1]}): {largest['wall']:.1f} s wall, "
            f"{largest['megabytes']:.0f} MB. From {growth['original']['faces']:,} to {growth['faces']:,} faces of the "
            f"input, at {sizes[0]:,} vertices, the peak grows by {face:.0f} bytes a face")
    if vertex is not None:
        text += (f"; from {sizes[0]:,} to {sizes[-1]:,} vertices of the result by {vertex:.0f} bytes a vertex (one "
                 "thread)")
    return text + "."


def cost_section(rows):
    costs = [r["microseconds"] for r in rows]
    lines = [[f"{r['n']:,}", f"{r['microseconds']:.2f}"] for r in rows]
    return ["", *paragraph(COST), "", *pages.table(("vertices", "microseconds"), lines), "",
            f"The largest is {max(costs) / min(costs):.2f} times the smallest."]


def draw(rows):
    """Wall time against vertices for each number of threads, and the gain by threads for each size."""
    sizes, threads = counts(rows)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8))
    for t in threads:
        left.loglog(sizes, [at(rows, n, t)["wall"] for n in sizes], "o-", markersize=4,
                    label=f"{t} thread{'s' * (t > 1)}")
    largest = at(rows, sizes[-1], 1)["wall"]
    left.loglog(sizes, [largest * n / sizes[-1] for n in sizes], ":", color="grey", label="in proportion")
    left.set_xlabel("vertices")
    left.set_ylabel("wall seconds")
    for n in sizes:
        right.plot(threads, [at(rows, n, 1)["wall"] / at(rows, n, t)["wall"] for t in threads], "o-", markersize=4,
                   label=f"{n:,} vertices")
    right.plot(threads, threads, ":", color="grey", label="all of it")
    right.set_xscale("log", base=2)
    right.set_yscale("log", base=2)
    right.set_xlabel("threads")
    right.set_ylabel("one thread's wall time / this")
    for axes in (left, right):
        plain_ticks(axes.yaxis)
        axes.grid(alpha=0.3)
        axes.legend(fontsize=7)
    for axis, ticks in ((left.xaxis, sizes), (right.xaxis, threads)):
        axis.set_ticks(ticks, [f"{t:,}" for t in ticks])
        axis.set_ticks([], minor=True)
    save(figure, "scaling.png")


def section(data):
    growth = data["growth"]
    lines = pages.stamp(data, "this section")
    lines += ["", *paragraph(growth_introduction(growth)), ""]
    lines += growth_table(growth["rows"]) + ["", *paragraph(growth_text(growth)), ""]
    return lines + ["![Time against vertices and threads](pictures/scaling.png)"] + cost_section(data["cost"])


def write(data):
    draw(data["growth"]["rows"])
    pages.write_section("scaling", section(data))
