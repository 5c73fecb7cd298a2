# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a triangle mesh, computed from nothing but its points and faces: what a report is checked against."""
import math

import numpy


def corner_angles(points, faces):
    """Degrees, one row a face."""
    p = numpy.asarray(points, dtype=float)[numpy.asarray(faces)]
    angles = []
    for k in range(3):
        u, v = p[:, (k + 1) % 3] - p[:, k], p[:, (k + 2) % 3] - p[:, k]
        angles.append(numpy.degrees(numpy.arctan2(numpy.linalg.norm(numpy.cross(u, v), axis=1), (u * v).sum(axis=1))))
    return numpy.array(angles).T


def aspect_ratios(points, faces):
    """2 sqrt(3) area / (half perimeter * longest edge)."""
    p = numpy.asarray(points, dtype=float)[numpy.asarray(faces)]
    sides = numpy.array([numpy.linalg.norm(p[:, (k + 2) % 3] - p[:, (k + 1) % 3], axis=1) for k in range(3)])
    area = numpy.linalg.norm(numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    return 2 * math.sqrt(3) * area / (sides.sum(axis=0) / 2 * sides.max(axis=0))


class Sets:
    """Disjoint sets that know on which of two sides of its root a member is."""

    def __init__(self):
        self.up = {}

    def root(self, k):
        side = 0
        while k in self.up:
            k, turned = self.up[k]
            side ^= turned
        return k, side

    def join(self, a, b, turned=0):
        """False if they are joined the other way round."""
        (a, of_a), (b, of_b) = self.root(a), self.root(b)
        if a == b:
            return of_a ^ of_b == turned
        self.up[a] = (b, of_a ^ of_b ^ turned)
        return True


def topology(faces):
    """Counts of a surface; `fault` says why it is none."""
    edges = {}
    for t, f in enumerate(faces):
        for k in range(3):
            a, b = int(f[k]), int(f[(k + 1) % 3])
            edges.setdefault((min(a, b), max(a, b)), []).append((t, a < b))
    used = {int(v) for f in faces for v in f}
    found = {"vertices": len(used), "faces": len(faces), "edges": len(edges),
             "euler": len(used) - len(edges) + len(faces), "orientable": True, "fault": ""}
    parts, corners, rims = Sets(), Sets(), Sets()
    rim = set()
    for (a, b), uses in edges.items():
        if len(uses) > 2:
            found["fault"] = f"edge {a}-{b} has {len(uses)} faces"
        if len(uses) == 1:
            rims.join(a, b)
            rim |= {a, b}
        for (t, up), (u, other) in zip(uses, uses[1:]):
            found["orientable"] &= parts.join(t, u, int(up == other))
            for v in (a, b):
                corners.join((t, v), (u, v))
    fans = {(int(v), corners.root((t, int(v)))[0]) for t, f in enumerate(faces) for v in f}
    if len(fans) > len(used):
        found["fault"] = "a vertex joins several fans"
    found["components"] = len({parts.root(t)[0] for t in range(len(faces))})
    found["boundary_loops"] = len({rims.root(v)[0] for v in rim})
    found["rim"] = rim
    return found


def percent_valence_6(faces, rim):
    """Of the vertices off the boundary."""
    neighbours = {}
    for f in faces:
        for k in range(3):
            neighbours.setdefault(int(f[k]), set()).update((int(f[(k + 1) % 3]), int(f[(k + 2) % 3])))
    inner = [len(n) for v, n in neighbours.items() if v not in rim]
    return 100 * inner.count(6) / len(inner) if inner else 0
