#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of meshes: flat-shaded triangles with their edges, side by side under one camera.

    render.py OUT.png MESH.ply [MESH.ply ...] [--titles A,B,...] [--view ELEVATION,AZIMUTH] [--columns N]
              [--histogram]

Reads PLY with float or double positions, binary little endian or text, triangles only. With
--histogram the angles of each mesh are plotted under its picture.
"""
import argparse
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from meshfile import read_ply


def rotation(elevation, azimuth):
    """Camera axes as rows: right, up, towards the viewer."""
    e, a = np.radians([elevation, azimuth])
    back = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0])
    return np.stack([right, np.cross(back, right), back])


def draw(axes, points, faces, view, colour=(0.62, 0.75, 0.9)):
    camera = points @ rotation(*view).T
    corners = camera[faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = np.array([0.3, 0.5, 0.8]) / np.linalg.norm([0.3, 0.5, 0.8])
    shade = 0.35 + 0.65 * np.abs(normal @ light)
    order = np.argsort(corners[:, :, 2].mean(1))
    width = 0.35 * min(1.0, (3000 / max(len(faces), 1)) ** 0.5) + 0.05
    axes.add_collection(PolyCollection(corners[order][:, :, :2], facecolors=np.outer(shade, colour)[order],
                                       edgecolors=(0.1, 0.12, 0.2), linewidths=width))


def angles(points, faces):
    """All angles in degrees, (m, 3)."""
    p = points[faces]
    u, w = np.roll(p, -1, 1) - p, np.roll(p, -2, 1) - p
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(u, w), axis=2), (u * w).sum(2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--titles", default="")
    parser.add_argument("--view", default="25,-60")
    parser.add_argument("--columns", type=int, default=0)
    parser.add_argument("--size", type=float, default=4.5)
    parser.add_argument("--histogram", action="store_true")
    options = parser.parse_args()
    view = tuple(float(x) for x in options.view.split(","))
    titles = options.titles.split(",") if options.titles else [""] * len(options.meshes)
    columns = options.columns or len(options.meshes)
    rows = -(-len(options.meshes) // columns)
    heights = [1, 0.35] * rows if options.histogram else [1] * rows
    figure, grid = plt.subplots(len(heights), columns, squeeze=False, gridspec_kw={"height_ratios": heights},
                                figsize=(options.size * columns, options.size * sum(heights)))
    for axes in grid.flat:
        axes.axis("off")
    for k, path in enumerate(options.meshes):
        points, faces = read_ply(path)
        step = 2 if options.histogram else 1
        axes = grid[step * (k // columns)][k % columns]
        draw(axes, points, faces, view)
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.set_title(titles[k], fontsize=10)
        if options.histogram:
            chart = grid[step * (k // columns) + 1][k % columns]
            chart.axis("on")
            chart.hist(angles(points, faces).ravel(), bins=60, range=(0, 180), color=(0.35, 0.5, 0.75))
            chart.set_xlim(0, 180)
            chart.set_xticks([0, 30, 60, 90, 120, 150, 180])
            chart.set_yticks([])
            chart.set_xlabel("angles (deg)", fontsize=8)
    figure.tight_layout()
    figure.savefig(options.out, dpi=110)
    return 0


if __name__ == "__main__":
    sys.exit(main())
