# SPDX-License-Identifier: GPL-3.0-or-later
"""The page index.md, and index.html where Python-Markdown is at hand, from what reproduce.py measured in one run."""
import os

import tables
from pages import paragraph, stamp, table, write_page
from pictures import SINGLE

try:
    import markdown
except ImportError:
    markdown = None

INTRODUCTION = """Tables and figures of *Isotropic Surface Remeshing Using Constrained Centroidal Delaunay Mesh*
(Z. Chen, J. Cao, W. Wang, Computer Graphics Forum 31(7), 2012), made anew by this program, beside what the
paper prints. The printed rows are another machine's (a laptop, 2.66 GHz) and other files' of the same or a like
subject: their times and errors cannot be set against the measured ones, and ratios within each are what counts.
*The paper's method* is `{method}`; the default mode is the project's own. Both add closing steps to what the
paper describes."""
SAMPLES = """The real models are not at hand: the project's own samples stand for them, most of other subjects."""
QUICK = """A short run: a tenth of the vertices, few seeds and rounds, none of the other remeshers. It shows that the
page can be made, and says nothing about the method."""
READING = """Seconds: user + system of the whole process on one core, one process at a time, reading and writing
included, less the start of Python; one run each, of at most {time_limit:g} s. ∠ avg: average over the triangles
of their smallest angle; ∠ min: smallest angle; < 30°: share of all angles; aspect ratio after [FB99]; error:
Hausdorff distance, the larger of both directions, in 1e-3 of the bounding box's diagonal. The measured figures
are by the project's `mesh_quality.h`, for all remeshers, with {distance_samples:,} points on each surface for
the distance. Feature angle {feature_angle:g} degrees for all remeshers, uniform density for all but the row
named after the curvature. Who takes an edge length got one that was calibrated until the count was within 3 %;
"off" marks where that could not be had."""
KINDS = """Of the paper's rivals, [BK04] is the kind of MeshLab's explicit remeshing and of CGAL's, 20 iterations as
there; [VCP08] is that of pyacvd, with 50 vertices of the input for each of the result as there. None of the remeshers
that pip and apt offer is [YLL\\*09] or [FAKG10]. Left out, for the time they take: the other remeshers and settings
of `./run.sh bench peers`; `--peers WORD ...` picks others."""
SLIPPED = """In the copy of Table 1 that was read, the name Klein Bottle stands one row lower and that of Moai is
missing. Section 4 says that the five methods of the last block are compared on Moai, and 3.97 s suits the Klein
bottle's 5,000 vertices; the rows are named accordingly, and Moai's vertex counts are not known."""
CURVES = """Random samples, curvature density with ρ = φ^(1/5), no features but boundaries, none of the closing steps:
the state after each iteration as the paper describes it, {vertices:,} vertices on {model}, mean of {seeds} seeds.
Iteration 0 of the global optimisation is the first local optimum. 4(c): NL = {many}; 4(d): λ = 0.2."""


def image(name, text):
    return ["", f"![{text}]({name})"]


def models_section(cases, plank, before):
    rows = [[c.paper, c.name, f"{before[c.name]:,}", f"{c.vertices:,}", c.why] for c in (*cases, plank)]
    return table(("the paper's model", "here", "its vertices", "remeshed to", "how far it stands for it"), rows,
                 ("the paper's model", "here", "how far it stands for it"))


def table_section(data, number):
    rows = tables.records(data["tables"], number, data["before"])
    lines = ["", f"## Table {number}", "", *table(tables.HEAD, [tables.cells(r) for r in rows], tables.TEXTS)]
    failed = [f"- {r['model']}, {r['peer']}: no result, {r['reason']}" for r in data["tables"]["rows"]
              if r["table"] == number and r["reason"]]
    return lines + ([""] if failed else []) + failed + ([""] + paragraph(SLIPPED) if number == 1 else [])


def remeshers_section(data):
    rows = [[p["name"], p["version"] or "-", p["settings"]] for p in data["tables"]["peers"]]
    return ["", "## Remeshers", "", *table(("remesher", "version", "settings"), rows,
                                           ("remesher", "version", "settings")), "", *paragraph(KINDS)]


def findings(curves):
    """What the paper says of its figures, and the same here."""
    local, rounds, many = curves["local"]["mean"], curves["global_iterations"], str(curves["many"])
    ends = {kind: {v: c["mean"][-1] for v, c in curves[kind].items()} for kind in ("lambda", "NL")}
    best = max(ends["lambda"], key=ends["lambda"].get)
    after = ends["NL"][many]
    return [
        ["3", "10,000 vertices sampled and 50 local iterations take 1.78 s (another machine)",
         f"{curves['vertices']:,} vertices, {curves['local_iterations']} iterations: {curves['seconds']:.2f} s"],
        ["3(d)", "little is gained after the first 5 local iterations",
         f"{local[0]:.2f}° at first, {local[5]:.2f}° after 5, {local[-1]:.2f}° after {len(local) - 1}"],
        ["4", "above 54° after 100 global iterations (λ = 0.2, NL = 50)",
         f"{after:.2f}° after {rounds} (NL = {many})"],
        ["4(c)", "λ = 0.2 works well", "after the last: " + ", ".join(
            f"λ = {x}: {angle:.2f}°" for x, angle in ends["lambda"].items()) + f"; the best is {best}"],
        ["4(d)", "NL of 2 and more does comparably", "after the last: " + ", ".join(
            f"NL = {nl}: {angle:.2f}°" for nl, angle in ends["NL"].items())]]


def curves_section(data):
    curves = data["curves"]
    head = ("figure", "the paper", "here")
    spread = max(c["deviation"] for kind in ("lambda", "NL") for c in curves[kind].values())
    lines = ["", "## Figures 3 and 4", "", *paragraph(CURVES.format(**curves) + f" The seeds differ at the end by a "
                                                      f"standard deviation of {spread:.2f}° at most."), ""]
    lines += table(head, findings(curves), head)
    lines += image("figure_3d.png", "Figure 3(d): local iterations")
    lines += image("figure_4c.png", "Figure 4(c): lambda") + image("figure_4d.png", "Figure 4(d): NL")
    return lines + image("figures_3_4.png", "Figures 3 and 4: the input, the samples, both optimisations")


def pictures_section():
    lines = ["", "## Figures 5 to 10", "", *paragraph(
        "Each model before and after under one camera, with the number of vertices, the average smallest angle and "
        "all angles; the results are those of the tables, in `meshes`. Of more than 30,000 triangles only the "
        "close-ups have edges.")]
    for number, (name, method, what) in SINGLE.items():
        lines += ["", f"Figure {number}, {name}: {what}; {method}."]
        lines += image(f"figure_{number}.png", f"Figure {number}")
    lines += ["", "Figure 9: the remeshers on one model."] + image("figure_9.png", "Figure 9")
    lines += ["", f"Figure 10: more models, inputs above; {tables.METHOD}."]
    return lines + image("figure_10.png", "Figure 10")


def write(data, cases, plank, folder):
    """The page, from all data of a run."""
    lines = ["# The paper's tables and figures", "", *stamp(data, "this folder"), ""]
    lines += paragraph(f"Load average of the machine at the start: {data['load']:.1f}.") + [""]
    lines += paragraph(INTRODUCTION.format(method=" ".join(tables.PAPERS_METHOD)))
    for said, text in ((not data["real"], SAMPLES), (data["quick"], QUICK)):
        lines += ["", *paragraph(text)] if said else []
    lines += ["", "## Models", "", *models_section(cases, plank, data["before"])]
    lines += ["", "## Reading the tables", "", *paragraph(READING.format(**data["tables"]))]
    for number in (1, 2):
        lines += table_section(data, number)
    lines += remeshers_section(data) + curves_section(data) + pictures_section()
    lines += ["", "The figures as data: `paper.json`, `table_1.csv`, `table_2.csv`, `curves.csv`."]
    write_page(os.path.join(folder, "index.md"), lines)
    if markdown:
        body = markdown.markdown("\n".join(lines), extensions=["tables"])
        write_page(os.path.join(folder, "index.html"), [HTML.format(body)])


HTML = """<!DOCTYPE html>
<meta charset="utf-8">
<title>The paper's tables and figures</title>
<style>
body {{ font-family: sans-serif; max-width: 75em; margin: 2em auto; padding: 0 1em }}
table {{ border-collapse: collapse; font-size: 85% }}
th, td {{ border-bottom: 1px solid #ccc; padding: 0.2em 0.6em }}
img {{ max-width: 100% }}
</style>
{}"""
