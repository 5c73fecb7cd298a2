# SPDX-License-Identifier: GPL-3.0-or-later
"""What the nasty meshes are put together from: plain shapes, and ways to spoil them.

A mesh is a pair (points, faces): an array of n x 3 numbers, and a list of tuples of vertex numbers.
"""
import numpy as np


def sphere(subdivisions):
    """An icosahedron whose triangles are quartered, on the unit sphere."""
    g = (1 + 5 ** 0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
              (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    points = [np.array(p, float) for p in points]
    for _ in range(subdivisions):
        points, faces = quartered(points, faces)
    points = np.array(points)
    return points / np.linalg.norm(points, axis=1)[:, None], faces


def quartered(points, faces):
    points, middle, result = list(points), {}, []

    def mid(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append((points[a] + points[b]) / 2)
        return middle[key]
    for a, b, c in faces:
        x, y, z = mid(b, c), mid(c, a), mid(a, b)
        result += [(a, z, y), (b, x, z), (c, y, x), (x, y, z)]
    return points, result


def grid(nx, ny, at=lambda u, v: (u, v, 0.0)):
    """A sheet over the unit square."""
    points = np.array([at(i / nx, j / ny) for i in range(nx + 1) for j in range(ny + 1)], float)
    faces = []
    for i in range(nx):
        for j in range(ny):
            a, b = i * (ny + 1) + j, (i + 1) * (ny + 1) + j
            faces += [(a, b, b + 1), (a, b + 1, a + 1)]
    return points, faces


def torus(nu, nv, at, turned=False):
    """A grid that wraps around both ways; `turned`: after one turn v runs the other way."""
    points = np.array([at(2 * np.pi * i / nu, 2 * np.pi * j / nv) for i in range(nu) for j in range(nv)], float)

    def vertex(i, j):
        return (i % nu) * nv + (-j if turned and i == nu else j) % nv
    faces = []
    for i in range(nu):
        for j in range(nv):
            a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def round_torus(nu, nv, thickness):
    return torus(nu, nv, lambda a, b: ((1 + thickness * np.cos(b)) * np.cos(a), (1 + thickness * np.cos(b)) * np.sin(a),
                                       thickness * np.sin(b)))


def revolved(profile, slices):
    """Points (r, z) around the z axis; closed by a vertex at an end where r is 0."""
    points, rings, faces = [], [], []
    for r, z in profile:
        count = 1 if r == 0 else slices
        rings.append([len(points) + k for k in range(count)])
        points += [(r * np.cos(2 * np.pi * k / slices), r * np.sin(2 * np.pi * k / slices), z) for k in range(count)]
    for low, high in zip(rings, rings[1:]):
        for k in range(slices):
            a, b = low[k % len(low)], low[(k + 1) % len(low)]
            c, d = high[(k + 1) % len(high)], high[k % len(high)]
            faces += [f for f in ((a, b, c), (a, c, d)) if len(set(f)) == 3]
    return np.array(points), faces


def voxels(cells):
    """The surface of the unit cubes at integer places, each side two triangles; as manifold as the cubes meet."""
    number, faces, cells = {}, [], set(cells)
    for x, y, z in sorted(cells):
        for axis in range(3):
            for end in (0, 1):
                other = [x, y, z]
                other[axis] += 2 * end - 1
                if tuple(other) in cells:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                quad = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    p = [x, y, z]
                    p[axis] += end
                    p[u] += du
                    p[v] += dv
                    quad.append(number.setdefault(tuple(p), len(number)))
                a, b, c, d = quad if end else quad[::-1]
                faces += [(a, b, c), (a, c, d)]
    return np.array(list(number), float), faces


def box(nx, ny, nz, size=(1, 1, 1)):
    """A box with its sides divided."""
    points, faces = voxels((i, j, k) for i in range(nx) for j in range(ny) for k in range(nz))
    return points / (nx, ny, nz) * size, faces


def box_corners(size=(1, 1, 1)):
    return [(x * size[0], y * size[1], z * size[2]) for x in (0, 1) for y in (0, 1) for z in (0, 1)]


def prism(outline):
    """Over a polygon in the plane, counter-clockwise: two polygons and quadrangles; its corners are all its points."""
    n = len(outline)
    points = np.array([(x, y, z) for z in (0, 1) for x, y in outline], float)
    return points, [tuple(range(n))[::-1], tuple(range(n, 2 * n))] + \
        [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]


def joined(*meshes):
    points, faces = [], []
    for p, f in meshes:
        faces += [tuple(v + len(points) for v in t) for t in f]
        points += list(p)
    return np.array(points), faces


def moved(mesh, by=(0, 0, 0), scale=1.0):
    return mesh[0] * scale + np.array(by), mesh[1]


def soup(mesh):
    """Every face with vertices of its own."""
    return apart(mesh, range(len(mesh[1])), alone=True)


def apart(mesh, chosen, alone=False):
    """The chosen faces with vertices of their own, together or each alone."""
    points, faces, number = list(mesh[0]), list(mesh[1]), {}
    for t in chosen:
        for v in faces[t]:
            number.setdefault((v, t if alone else 0), len(points) + len(number))
        faces[t] = tuple(number[v, t if alone else 0] for v in faces[t])
    return used(points + [mesh[0][v] for v, _ in number], faces)


def used(points, faces):
    """Without the vertices that no face names."""
    kept = sorted({v for f in faces for v in f})
    number = {v: k for k, v in enumerate(kept)}
    return np.array([points[v] for v in kept]), [tuple(number[v] for v in f) for f in faces]


def welded(mesh):
    """Vertices at one place are one, and faces that name it twice are gone."""
    first = {}
    number = [first.setdefault(tuple(p), k) for k, p in enumerate(mesh[0])]
    faces = [tuple(number[v] for v in f) for f in mesh[1]]
    return used(mesh[0], [f for f in faces if len(set(f)) == 3])


def around(faces, v):
    """The neighbours of a vertex inside the surface, in the order of its faces."""
    follow = {f[(k + 1) % 3]: f[(k + 2) % 3] for f in faces for k in range(3) if f[k] == v}
    ring = [min(follow)]
    while follow[ring[-1]] != ring[0]:
        ring.append(follow[ring[-1]])
    return ring


def zoomed(mesh, v, times):
    """The edges at a vertex halved again and again."""
    points, faces = list(mesh[0]), list(mesh[1])
    for _ in range(times):
        ring = around(faces, v)
        faces = [f for f in faces if v not in f]
        new = [len(points) + k for k in range(len(ring))]
        points += [(points[v] + points[r]) / 2 for r in ring]
        for k, r in enumerate(ring):
            n = (k + 1) % len(ring)
            faces += [(v, new[k], new[n]), (new[k], r, ring[n]), (new[k], ring[n], new[n])]
    return np.array(points), faces


def with_caps(mesh, wanted=lambda p, q: True, most=1000, at=0.5):
    """A vertex on every edge of the wanted, on one side only: a face without area closes the gap on the other."""
    points, faces = list(mesh[0]), list(mesh[1])
    touched = set()
    for t, f in enumerate(mesh[1]):
        for k in range(3):
            a, b, c = f[k], f[(k + 1) % 3], f[(k + 2) % 3]
            if touched & {a, b, c} or most == 0 or not wanted(points[a], points[b]):
                continue
            touched |= {a, b, c}
            most -= 1
            m = len(points)
            points.append(points[a] + (points[b] - points[a]) * at)
            faces[t] = (a, m, c)
            faces += [(m, b, c), (a, b, m)]
            break
    return np.array(points), faces


def with_split_vertices(mesh, chosen):
    """Each of the vertices twice, joined by an edge without length."""
    points, faces = list(mesh[0]), list(mesh[1])
    for v in chosen:
        ring = around(faces, v)
        half, twin = len(ring) // 2, len(points)
        points.append(points[v])
        pairs = set(zip(ring[:half], ring[1:half + 1]))
        for t, f in enumerate(faces):
            for k in range(3):
                if f[k] == v and (f[(k + 1) % 3], f[(k + 2) % 3]) in pairs:
                    faces[t] = f[:k] + (twin,) + f[k + 1:]
        faces += [(v, ring[0], twin), (v, twin, ring[half])]
    return np.array(points), faces


def turned(faces, chosen):
    """The chosen faces the other way round."""
    chosen = set(chosen)
    return [f[::-1] if t in chosen else f for t, f in enumerate(faces)]
