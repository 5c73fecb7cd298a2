#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of meshes: flat-shaded triangles with their edges, side by side under one camera.

    render.py OUT.png MESH.ply [MESH.ply ...] [--titles A,B,...] [--view ELEVATION,AZIMUTH] [--up AXIS]
              [--columns N] [--histogram]

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

MOST_EDGED = 30000  # faces; of more, the edges would cover the picture


class Panel:
    """One mesh under one camera. Panels of the same `frame` show the same part of space; `close`: only that share
    of its width, around `centre` in shares of its size, without a histogram."""

    def __init__(self, path, title="", view=(25, -60), up="z", frame=None, close=0.0, centre=(0.5, 0.5)):
        self.points, self.faces = read_ply(path)
        self.title, self.view, self.up, self.close, self.centre = title, view, up, close, centre
        self.frame = self if frame is None else frame

    def camera(self):
        return self.points @ rotation(*self.view, self.up).T

    def visible(self):
        """Which faces to draw: all, but of a closed surface whose faces agree only those turned to the camera. Faces
        are sorted by their centroids, which is wrong for needles."""
        a, b = self.faces.astype(np.int64).ravel(), np.roll(self.faces, -1, 1).astype(np.int64).ravel()
        count = len(self.points)
        if not np.array_equal(np.sort(a * count + b), np.sort(b * count + a)):
            return np.ones(len(self.faces), bool)
        corner = self.camera()[self.faces]
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        outward = np.sign((normal * (corner[:, 0] - corner[0, 0])).sum())
        return outward * normal[:, 2] > 0


def rotation(elevation, azimuth, up="z"):
    """Camera axes as rows: right, up, towards the viewer. The azimuth runs around the axis `up`."""
    e, a = np.radians([elevation, azimuth])
    back = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0])
    return np.roll(np.stack([right, np.cross(back, right), back]), "zxy".index(up), axis=1)


def draw(axes, camera, faces, count, colour=(0.62, 0.75, 0.9)):
    """Triangles of a mesh or part of one that has `count` of them, those that cannot be seen included."""
    corners = camera[faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = np.array([0.3, 0.5, 0.8]) / np.linalg.norm([0.3, 0.5, 0.8])
    shade = 0.35 + 0.65 * np.abs(normal @ light)
    order = np.argsort(corners[:, :, 2].mean(1))
    width = 0.35 * min(1.0, (3000 / max(count, 1)) ** 0.5) + 0.05
    edges = "face" if count > MOST_EDGED else (0.1, 0.12, 0.2)
    axes.add_collection(PolyCollection(corners[order][:, :, :2], facecolors=np.outer(shade, colour)[order],
                                       edgecolors=edges, linewidths=width))


def window(panels):
    """Lower left and upper right of what panels of one frame show, with a margin."""
    flat = np.concatenate([p.camera()[np.unique(p.faces), :2] for p in panels])
    low, high = flat.min(0), flat.max(0)
    return low - 0.03 * (high - low), high + 0.03 * (high - low)


def show(axes, panel, low, high):
    camera, faces, visible = panel.camera(), panel.faces, panel.visible()
    if panel.close:
        middle, half = low + panel.centre * (high - low), panel.close * max(high - low) / 2
        low, high = middle - half, middle + half
        corners = camera[faces][:, :, :2]
        inside = np.all((corners.max(1) > low) & (corners.min(1) < high), axis=1)
        faces, visible = faces[inside], visible[inside]
    draw(axes, camera, faces[visible], len(faces))
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_title(panel.title, fontsize=10)


def show_angles(axes, panel):
    axes.axis("on")
    axes.hist(angles(panel.points, panel.faces).ravel(), bins=60, range=(0, 180), color=(0.35, 0.5, 0.75))
    axes.set_xlim(0, 180)
    axes.set_xticks([0, 30, 60, 90, 120, 150, 180])
    axes.set_yticks([])
    axes.set_xlabel("angles (deg)", fontsize=8)


def picture(out, panels, columns, size=4.5, histogram=False):
    """The panels in rows of so many; with `histogram` the angles of each under it."""
    rows = [panels[k:k + columns] for k in range(0, len(panels), columns)]
    charted = [histogram and not all(p.close for p in row) for row in rows]
    heights = [h for chart in charted for h in ((1, 0.35) if chart else (1,))]
    figure, grid = plt.subplots(len(heights), columns, squeeze=False, gridspec_kw={"height_ratios": heights},
                                figsize=(size * columns, size * sum(heights)))
    for axes in grid.flat:
        axes.axis("off")
    at = iter(grid)
    for row, chart in zip(rows, charted):
        for axes, panel in zip(next(at), row):
            show(axes, panel, *window([p for p in panels if p.frame is panel.frame]))
        for axes, panel in zip(next(at), row) if chart else ():
            if not panel.close:
                show_angles(axes, panel)
    figure.tight_layout()
    figure.savefig(out, dpi=110, bbox_inches="tight")
    plt.close(figure)


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
    parser.add_argument("--up", choices="xyz", default="z", help="the axis that points up (default z)")
    parser.add_argument("--columns", type=int, default=0)
    parser.add_argument("--size", type=float, default=4.5)
    parser.add_argument("--histogram", action="store_true")
    options = parser.parse_args()
    view = tuple(float(x) for x in options.view.split(","))
    titles = options.titles.split(",") if options.titles else [""] * len(options.meshes)
    panels = [Panel(path, title, view, options.up) for path, title in zip(options.meshes, titles)]
    picture(options.out, panels, options.columns or len(panels), options.size, options.histogram)
    return 0


if __name__ == "__main__":
    sys.exit(main())
