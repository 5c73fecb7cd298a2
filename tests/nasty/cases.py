# SPDX-License-Identifier: GPL-3.0-or-later
"""A nasty input: what it is, what is asked of it, and what has to come out. The same on every machine."""
from dataclasses import dataclass, field

import numpy as np

from surface import Surface, Topology, cut_apart


@dataclass
class Case:
    """`topology` is that of the input as mended, known from how it was made; None if it is to be refused."""
    name: str
    nasty: str
    make: object
    topology: Topology = None
    refused: str = ""  # a piece of the reason
    vertices: int = 150
    args: tuple = ()
    corners: list = field(default_factory=list)  # where the result has to have a vertex
    notes: tuple = ()  # pieces of what the program has to say
    volume: float = None  # of the result
    tolerance: float = 1e-6  # of it, relative; flat sides and creases that stay make it exact
    simple: bool = False  # nothing crosses anything, before and after
    form: str = "ply"
    fails: str = ""  # what is wrong today

    def mesh(self):
        points, faces = self.make()
        return np.asarray(points, float), [tuple(map(int, f)) for f in faces]


CASES = []
SPHERE, DISC, TUBE, TORUS = (Topology(2, 1, 0, True), Topology(1, 1, 1, True), Topology(0, 1, 2, True),
                             Topology(0, 1, 0, True))


def case(nasty, topology=None, **options):
    """The function's name is that of the mesh that it returns."""
    def add(make):
        CASES.append(Case(options.pop("name", make.__name__), nasty, make, topology, **options))
        return make
    return add


def again(make, name, nasty, topology=None, **options):
    """The mesh of another case with other options."""
    CASES.append(Case(name, nasty, make, topology, **options))


def spheres(count):
    return Topology(2 * count, count, 0, True)


def topology_cut_apart(make):
    faces, count = cut_apart(make()[1])
    return Surface(faces, count).topology


def random(seed):
    return np.random.RandomState(seed)
