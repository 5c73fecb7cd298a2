# SPDX-License-Identifier: GPL-3.0-or-later
"""PLY files of triangles as numpy arrays."""
import re

import numpy as np


def read_ply(path):
    """Points (n, 3) and triangles (m, 3) of a PLY file."""
    data = open(path, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode("ascii", "replace")
    vertices = int(re.search(r"element vertex (\d+)", header)[1])
    faces = int(re.search(r"element face (\d+)", header)[1])
    if "format ascii" in header:
        rows = data[end:].split(b"\n")
        points = np.array([r.split()[:3] for r in rows[:vertices]], float)
        return points, np.array([r.split()[1:4] for r in rows[vertices:vertices + faces]], int)
    sizes = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
             "float": "<f4", "double": "<f8", "float32": "<f4", "float64": "<f8", "uint8": "u1", "int32": "<i4"}
    block = header[header.index("element vertex"):header.index("element face")]
    fields = [(name, sizes[kind]) for kind, name in re.findall(r"property (\w+) (\w+)", block)]
    table = np.frombuffer(data, np.dtype(fields), vertices, end)
    points = np.stack([table[k].astype(float) for k in "xyz"], 1)
    block = header[header.index("element face"):]
    extra = [(name, sizes[kind]) for kind, name in re.findall(r"property (?!list)(\w+) (\w+)", block)]
    face = np.dtype([("n", "u1"), ("v", "<i4", 3)] + extra)
    return points, np.frombuffer(data, face, faces, end + vertices * table.dtype.itemsize)["v"]


def write_ply(path, points, faces, quality=None):
    """Binary, positions in double precision; `quality`: a value for each vertex."""
    names = ("x", "y", "z") if quality is None else ("x", "y", "z", "quality")
    table = np.column_stack([points] if quality is None else [points, quality])
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
            + "".join(f"property double {name}\n" for name in names) + f"element face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    rows = np.empty(len(faces), [("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    with open(path, "wb") as out:
        out.write(head.encode("ascii"))
        out.write(np.ascontiguousarray(table, "<f8").tobytes())
        out.write(rows.tobytes())
