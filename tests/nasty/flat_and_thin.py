# SPDX-License-Identifier: GPL-3.0-or-later
"""Nasty inputs: flat parts, faces without area, thin parts, cusps, creases that touch."""
import numpy as np

import pieces
from cases import DISC, SPHERE, TORUS, case, random
from pieces import box, box_corners, grid, round_torus, sphere

# Flat parts.


@case("each side of a box has 800 triangles in one plane", SPHERE, corners=box_corners(), volume=1)
def flat_sides():
    return box(20, 20, 20)


@case("irregular triangles in one plane, some of them folded over", DISC, corners=[(0, 0, 0), (1, 0, 0), (1, 1, 0)])
def flat_sheet():
    points, faces = grid(20, 20)
    generator = random(2)
    inner = ((points[:, :2] > 0) & (points[:, :2] < 1)).all(axis=1)
    points[inner, :2] += generator.uniform(-0.02, 0.02, (inner.sum(), 2))
    for t in range(0, len(faces), 2):
        if generator.rand() < 0.5:
            (a, b, c), d = faces[t], faces[t + 1][2]
            faces[t:t + 2] = [(a, b, d), (b, c, d)]
    return points, faces


# Faces without area.


@case("60 faces without area: three vertices in a line", SPHERE, notes=("60 input faces have no area",))
def caps():
    return pieces.with_caps(sphere(3), most=60)


@case("80 vertices that stand twice, joined by an edge without length", SPHERE, notes=("input faces have no area",))
def zero_length_edges():
    return pieces.with_split_vertices(sphere(3), range(0, 640, 8))


@case("61 faces around a vertex shrunk to a point", SPHERE, notes=("input faces have no area",))
def shrunk_patch():
    points, faces = sphere(3)
    near = np.argsort(np.linalg.norm(points - points[0], axis=1), kind="stable")[:40]
    points[near] = points[0]
    return points, faces


@case("a whole side of a box shrunk to a point", SPHERE, corners=[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
      volume=8 / 9, tolerance=0.01)
def shrunk_side():
    points, faces = box(6, 6, 6)
    points[points[:, 2] == 1] = (0.5, 0.5, 1)
    return points, faces


def on_crease(p, q):
    """Whether an edge lies on one of a unit box."""
    return sum(1 for k in range(3) if p[k] == q[k] and p[k] in (0, 1)) == 2


@case("faces without area along the creases of a box: three vertices in a line", SPHERE, corners=box_corners(),
      notes=("input faces have no area",), volume=1)
def caps_on_creases():
    return pieces.with_caps(box(4, 4, 4), on_crease)


@case("vertices all but at the ends of the creases, on one side only", SPHERE, corners=box_corners(),
      volume=1)
def skewed_caps_on_creases():
    return pieces.with_caps(box(4, 4, 4), on_crease, at=1e-9)


@case("edges without length along the creases of a box and at its corners", SPHERE, corners=box_corners(),
      notes=("input faces have no area",), volume=1)
def zero_length_on_creases():
    points, faces = box(4, 4, 4)
    rim = [k for k, p in enumerate(points) if sum(x in (0, 1) for x in p) >= 2]
    return pieces.with_split_vertices((points, faces), rim)


@case("the same, each vertex four times", SPHERE, corners=box_corners(), notes=("input faces have no area",),
      volume=1)
def zero_length_knots_on_creases():
    mesh = box(3, 3, 3)
    for _ in range(3):
        rim = [k for k, p in enumerate(mesh[0][:56]) if sum(x in (0, 1) for x in p) >= 2]
        mesh = pieces.with_split_vertices(mesh, rim)
    return mesh


@case("a strip without width along a crease of a box, which joins its sides", SPHERE, corners=box_corners(),
      notes=("input faces have no area",), volume=1)
def zero_width_chamfer():
    points, faces = box(8, 8, 8)
    # The first two columns of one side lie at one place.
    points[(points[:, 2] == 1) & (points[:, 0] == 0.125), 0] = 0
    return points, faces


@case("faces without area along the boundary of a sheet", DISC, corners=[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
      notes=("input faces have no area",))
def caps_on_boundary():
    points, faces = grid(6, 6)
    for t in [t for t, f in enumerate(faces) if sum(points[v][1] == 0 for v in f) == 2]:
        a, b = sorted(v for v in faces[t] if points[v][1] == 0)
        points = np.vstack([points, (points[a] + points[b]) / 2])
        faces.append((b, a, len(points) - 1))
    return points, faces


# Thin parts, cusps, creases that touch.


@case("a plate a thousandth as thick as wide", SPHERE, corners=box_corners((1, 1, 0.001)), volume=0.001)
def thin_plate():
    return box(10, 10, 1, (1, 1, 0.001))


@case("a plate a billionth as thick as wide", SPHERE, corners=box_corners((1, 1, 1e-9)), volume=1e-09)
def very_thin_plate():
    return box(10, 10, 1, (1, 1, 1e-9))


@case("a plate without thickness: both sides and the rim at one height", SPHERE,
      corners=[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
def flattened_box():
    return box(10, 10, 1, (1, 1, 0))


@case("two sheets on each other with one rim", SPHERE, corners=[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
def flat_pillow():
    points, below = grid(8, 8)
    # The diagonals above run the other way, or triangles at two corners would be the same.
    faces = [(a + len(points), b + len(points), c + len(points)) for t in range(0, len(below), 2)
             for a, b, c in ((below[t][0], below[t + 1][2], below[t][1]), (below[t][1], below[t + 1][2], below[t][2]))]
    rim = {v for v, p in enumerate(points) if 0 in p[:2] or 1 in p[:2]}
    faces = [tuple(v - len(points) if v - len(points) in rim else v for v in f) for f in faces]
    return pieces.used(np.vstack([points, points]), below + faces)


@case("a cone with a tip of one degree", SPHERE, args=("--seed", "4"),
      fails="the tip is cut off, by two spacings, at three of eight seeds")
def sharp_cone():
    return pieces.revolved([(0, 0), *((k / 40 * np.tan(np.pi / 360), k / 40) for k in range(1, 41)), (0, 1)], 12)


@case("a spindle that ends in two cusps", SPHERE,
      fails="the cusps are cut off, by three spacings and more")
def spindle():
    t = np.linspace(0, 1, 41)[1:-1]
    return pieces.revolved([(0, 0), *((x * x * (1 - x) ** 2, x) for x in t), (0, 1)], 12)


@case("a blade whose two sides touch along the edge", SPHERE, corners=[(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, -1)])
def cusped_blade():
    points, faces = box(8, 8, 2)
    points[:, 2] = (2 * points[:, 2] - 1) * points[:, 1] ** 2
    return pieces.welded((points, faces))


@case("a ring whose hole is a millionth wide", TORUS, vertices=500)
def pinched_torus():
    return round_torus(24, 12, 1 - 1e-6)


@case("a ring whose hole is a point: 24 vertices there", TORUS)
def horn_torus():
    points, faces = round_torus(24, 12, 1.0)
    points[np.linalg.norm(points, axis=1) < 1e-9] = 0
    return points, faces


@case("a waist of a hundred-thousandth", SPHERE)
def hourglass():
    z = np.linspace(-1, 1, 41)[1:-1]
    return pieces.revolved([(0, -1), *((np.sqrt(1 - x * x) * (x * x + 1e-5), x) for x in z), (0, 1)], 16)


@case("two creases that meet at an angle of zero", DISC)
def tangent_creases():
    def height(x, y):
        return -2 * y if y < 0 else max(0.0, 2 * (y - max(x, 0) ** 2))
    points, faces, n = [], [], 12
    rows = []
    for i in range(-n, n + 1):
        x = i / n
        own = [(x, -1 + k / 6) for k in range(7)]
        top = max(x, 0) ** 2
        own += [(x, top + (2 - top) * k / 6) for k in range(7)]
        rows.append([len(points) + k for k in range(14)])
        points += [(x, y, height(x, y)) for x, y in own]
    for a, b in zip(rows, rows[1:]):
        for k in range(13):
            faces += [(a[k], b[k], b[k + 1]), (a[k], b[k + 1], a[k + 1])]
    return pieces.welded((points, faces))


@case("stairs a thousandth of the width high: 40 creases between two vertices", DISC)
def stairs():
    profile = [((k + 1) // 2 * 0.001, k // 2 * 0.001) for k in range(41)]
    points = np.array([(x, y / 20, z) for x, z in profile for y in range(21)])
    _, faces = grid(40, 20)
    return points, faces


@case("40 creases that meet in a point", DISC)
def pleated_disc():
    points = [(0, 0, 0)] + [(np.cos(k * np.pi / 40), np.sin(k * np.pi / 40), 0.2 * (-1) ** k) for k in range(80)]
    return np.array(points), [(0, k + 1, (k + 1) % 80 + 1) for k in range(80)]


@case("30 spikes, 100 times as long as wide", SPHERE)
def hairy_sphere():
    points, faces = sphere(3)
    points[::22] *= 12
    return points, faces
