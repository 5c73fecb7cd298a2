# SPDX-License-Identifier: GPL-3.0-or-later
"""What a triangle mesh is as a surface, found from its faces alone and without any of the project's code."""
from collections import Counter, defaultdict, namedtuple

import numpy as np

Topology = namedtuple("Topology", "euler components loops orientable")


class Surface:
    """`fault` is the first thing that makes it none, or empty; only then is there a `topology`."""

    def __init__(self, faces, vertices):
        self.faces = [tuple(f) for f in faces]
        self.sides = defaultdict(list)  # edge: [(face, whether it runs from the lower vertex)]
        for t, f in enumerate(self.faces):
            for a, b in zip(f, f[1:] + f[:1]):
                self.sides[min(a, b), max(a, b)].append((t, a < b))
        self.fault = self.find_fault(vertices)
        if not self.fault:
            self.coherent = all(len(s) == 1 or s[0][1] != s[1][1] for s in self.sides.values())
            self.topology = Topology(vertices - len(self.sides) + len(self.faces), self.count_components(),
                                     self.count_loops(), self.is_orientable())

    def find_fault(self, vertices):
        if any(len(f) != 3 or len(set(f)) != 3 for f in self.faces):
            return "a face is no triangle"
        if len({v for f in self.faces for v in f}) != vertices or not all(0 <= v < vertices for f in self.faces
                                                                          for v in f):
            return "a vertex is used by no face, or does not exist"
        if any(len(s) > 2 for s in self.sides.values()):
            return "an edge has more than two faces"
        if Counter(frozenset(f) for f in self.faces).most_common(1)[0][1] > 1:
            return "two faces have the same vertices"
        # The edges opposite a vertex are one path or one ring.
        link = defaultdict(lambda: defaultdict(list))
        for a, b, c in self.faces:
            for v, p, q in ((a, b, c), (b, c, a), (c, a, b)):
                link[v][p].append(q)
                link[v][q].append(p)
        for around in link.values():
            seen, stack = set(), [next(iter(around))]
            while stack:
                v = stack.pop()
                if v not in seen:
                    seen.add(v)
                    stack += around[v]
            if len(seen) != len(around):
                return "the faces at a vertex form more than one fan"
        return ""

    def mates(self):
        """Of each face, those across its edges, and whether they run against it."""
        mates = [[] for _ in self.faces]
        for side in self.sides.values():
            if len(side) == 2:
                (s, one), (t, other) = side
                mates[s].append((t, one == other))
                mates[t].append((s, one == other))
        return mates

    def count_components(self):
        return count_connected({t: [m for m, _ in mates] for t, mates in enumerate(self.mates())})

    def is_orientable(self):
        """Whether the faces can all be turned to agree."""
        mates, turned = self.mates(), {}
        for start in range(len(self.faces)):
            stack = [(start, False)] if start not in turned else []
            while stack:
                t, way = stack.pop()
                if t in turned:
                    if turned[t] != way:
                        return False
                    continue
                turned[t] = way
                stack += [(m, way != against) for m, against in mates[t]]
        return True

    def count_loops(self):
        return count_connected(neighbours(edge for edge, side in self.sides.items() if len(side) == 1))

    def percent_valence_6(self):
        """Of the vertices off the boundary."""
        rim = {v for edge, side in self.sides.items() if len(side) == 1 for v in edge}
        inner = [len(around) for v, around in neighbours(self.sides).items() if v not in rim]
        return 100 * inner.count(6) / len(inner) if inner else 0


def neighbours(edges):
    """Of each vertex."""
    found = defaultdict(list)
    for a, b in edges:
        found[a].append(b)
        found[b].append(a)
    return found


def count_connected(follow):
    """Number of connected parts of a graph that is given by each member's neighbours."""
    seen, parts = set(), 0
    for start in follow:
        parts += start not in seen
        stack = [start]
        while stack:
            v = stack.pop()
            if v not in seen:
                seen.add(v)
                stack += follow[v]
    return parts


def cut_apart(faces):
    """The faces with a vertex of its own for each fan; edges of more than two faces end a fan."""
    parent = {(t, v): (t, v) for t, f in enumerate(faces) for v in f}

    def root(c):
        while parent[c] != c:
            c = parent[c]
        return c
    sides = defaultdict(list)
    for t, (a, b, c) in enumerate(faces):
        for edge in ((a, b), (b, c), (c, a)):
            sides[frozenset(edge)].append(t)
    for edge, at in sides.items():
        if len(at) == 2:
            for v in edge:
                parent[root((at[0], v))] = root((at[1], v))
    number = {}
    result = [tuple(number.setdefault(root((t, v)), len(number)) for v in f) for t, f in enumerate(faces)]
    return result, len(number)


def volume(points, triangles):
    a, b, c = (points[[t[k] for t in triangles]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def corner_angles(points, triangles):
    """In degrees, a row of three for each triangle."""
    corner = [points[[t[k] for t in triangles]] for k in range(3)]
    angles = []
    for k in range(3):
        u, v = (corner[(k + i) % 3] - corner[k] for i in (1, 2))
        angles.append(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v)))
    return np.degrees(angles).T


def aspect_ratios(points, triangles):
    """2 sqrt(3) area / (half perimeter * longest edge)."""
    p = points[np.array(triangles)]
    sides = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2)
    doubled = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    return 2 * 3 ** 0.5 * doubled / (sides.sum(axis=1) * sides.max(axis=1))


def area(points, faces):
    """Of polygons in a plane each; those on the same vertices count once."""
    faces = list({frozenset(f): f for f in faces}.values())
    fan = np.array([(n, f[0], *f[k:k + 2]) for n, f in enumerate(faces) for k in range(1, len(f) - 1)])
    a, b, c = (points[fan[:, k]] for k in (1, 2, 3))
    normal = np.zeros((len(faces), 3))
    np.add.at(normal, fan[:, 0], np.cross(b - a, c - a))
    return np.linalg.norm(normal, axis=1).sum() / 2


def farthest(places, points, triangles):
    """The largest distance from one of the places to the triangles."""
    corner = [points[[t[k] for t in triangles]] for k in range(3)]
    return max(to_triangles(p, *corner).min() for p in places) ** 0.5


def to_triangles(p, a, b, c):
    """Squared distances."""
    def dot(u, v):
        return np.einsum("ij,ij->i", u, v)
    best = np.full(len(a), np.inf)
    for s, t in ((a, b), (b, c), (c, a)):
        along, length = t - s, np.maximum(dot(t - s, t - s), 1e-300)
        q = s + np.clip(dot(p - s, along) / length, 0, 1)[:, None] * along
        best = np.minimum(best, dot(p - q, p - q))
    normal = np.cross(b - a, c - a)
    inside = np.all([dot(np.cross(t - s, p - s), normal) > 0 for s, t in ((a, b), (b, c), (c, a))], axis=0)
    height = dot(p - a, normal) ** 2 / np.maximum(dot(normal, normal), 1e-300)
    return np.where(inside, np.minimum(best, height), best)
