# SPDX-License-Identifier: GPL-3.0-or-later
"""Nasty inputs: what is mended, what is no surface, polygons."""
import numpy as np

import pieces
from cases import DISC, SPHERE, again, case, random, spheres, topology_cut_apart
from pieces import box, box_corners, grid, joined, moved, sphere, voxels
from surface import Topology

# What is mended.


@case("every third face turned over", DISC, notes=("turned",))
def turned_faces():
    points, faces = grid(12, 12, lambda u, v: (u, v, 0.3 * np.sin(3 * u)))
    return points, pieces.turned(faces, range(0, len(faces), 3))


@case("half of the faces turned over at random", SPHERE, notes=("turned",))
def turned_at_random():
    points, faces = sphere(2)
    return points, pieces.turned(faces, np.flatnonzero(random(5).rand(len(faces)) < 0.5))


@case("triangle soup of a sphere: sewn", SPHERE, notes=("were merged",))
def soup_sphere():
    return pieces.soup(sphere(2))


@case("triangle soup of a box: sewn", SPHERE, corners=box_corners(), notes=("were merged",), volume=1)
def soup_box():
    return pieces.soup(box(4, 4, 4))


again(lambda: box(4, 4, 4), "soup_stl", "a box as STL, which is a soup", SPHERE, corners=box_corners(), form="stl",
      volume=1)


@case("triangle soup with every third face turned over", SPHERE, corners=box_corners(), notes=("were merged", "turned"),
      volume=1)
def soup_turned():
    points, faces = pieces.soup(box(4, 4, 4))
    return points, pieces.turned(faces, range(0, len(faces), 3))


@case("a seam: two halves with vertices of their own", SPHERE, notes=("were merged",))
def seam():
    points, faces = sphere(2)
    return pieces.apart((points, faces), [t for t, f in enumerate(faces) if points[list(f), 2].mean() > 0])


@case("two halves a ten-millionth apart: no seam, two surfaces", Topology(2, 2, 2, True))
def gap():
    points, faces = sphere(2)
    upper = [t for t, f in enumerate(faces) if points[list(f), 2].mean() > 0]
    points, faces = pieces.apart((points, faces), upper)
    for v in {v for t in upper for v in faces[t]}:
        points[v, 2] += 1e-7
    return points, faces


@case("a coarse sheet against a fine one: their rims lie on each other, their vertices do not", Topology(2, 2, 2, True))
def hanging_vertices():
    return joined(grid(4, 4), moved(grid(7, 7), (1, 0, 0)))


@case("a sheet with a slit of no width: sewn", DISC, notes=("were merged",))
def slit():
    points, faces = grid(10, 10)
    below = [v for v, p in enumerate(points) if p[1] == 0.5 and 0.2 < p[0] < 0.75]
    twin = {v: len(points) + k for k, v in enumerate(below)}
    points = np.vstack([points, points[below]])
    return points, [tuple(twin.get(v, v) for v in f) if points[list(f), 1].mean() < 0.5 else f for f in faces]


@case("20 faces given twice: dropped", SPHERE, notes=("20 faces",))
def repeated_faces():
    points, faces = sphere(2)
    return points, faces + faces[:40:2]


@case("20 faces given again the other way round: dropped", SPHERE, notes=("20 faces",))
def repeated_turned_faces():
    points, faces = sphere(2)
    return points, faces + [f[::-1] for f in faces[:40:2]]


@case("every face given three times", SPHERE, notes=("640 faces",))
def three_times():
    points, faces = sphere(2)
    return points, faces * 3


@case("faces that name a vertex twice: dropped", SPHERE, notes=("name a vertex twice",))
def repeated_corners():
    points, faces = sphere(2)
    return points, faces + [(0, 0, 1), (5, 6, 5), (7, 7, 7)]


@case("vertices that no face uses, some of them not finite: dropped", SPHERE, notes=("3 vertices that no face uses",))
def unused_vertices():
    points, faces = sphere(2)
    return np.vstack([points, [(1e9, 0, 0), (np.nan, 0, 0), (0, np.inf, 0)]]), faces


# What is no surface.


@case("three sheets at one edge", refused="more than two faces")
def three_sheets():
    points, faces = [], []
    for k in range(3):
        a = 2 * np.pi * k / 3
        p, f = grid(6, 6, lambda u, v, a=a: (u * np.cos(a), u * np.sin(a), v))
        p[p[:, 2] == 0, 2] = 0.0
        faces += [tuple(v + len(points) for v in t) for t in f]
        points += [tuple(np.round(x, 12) + 0.0) for x in p]
    return pieces.welded((points, faces))


again(three_sheets, "three_sheets_split", "three sheets at one edge, cut apart", Topology(3, 3, 3, True),
      args=("--repair", "split"), notes=("cut",))


@case("two spheres that share a vertex", refused="joins several sheets")
def shared_vertex():
    pole = sphere(0)[0][0]
    mesh = joined(moved(sphere(2), tuple(-pole)), moved(sphere(2), tuple(pole)))
    mesh[0][np.linalg.norm(mesh[0], axis=1) < 1e-9] = 0
    return pieces.welded(mesh)


again(shared_vertex, "shared_vertex_split", "two spheres that share a vertex, cut apart", spheres(2),
      args=("--repair", "split"), notes=("cut",))


@case("a hole that touches the rim of a sheet", refused="joins several sheets")
def pinched_rim():
    points, faces = grid(6, 6)
    corner, next_to_it = (0, 1, 7, 8), (8, 9, 15, 16)
    faces = [f for f in faces if not (set(f) <= set(corner) or set(f) <= set(next_to_it))]
    return pieces.used(points, faces)


again(pinched_rim, "pinched_rim_split", "a hole that touches the rim of a sheet, cut apart", DISC,
      args=("--repair", "split"), notes=("cut",))


@case("a book of 25 pages", refused="more than two faces")
def book():
    points = [(0, 0, 0), (0, 0, 1)] + [(np.cos(k / 25), np.sin(k / 25), z) for k in range(25) for z in (0, 1)]
    faces = []
    for k in range(25):
        faces += [(0, 1, 3 + 2 * k), (0, 3 + 2 * k, 2 + 2 * k)]
    return np.array(points), faces


again(book, "book_split", "a book of 25 pages, cut apart", Topology(25, 25, 25, True), vertices=300,
      args=("--repair", "split"), notes=("cut",))


@case("cubes that meet in edges and corners", refused="more than two faces")
def checkered_cubes():
    return voxels((x, y, z) for x in range(4) for y in range(4) for z in range(4) if (x + y + z) % 2 == 0)


again(checkered_cubes, "checkered_cubes_split", "cubes that meet in edges and corners, cut apart",
      topology_cut_apart(checkered_cubes), vertices=1500, args=("--repair", "split"), notes=("cut",))


@case("148 faces between 40 vertices at random", refused="more than two faces")
def random_soup():
    generator = random(6)
    faces = {tuple(sorted(generator.choice(40, 3, replace=False))): 0 for _ in range(150)}
    return generator.uniform(0, 1, (40, 3)), list(faces)


again(random_soup, "random_soup_split", "148 faces between 40 vertices at random, cut apart",
      topology_cut_apart(random_soup), vertices=600, args=("--repair", "split"), notes=("cut",))


@case("coordinates that are no numbers", refused="3 vertices have coordinates that are not finite")
def not_a_number():
    points, faces = sphere(2)
    points[[3, 70, 71], 1] = np.nan
    return points, faces


@case("a coordinate without end", refused="1 vertex has coordinates that are not finite")
def infinite():
    points, faces = sphere(2)
    points[5, 0] = -np.inf
    return points, faces


@case("all vertices on a line", refused="no area")
def line():
    points, faces = grid(6, 6)
    return points * (1, 0, 0), faces


@case("all vertices on a slanted line, but for rounding", refused="no area")
def slanted_line():
    points, faces = grid(6, 6)
    return np.outer(points[:, 0] + points[:, 1], (0.1, 0.7, 1 / 3)), faces


@case("all vertices at one point", refused="one point")
def point():
    points, faces = sphere(2)
    return points * 0 + 0.1, faces


@case("a strip a millionth as wide as long", DISC)
def ribbon():
    points, faces = grid(20, 4)
    return points * (1, 1e-6, 0), faces


@case("a strip a trillionth as wide as long", refused="no area")
def thread():
    points, faces = grid(20, 4)
    return points * (1, 1e-12, 0), faces


# Polygons.


@case("two stars of 40 corners and the quadrangles between them", SPHERE, notes=("polygons that were split",),
      simple=True, corners=[(1, 0, 0), (1, 0, 1)])
def star_prism():
    return pieces.prism([((1 - 0.7 * (k % 2)) * np.cos(k * np.pi / 20), (1 - 0.7 * (k % 2)) * np.sin(k * np.pi / 20))
                         for k in range(40)])


def comb_outline(teeth):
    outline = [(0.0, -1.0), (2.0 * teeth - 1, -1.0)]
    for k in reversed(range(teeth)):
        outline += [(2.0 * k + 1, 20.0), (2.0 * k, 20.0)] + ([(2.0 * k, 0.0), (2.0 * k - 1, 0.0)] if k else [])
    return outline


@case("two combs of 242 corners", SPHERE, vertices=900, notes=("polygons that were split",), simple=True,
      corners=[(0, -1, 0), (0, 20, 1), (119, 20, 0)], volume=1319)
def comb_prism():
    return pieces.prism(comb_outline(60))


@case("two combs of 306 corners", SPHERE, vertices=900, form="off", notes=("polygons that were split",),
      simple=True, corners=[(0, -1, 0), (0, 20, 1), (151, 20, 0)])
def large_comb_prism():
    return pieces.prism(comb_outline(76))


@case("quadrangles that cross themselves", SPHERE, notes=("polygons that were split",))
def crossed_quadrangles():
    points, faces = pieces.prism([(0, 0), (1, 0), (1, 1), (0, 1)])
    points[[4, 5]] = points[[5, 4]]
    return points, faces
