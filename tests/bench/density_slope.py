# SPDX-License-Identifier: GPL-3.0-or-later
"""How the vertex density of a result follows the wanted density phi, and what energy its triangles have.

The weight of the energy is phi^gamma, whose minimum has a vertex density in proportion to phi^(gamma/2).
"""
import math
import os
import subprocess
import sys

from common import ROOT

sys.path.insert(0, os.path.join(ROOT, "sample_meshes"))
import numpy as np
from meshfile import read_ply, write_ply

MEASURE_DENSITY = os.path.join(ROOT, "build", "bin", "measure_density")
GRADATION = 0.1  # the remesher's limit with curvature and the accelerated optimiser (remesher.h, MostGradation)


def analytic_sphere(target):
    """The sample sphere, with a density exp(1.5 z) that grows twentyfold from pole to pole."""
    points, faces = read_ply(os.path.join(ROOT, "sample_meshes", "sphere.ply"))
    write_ply(target, points, faces, quality=np.exp(1.5 * points[:, 2]))


def wanted_density(source, result, kind, angle, limited):
    """phi at the vertices of a result: as the input has it, and as the remesher limits its growth."""
    done = subprocess.run([MEASURE_DENSITY, source, result, kind, str(angle), str(GRADATION if limited else 0)],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError("the density cannot be measured: " + done.stderr.strip())
    return np.array(done.stdout.split(), float).reshape(-1, 2).T


def face_areas(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def star_areas(points, faces):
    """A third of the area of each vertex's star."""
    return np.bincount(faces.ravel(), np.repeat(face_areas(points, faces) / 3, 3), len(points))


def inner_vertices(faces, count):
    """True for those that no boundary edge touches: their stars are whole."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, uses = np.unique(edges, axis=0, return_counts=True)
    inner = np.ones(count, bool)
    inner[edges[uses == 1].ravel()] = False
    return inner


def fit(phi, density):
    """Slope of log density over log phi by least squares; none where phi hardly varies."""
    x, y = np.log(phi), np.log(density)
    return float(np.polyfit(x, y, 1)[0]) if len(x) > 100 and np.ptp(x) > 0.1 else None


def curve(phi, density, bins=12):
    """Medians and quartiles of the density in bins of phi with the same number of vertices, around the medians."""
    x, y = phi / np.median(phi), density / np.median(density)
    parts = np.array_split(np.argsort(x), bins)
    return [[float(np.median(x[p])), *(float(q) for q in np.percentile(y[p], (25, 50, 75)))] for p in parts]


def slopes(source, result, kind, angle, limited):
    """Over all inner vertices, against the phi that the remesher used; and over those where that is the input's."""
    points, faces = read_ply(result)
    raw, phi = wanted_density(source, result, kind, angle, limited)
    inner = inner_vertices(faces, len(points))
    density = 1 / star_areas(points, faces)
    free = inner & (phi <= raw * (1 + 1e-6))
    return {"slope": fit(phi[inner], density[inner]), "free_slope": fit(phi[free], density[free]),
            "free_share": float(free.sum() / inner.sum()), "curve": curve(phi[inner], density[inner])}


def energy_excess(points, faces, phi, gamma):
    """How far F lies above that of equilateral triangles of the ideal density, relative to the latter.

    That of T equilateral triangles of area A is 5/12 * 4 sqrt(3) A^2 / T, with weight rho the integral of
    sqrt(rho) in place of A.
    """
    area = face_areas(points, faces)
    rho = (phi[faces] ** gamma).mean(axis=1)
    squares = sum(((points[faces[:, k]] - points[faces[:, k - 1]]) ** 2).sum(axis=1) for k in range(3))
    ideal = 4 * math.sqrt(3) * (np.sqrt(rho) * area).sum() ** 2 / len(faces)
    return float((rho * area * squares).sum() / ideal - 1)
