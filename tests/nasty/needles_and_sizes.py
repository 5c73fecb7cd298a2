# SPDX-License-Identifier: GPL-3.0-or-later
"""Nasty inputs: needles, tiny faces; places and sizes."""
import numpy as np

import pieces
from cases import SPHERE, TUBE, again, case, random
from pieces import box, box_corners, moved, sphere

# Needles, and faces far smaller than others.


@case("needles: 3 meridians, 300 rings", SPHERE)
def needle_sphere():
    ring = np.linspace(0, np.pi, 301)
    return pieces.revolved([(0, -1), *((np.sin(t), -np.cos(t)) for t in ring[1:-1]), (0, 1)], 3)


@case("needles: 600 meridians, 4 rings", SPHERE)
def orange():
    ring = np.linspace(0, np.pi, 5)
    return pieces.revolved([(0, -1), *((np.sin(t), -np.cos(t)) for t in ring[1:-1]), (0, 1)], 600)


@case("flat needles from the middle of each side of a box to 200 points of its edges", SPHERE, corners=box_corners(),
      volume=1)
def needle_box():
    points, faces = [], []
    for axis in range(3):
        for end in (0, 1):
            rim = [(0, k / 50) for k in range(50)] + [(k / 50, 1) for k in range(50)] + \
                [(1, 1 - k / 50) for k in range(50)] + [(1 - k / 50, 0) for k in range(50)]
            first = len(points)
            for u, v in rim + [(0.5, 0.5)]:
                p = [0.0, 0.0, 0.0]
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = end, u, v
                points.append(p)
            side = [(first + 200, first + (k + 1) % 200, first + k) for k in range(200)]
            faces += side if end else [f[::-1] for f in side]
    return pieces.welded((np.round(points, 6), faces))


@case("a corner of a face cut off 15 times: faces a billion times smaller than others", SPHERE)
def zoomed_sphere():
    return pieces.zoomed(sphere(2), 0, 15)


@case("cut off 45 times: edges 3e-14 long", SPHERE)
def deeply_zoomed_sphere():
    return pieces.zoomed(sphere(2), 0, 45)


@case("cut off 40 times at a corner of a box and 40 times on an edge of it", SPHERE, corners=box_corners(),
      volume=1)
def zoomed_box():
    points, faces = box(2, 2, 2)
    corner = next(k for k, p in enumerate(points) if tuple(p) == (0, 0, 0))
    middle = next(k for k, p in enumerate(points) if tuple(p) == (1, 1, 0.5))
    return pieces.zoomed(pieces.zoomed((points, faces), corner, 40), middle, 40)


again(zoomed_sphere, "zoomed_sphere_curvature", "the density follows the curvature, of faces a billion times smaller",
      SPHERE, args=("--density", "curvature"))


@case("800 faces in a thousandth of one side of a box that has 12 others", SPHERE, corners=box_corners(),
      volume=1)
def dense_spot():
    points, faces = box(1, 1, 1)
    a, b, c = faces[0]
    middle = len(points)
    points = list(points) + [(points[a] + points[b] + points[c]) / 3]
    faces = faces[1:] + [(a, b, middle), (b, c, middle), (c, a, middle)]
    generator = random(1)
    inner = [t for t in range(len(faces)) if middle in faces[t]]
    corners = np.array([points[v] for v in faces[inner[0]]])
    # Three small points near the middle, then splits of the triangle between them.
    small = [len(points) + k for k in range(3)]
    points += [points[middle] + 0.001 * (p - points[middle]) for p in corners]
    ring = small
    t = faces.pop(inner[0])
    for k in range(3):
        n = (k + 1) % 3
        faces += [(t[k], t[n], ring[n]), (t[k], ring[n], ring[k])]
    parts = [tuple(ring)]
    for _ in range(400):
        a, b, c = parts.pop(generator.randint(len(parts)))
        w = generator.dirichlet((1, 1, 1))
        m = len(points)
        points.append(w[0] * points[a] + w[1] * points[b] + w[2] * points[c])
        parts += [(a, b, m), (b, c, m), (c, a, m)]
    return pieces.used(points, faces + parts)


# Places and sizes.


@case("10,000,000 away from the origin", SPHERE)
def far_away():
    return moved(sphere(2), (1e7, -1e7, 1e7))


@case("1e12 away: coordinates are rounded to 1e-4", SPHERE)
def very_far_away():
    return moved(sphere(2), (1e12, 1e12, 1e12))


@case("10,000,000 away in single precision: 162 vertices in a lattice of 500 places", SPHERE)
def far_away_in_single():
    points, faces = moved(sphere(2), (1e7, 1e7, 1e7), 5.0)
    return points.astype(np.float32), faces


@case("a billionth of a unit wide", SPHERE)
def tiny():
    return moved(sphere(2), scale=1e-9)


@case("1e-150 wide: squares of areas are below what double precision has", SPHERE, simple=True)
def very_tiny():
    return moved(sphere(2), scale=1e-150)


@case("1e-170 wide: squares of lengths are below what double precision has", SPHERE, simple=True)
def vanishing():
    return moved(sphere(2), scale=1e-170)


@case("numbers too small for full precision", SPHERE)
def denormal():
    return moved(sphere(2), scale=1e-310)


@case("1e150 wide: squares of areas are beyond double precision", SPHERE, simple=True)
def huge():
    return moved(sphere(2), scale=1e150)


@case("1e307 wide: squares of lengths are beyond double precision", SPHERE, simple=True)
def very_huge():
    return moved(sphere(2), scale=5e306)


@case("2e308 wide: lengths are beyond double precision", refused="too large for its coordinates")
def too_huge():
    return moved(sphere(2), scale=1e308)


@case("squashed to a millionth: two sheets closer than the spacing, a rim between", SPHERE)
def pancake():
    points, faces = sphere(3)
    return points * (1, 1, 1e-6), faces


@case("stretched a million times", SPHERE)
def stretched():
    points, faces = sphere(2)
    return points * (1e6, 1, 1), faces


@case("an open tube, 10,000 times as long as wide", TUBE)
def long_tube():
    return pieces.revolved([(1, 200.0 * k) for k in range(51)], 8)


@case("a closed rod of square section, a million times as long as wide", SPHERE, corners=box_corners((1e6, 1, 1)),
      volume=1000000.0)
def long_rod():
    return box(40, 1, 1, (1e6, 1, 1))
