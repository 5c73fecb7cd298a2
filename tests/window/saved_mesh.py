# SPDX-License-Identifier: GPL-3.0-or-later
"""What a saved mesh is, measured from the file alone."""
import os
import sys

import numpy as np

from ccdm import ROOT

sys.path.insert(0, os.path.join(ROOT, "sample_meshes"))
from meshfile import read_ply  # noqa: E402


class SavedMesh:
    """The triangle mesh in a PLY file."""

    def __init__(self, path):
        self.points, self.faces = read_ply(path)
        sides = np.sort(self.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        self.edges, self._uses = np.unique(sides, axis=0, return_counts=True)

    @property
    def vertices(self):
        return len(self.points)

    @property
    def is_manifold(self):
        """Every edge has one or two faces, every vertex one fan of them."""
        return self._uses.max() <= 2 and not self._has_split_vertex()

    @property
    def euler(self):
        """With the vertices that a face uses."""
        return len(np.unique(self.faces)) - len(self.edges) + len(self.faces)

    @property
    def boundary_loops(self):
        """Of a manifold."""
        return _groups(self.edges[self._uses == 1])

    @property
    def components(self):
        return _groups(self.edges)

    @property
    def topology(self):
        """What remeshing keeps."""
        return self.euler, self.boundary_loops, self.components

    @property
    def smallest_angles(self):
        """Of each face, degrees."""
        p = self.points[self.faces]
        u, w = np.roll(p, -1, 1) - p, np.roll(p, -2, 1) - p
        angles = np.arctan2(np.linalg.norm(np.cross(u, w), axis=2), (u * w).sum(2))
        return np.degrees(angles).min(1)

    def _has_split_vertex(self):
        # The edges that face a vertex form one path or one ring.
        links = [[] for _ in self.points]
        for a, b, c in self.faces.tolist():
            links[a].append((b, c))
            links[b].append((c, a))
            links[c].append((a, b))
        return any(link and _groups(np.array(link)) != 1 for link in links)


def _groups(pairs):
    """Number of connected groups among the numbers in `pairs`."""
    parent = {}

    def root(x):
        while parent.setdefault(x, x) != x:
            parent[x] = parent[parent[x]]
            x = parent[x]
        return x

    for a, b in pairs.tolist():
        parent[root(a)] = root(b)
    return sum(root(x) == x for x in parent)
