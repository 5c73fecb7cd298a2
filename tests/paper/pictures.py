# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 3 to 10 of the paper as pictures: inputs and results under one camera, angle histograms under them."""
import os
import sys

from models import source, view
from common import ROOT
from curves import STAGES, stage_file
from tables import ADAPTIVE, METHOD, result_file

sys.path.insert(0, os.path.join(ROOT, "sample_meshes"))
from render import Panel, angles, picture

CLOSE = 0.25  # of the width
# The paper's figures of single models: the model, the remesher's mode, what the figure shows.
SINGLE = {5: ("Joint", METHOD, "sharp features and needle triangles"),
          6: ("Venus", METHOD, "noise"),
          7: ("Pig", ADAPTIVE, "curvature density and several boundaries"),
          8: ("Klein Bottle", METHOD, "a surface that crosses itself and has one side")}
COMPARED, MORE = "Moai", ("Lion", "Twist", "Foot", "Gargoyle", "Dog")


def panel(path, label, case, frame=None, close=0.0):
    """With the number of vertices and the average smallest angle, found from the file alone."""
    angles_of_view, up, centre = view(case)
    made = Panel(path, label, angles_of_view, up, frame, close, centre)
    average = angles(made.points, made.faces).min(1).mean()
    made.title = f"{label}, close" if close else f"{label}\n{len(set(made.faces.flat)):,} vertices, {average:.1f}°"
    return made


def with_close(paths, labels, case):
    """Panels of several meshes of one model, and close-ups of them."""
    whole = [panel(path, label, case) for path, label in zip(paths, labels)]
    for p in whole[1:]:
        p.frame = whole[0]
    return whole, [panel(path, label, case, whole[0], CLOSE) for path, label in zip(paths, labels)]


def draw_stages(case, folder):
    paths = [source(case)] + [stage_file(folder, stage) for stage in STAGES]
    whole, close = with_close(paths, ["input", "random samples, meshed", "local optimisation", "global optimisation"],
                              case)
    picture(os.path.join(folder, "figures_3_4.png"), whole + close, 4, histogram=True)


def draw_single(number, cases, folder):
    name, method, _ = SINGLE[number]
    case = next(c for c in cases if c.paper == name)
    whole, close = with_close([source(case), result_file(folder, case, method)], ["input", "remeshed"], case)
    picture(os.path.join(folder, f"figure_{number}.png"), whole + close, 2, size=6, histogram=True)


def draw_compared(cases, methods, folder):
    """Figure 9: the input and the results of all remeshers that have one."""
    case = next(c for c in cases if c.paper == COMPARED)
    found = [m for m in methods if os.path.exists(result_file(folder, case, m))]
    whole, close = with_close([source(case)] + [result_file(folder, case, m) for m in found], ["input"] + found, case)
    picture(os.path.join(folder, "figure_9.png"), whole + close, len(whole), size=3.6, histogram=True)


def draw_more(cases, folder):
    """Figure 10, the inputs above."""
    rows = ([], [], [])
    for case in cases:
        if case.paper in MORE:
            whole, close = with_close([source(case), result_file(folder, case, METHOD)], [case.name, "remeshed"], case)
            for row, made in zip(rows, (*whole, close[1])):
                row.append(made)
    picture(os.path.join(folder, "figure_10.png"), [p for row in rows for p in row], len(rows[0]), size=3.6,
            histogram=True)


def draw(cases, plank, methods, folder):
    draw_stages(plank, folder)
    for number in SINGLE:
        draw_single(number, cases, folder)
    draw_compared(cases, methods, folder)
    draw_more(cases, folder)
