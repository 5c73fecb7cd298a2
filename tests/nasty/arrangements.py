# SPDX-License-Identifier: GPL-3.0-or-later
"""Nasty inputs: folds, crossings, several components, very few faces, very many of something."""
import numpy as np

import pieces
from cases import DISC, SPHERE, TORUS, again, case, random, spheres
from pieces import box, box_corners, grid, joined, moved, sphere, voxels
from surface import Topology

# Folds and crossings.


@case("a sheet pulled over itself: faces turned by 180 degrees, in one plane", DISC)
def pulled_over():
    points, faces = grid(8, 8)
    points[40] += (0.4, 0.1, 0)
    return points, faces


@case("a sheet folded flat seven times", DISC)
def accordion():
    return grid(56, 8, lambda u, v: (abs((7 * u) % 2 - 1), v + 0.001 * u, 0))


@case("a sheet folded flat, whose rims lie on each other", DISC)
def folded_in_half():
    return grid(8, 8, lambda u, v: (abs(u - 0.5), v, 0))


again(lambda: grid(12, 12, lambda u, v: (abs(u - 0.5), v, 0)), "folded_with_rounding",
      "the same, but most of the places differ in the last digit", DISC)


@case("a sheet rolled up 10 times, closer than the spacing", DISC)
def roll():
    return grid(200, 10, lambda u, v: ((1 + 0.05 * u) * np.cos(20 * np.pi * u), (1 + 0.05 * u) * np.sin(20 * np.pi * u),
                                       v))


@case("two spheres through each other", spheres(2),
      volume=8.38, tolerance=0.15)
def crossing_spheres():
    return joined(sphere(2), moved(sphere(2), (0.7, 0.3, 0.1)))


@case("a tube that crosses itself", TORUS)
def crossing_tube():
    def at(a, b):
        tangent = np.array([np.cos(a), np.cos(2 * a), 0])
        side = np.cross((0, 0, 1), tangent / np.linalg.norm(tangent))
        return np.array([np.sin(a), np.sin(a) * np.cos(a), 0]) + 0.12 * (np.cos(b) * side + np.sin(b) *
                                                                        np.array([0, 0, 1]))
    return pieces.torus(60, 10, at)


@case("a bottle without an inside, which crosses itself", Topology(0, 1, 0, False))
def klein_bottle():
    def at(a, b):
        r = 2.2 + np.cos(a / 2) * np.sin(b) - np.sin(a / 2) * np.sin(2 * b)
        return r * np.cos(a), r * np.sin(a), np.sin(a / 2) * np.sin(b) + np.cos(a / 2) * np.sin(2 * b)
    return pieces.torus(40, 24, at, turned=True)


@case("a strip with one side", Topology(0, 1, 1, False))
def moebius_strip():
    n = 60
    points = [((1 + t * np.cos(a / 2)) * np.cos(a), (1 + t * np.cos(a / 2)) * np.sin(a), t * np.sin(a / 2))
              for a in np.arange(n) * 2 * np.pi / n for t in np.linspace(-0.4, 0.4, 5)]
    faces = []
    for i in range(n):
        for j in range(4):
            a, b = i * 5 + j, i * 5 + j + 1
            c, d = (a + 5, b + 5) if i < n - 1 else (4 - j, 3 - j)
            faces += [(a, c, d), (a, d, b)]
    return np.array(points), faces


@case("the projective plane, which crosses itself", Topology(1, 1, 0, False))
def projective_plane():
    # Half of a sphere, its opposite points glued, as Steiner's surface.
    points, faces = sphere(3)
    key = np.round(points, 9) + 0.0
    number, glued = {}, []
    for p in key:
        other = tuple(-p + 0.0)
        glued.append(number.setdefault(min(tuple(p), other), len(number)))
    half = np.array(sorted(number, key=number.get))
    seen, kept = set(), []
    for f in faces:
        g = tuple(glued[v] for v in f)
        if frozenset(g) not in seen:
            seen.add(frozenset(g))
            kept.append(g)
    x, y, z = half.T
    return np.array([y * z, z * x, x * y + 0.3 * (x * x - y * y)]).T, kept


@case("the vertices of a sphere anywhere in a cube", SPHERE)
def crumpled():
    points, faces = sphere(1)
    return random(3).uniform(0, 1, points.shape), faces


@case("noise of half the radius", SPHERE)
def noise_sphere():
    points, faces = sphere(3)
    return points * random(4).uniform(0.5, 1.5, (len(points), 1)), faces


again(noise_sphere, "noise_all_creases", "noise of half the radius, every edge of one degree a crease", SPHERE,
      args=("--feature-angle", 1))


# Several components.


@case("two boxes that share the place of a side", spheres(2), corners=box_corners((2, 1, 1)), volume=2)
def touching_boxes():
    return joined(box(3, 3, 3), moved(box(3, 3, 3), (1, 0, 0)))


@case("two spheres that touch in a point, with a vertex each", spheres(2),
      volume=8.38, tolerance=0.15)
def touching_spheres():
    return joined(moved(sphere(2), tuple(-sphere(0)[0][0])), moved(sphere(2), tuple(sphere(0)[0][0])))


@case("a sphere in a sphere, a thousandth apart", spheres(2),
      volume=8.38, tolerance=0.15)
def nested_spheres():
    return joined(sphere(3), moved(sphere(3), scale=0.999))


@case("a sphere in a sphere, a third apart", spheres(2), volume=5.62, tolerance=0.15)
def nested_spheres_apart():
    return joined(sphere(2), moved(sphere(2), scale=0.7))


@case("the same sphere twice", spheres(2),
      volume=8.38, tolerance=0.15)
def coincident_spheres():
    return joined(sphere(3), sphere(3))


@case("the same sheet twice", Topology(2, 2, 2, True))
def coincident_sheets():
    return joined(grid(8, 8), grid(8, 8))


@case("a sphere a millionth as wide beside another", spheres(2))
def tiny_neighbour():
    return joined(sphere(3), moved(sphere(2), (2, 0, 0), 1e-6))


@case("a sphere a trillionth as wide beside another", spheres(2))
def vanishing_neighbour():
    return joined(sphere(3), moved(sphere(1), (2, 0, 0), 1e-12))


@case("200 small components", spheres(200), vertices=1200)
def many_components():
    return joined(*(moved(sphere(0), (3 * (k % 10), 3 * (k // 10), 0)) for k in range(200)))


again(many_components, "many_components_few_vertices", "200 components and 10 vertices to share", spheres(200),
      vertices=10, notes=("cannot do with fewer than 800",))


# Very few faces.


@case("one triangle", DISC, corners=[(0, 0, 0), (1, 0, 0), (0, 1, 0)])
def one_triangle():
    return [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]


again(one_triangle, "one_triangle_four_vertices", "one triangle and the fewest vertices", DISC, vertices=4)


@case("one triangle, a hundred million times as long as high", DISC)
def one_needle():
    return [(0, 0, 0), (1e8, 0, 0), (0, 1, 0)], [(0, 1, 2)]


@case("two triangles", DISC, corners=[(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 0)])
def two_triangles():
    return [(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]


@case("four triangles, four vertices", SPHERE, vertices=4)
def tetrahedron():
    return [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]


@case("a pillow of two triangles", refused="repeats the three vertices of another")
def pillow():
    return [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 1)]


@case("two triangles at one place with vertices of their own: a seam whose sewing would give a pillow",
      Topology(2, 2, 2, True))
def pillow_apart():
    return joined(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 2, 1)]))


# Many faces at a vertex, many handles, many holes.


@case("3000 triangles at one vertex", DISC)
def fan():
    rim = [(np.cos(k * np.pi / 1500), np.sin(k * np.pi / 1500), 0.1 * np.sin(k * np.pi / 250)) for k in range(3000)]
    return np.array([(0, 0, 0)] + rim), [(0, k + 1, (k + 1) % 3000 + 1) for k in range(3000)]


@case("a plate with 36 holes through it: genus 36", Topology(2 - 72, 1, 0, True), vertices=900, volume=133)
def sieve():
    return voxels((x, y, 0) for x in range(13) for y in range(13) if x % 2 == 0 or y % 2 == 0)


@case("a plate with 9 holes through it and four vertices", Topology(2 - 18, 1, 0, True), vertices=4,
      notes=("vertices instead of 4",))
def sieve_four_vertices():
    return voxels((x, y, 0) for x in range(7) for y in range(7) if x % 2 == 0 or y % 2 == 0)


@case("a sheet with 300 holes", Topology(1 - 300, 1, 301, True), vertices=1500)
def holes():
    points, faces = grid(60, 60)
    hole = [(3 * (k // 20) + 1, 3 * (k % 20) + 1) for k in range(300)]
    gone = {2 * (60 * i + j) + k for i, j in hole for k in (0, 1)}
    return points, [f for t, f in enumerate(faces) if t not in gone]


again(holes, "holes_fixed", "a sheet with 300 holes, whose vertices stay", Topology(1 - 300, 1, 301, True),
      vertices=1500, args=("--boundary", "fixed"))
again(holes, "holes_smooth_few", "300 holes to be rounded off with 200 vertices", Topology(1 - 300, 1, 301, True),
      vertices=200, args=("--boundary", "smooth"), notes=("vertices instead of 200",))


@case("64 rooms and 144 passages between them: genus 81", Topology(2 - 2 * 81, 1, 0, True), vertices=1500)
def sponge():
    return voxels((x, y, z) for x in range(7) for y in range(7) for z in range(7)
                  if (x % 2) + (y % 2) + (z % 2) < 2)
