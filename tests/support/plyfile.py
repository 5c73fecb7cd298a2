# SPDX-License-Identifier: GPL-3.0-or-later
"""Small mesh files for the tests, written and read without any of the project's code."""
import re
import struct


def grid(n, height=0.0):
    """Points and triangles of an n x n sheet."""
    points = [(i / n, j / n, height * (i % 2)) for i in range(n + 1) for j in range(n + 1)]
    faces = []
    for i in range(n):
        for j in range(n):
            a, b = i * (n + 1) + j, (i + 1) * (n + 1) + j
            faces += [(a, b, b + 1), (a, b + 1, a + 1)]
    return points, faces


def box():
    """Points and triangles of a unit cube."""
    points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def write_ply(path, points, faces, quality=None, binary=True, double=False):
    """Polygons of any size; `quality` is one number a vertex."""
    number = "double" if double else "float"
    kind = "binary_little_endian" if binary else "ascii"
    head = f"ply\nformat {kind} 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property {number} {k}\n" for k in "xyz")
    head += f"property {number} quality\n" if quality is not None else ""
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    with open(path, "wb") as out:
        out.write(head.encode())
        for k, p in enumerate(points):
            row = list(p) + ([quality[k]] if quality is not None else [])
            out.write(struct.pack(f"<{len(row)}{number[0]}", *row) if binary
                      else (" ".join(map(repr, row)) + "\n").encode())
        for f in faces:
            out.write(struct.pack(f"<B{len(f)}i", len(f), *f) if binary
                      else (" ".join(map(str, [len(f), *f])) + "\n").encode())
    return path


def write_off(path, points, faces):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        out.writelines(" ".join(map(str, p)) + "\n" for p in points)
        out.writelines(" ".join(map(str, [len(f), *f])) + "\n" for f in faces)
    return path


def write_obj(path, points, faces):
    with open(path, "w", encoding="ascii") as out:
        out.writelines("v " + " ".join(map(str, p)) + "\n" for p in points)
        out.writelines("f " + " ".join(str(v + 1) for v in f) + "\n" for f in faces)
    return path


def write_stl(path, points, faces):
    with open(path, "wb") as out:
        out.write(b"\0" * 80 + struct.pack("<I", len(faces)))
        for f in faces:
            out.write(struct.pack("<12fH", 0, 0, 0, *[x for v in f for x in points[v]], 0))
    return path


def count_ply(path):
    """(vertices, faces) as the header says."""
    head = open(path, "rb").read(2000).decode("latin1")
    return tuple(int(re.search(rf"element {k} (\d+)", head)[1]) for k in ("vertex", "face"))


TYPES = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H", "uint16": "H",
         "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f", "double": "d",
         "float64": "d"}


def read_ply(path):
    """{element: [{property: value}]} of a little-endian binary file."""
    data = open(path, "rb").read()
    head, _, body = data.partition(b"end_header\n")
    assert b"format binary_little_endian" in head
    elements = []
    for line in head.decode("latin1").splitlines():
        word = line.split()
        if word[0] == "element":
            elements.append((word[1], int(word[2]), []))
        elif word[0] == "property":
            elements[-1][2].append((word[-1], [TYPES[t] for t in word[1:-1] if t != "list"]))
    result, at = {}, 0

    def take(kind, count=1):
        nonlocal at
        values = struct.unpack_from(f"<{count}{kind}", body, at)
        at += struct.calcsize(f"<{count}{kind}")
        return values
    for name, count, properties in elements:
        result[name] = []
        for _ in range(count):
            row = {}
            for key, kinds in properties:
                row[key] = take(kinds[0])[0] if len(kinds) == 1 else take(kinds[1], take(kinds[0])[0])
            result[name].append(row)
    return result
