# SPDX-License-Identifier: GPL-3.0-or-later
"""The nasty inputs: what each is, what is asked of it, and what has to come out. The same on every machine."""
from dataclasses import dataclass, field

import numpy as np

import pieces
from pieces import box, box_corners, grid, joined, moved, round_torus, sphere, voxels
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


@case("a cone with a tip of one degree", SPHERE,
      fails="the tip is cut off, by two spacings")
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
