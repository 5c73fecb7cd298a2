# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever comes in: a clear message, the right status, nothing written, no crash, no hang."""
import struct

import pytest

import plyfile

GRID = plyfile.grid(6)


def text(content):
    return lambda path: open(path, "w", encoding="latin1").write(content)


def binary(content):
    return lambda path: open(path, "wb").write(content)


def mesh(points, faces, **options):
    return lambda path: plyfile.write_ply(path, points, faces, **options)


HEADER = "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n" \
         "element face {}\nproperty list uchar int vertex_indices\nend_header\n"

UNREADABLE = {
    "empty.ply": text(""), "empty.off": text(""), "empty.obj": text(""), "empty.stl": text(""),
    "garbage.ply": binary(bytes(range(256)) * 20), "garbage.off": binary(bytes(range(256)) * 20),
    "garbage.stl": binary(bytes(range(256)) * 20), "unknown.xyz": text("1 2 3\n"),
    "no_newline.stl": text("solid"), "no_end.ply": text("ply\nformat ascii 1.0\nelement vertex 3\n"),
    "many_promised.ply": binary(HEADER.format("binary_little_endian", 2000000000, 0).encode()),
    "faces_promised.ply": binary(HEADER.format("binary_little_endian", 0, 2000000000).encode()),
    "negative.ply": binary(HEADER.format("binary_little_endian", -3, 1).encode()),
    "truncated.ply": binary(HEADER.format("binary_little_endian", 40, 10).encode() + b"\0" * 300),
    "promised.off": text("OFF\n1000000000 1000000000 0\n0 0 0\n"),
    "index.off": text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
    "corners.off": text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2\n"),
    "cut.off": text("OFF\n3 1 0\n0 0 0\n1 0 0\n"),
    "index.obj": text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "zero.obj": text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"),
    "short.obj": text("v 0 0\n"), "lying.stl": binary(b"\0" * 80 + struct.pack("<I", 4000000000) + b"\0" * 50),
    "cut.stl": text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0"),
    "index.ply": mesh(GRID[0], [(0, 1, 5000)]), "minus.ply": mesh(GRID[0], [(0, 1, -2)]),
}

NAN, INF = float("nan"), float("inf")
FIN = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
BOWTIE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, 1, 0)]
REFUSED = {
    "points.ply": (mesh(GRID[0], []), "no faces"),
    "points.obj": (text("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "no faces"),
    "non_manifold_edge.ply": (mesh(FIN, [(0, 1, 2), (1, 0, 3), (0, 1, 4)]), "1 edge has"),
    "non_manifold_vertex.ply": (mesh(BOWTIE, [(0, 1, 2), (0, 4, 3)]), "1 vertex joins"),
    "nan.ply": (mesh([(NAN, 0, 0)] + GRID[0][1:], GRID[1]), "1 vertex has"),
    "inf.ply": (mesh([(0, INF, 0)] + GRID[0][1:], GRID[1]), "not finite"),
    "flat.ply": (mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]), "no area"),
    "one_point.ply": (mesh([(1, 1, 1)] * 3, [(0, 1, 2)]), "one point"),
    "twice.ply": (mesh(FIN, [(0, 1, 2), (0, 2, 1)]), "1 face repeats"),
    "repeated.ply": (mesh(FIN, [(0, 0, 1), (2, 2, 3)]), "names a vertex twice"),
}


@pytest.mark.parametrize("name", UNREADABLE)
def test_unreadable(remesh, tmp_path, name):
    UNREADABLE[name](str(tmp_path / name))
    run = remesh(tmp_path / name, tmp_path / "o.ply", "-n", 100)
    assert run.returncode == 3, run.stderr
    assert name in run.stderr
    assert [p.name for p in tmp_path.iterdir()] == [name]


def test_missing_file_and_folder(remesh, tmp_path):
    assert remesh(tmp_path / "none.ply", tmp_path / "o.ply", "-n", 100).returncode == 3
    (tmp_path / "dir.ply").mkdir()
    assert remesh(tmp_path / "dir.ply", tmp_path / "o.ply", "-n", 100).returncode == 3


@pytest.mark.parametrize("name", REFUSED)
def test_refused_with_the_reason(remesh, tmp_path, name):
    make, reason = REFUSED[name]
    make(str(tmp_path / name))
    report = tmp_path / "r.json"
    run = remesh(tmp_path / name, tmp_path / "o.ply", "-n", 100, "--report", report)
    assert run.returncode == 4, run.stderr
    assert reason in run.stderr
    assert not (tmp_path / "o.ply").exists()
    assert reason in report.read_text(encoding="utf-8")


def test_quads_are_split_with_a_note(remesh, tmp_path):
    points, _ = GRID
    quads = [(i * 7 + j, (i + 1) * 7 + j, (i + 1) * 7 + j + 1, i * 7 + j + 1) for i in range(6) for j in range(6)]
    for write, name in ((plyfile.write_ply, "q.ply"), (plyfile.write_off, "q.off"), (plyfile.write_obj, "q.obj")):
        run = remesh(write(str(tmp_path / name), points, quads), tmp_path / "o.ply", "-n", 100, "--global-iterations", 2)
        assert run.returncode == 0, run.stderr
        assert "polygons that were split" in run.stdout


def test_obj_lines_that_go_on(remesh, tmp_path):
    points, faces = plyfile.grid(6)
    plain = plyfile.write_obj(str(tmp_path / "plain.obj"), points, faces)
    assert remesh(plain, tmp_path / "a.ply", "-n", 100, "--global-iterations", 2).returncode == 0
    for end in ("\n", "\r\n"):
        content = open(plain, encoding="ascii").read().replace("\n", end).replace(" ", f" \\{end}")
        (tmp_path / "broken.obj").write_bytes(content.encode())
        run = remesh(tmp_path / "broken.obj", tmp_path / "b.ply", "-n", 100, "--global-iterations", 2)
        assert run.returncode == 0, run.stderr
        assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()
    (tmp_path / "bad.obj").write_text("v 0 \\\n0 0\nv 0\n")
    assert "line 3 has fewer" in remesh(tmp_path / "bad.obj", tmp_path / "c.ply", "-n", 100).stderr


def test_zero_area_faces_and_loose_vertices_are_noted(remesh, tmp_path):
    points, faces = plyfile.grid(6)
    # A vertex on the middle of a side of the first face: one face without area.
    a, b, c = faces[0]
    middle = tuple((points[a][k] + points[c][k]) / 2 for k in range(3))
    points = points + [middle, (9, 9, 9)]
    m = len(points) - 2
    other = next(f for f in faces[1:] if a in f and c in f)
    apex = next(v for v in other if v not in (a, c))
    faces = [f for f in faces if f not in (faces[0], other)] + [(a, b, c), (a, c, m), (a, m, apex), (m, c, apex)]
    run = remesh(plyfile.write_ply(str(tmp_path / "z.ply"), points, faces), tmp_path / "o.ply", "-n", 100,
                 "--global-iterations", 2)
    assert run.returncode == 0, run.stderr
    assert "1 input face has no area" in run.stdout
    assert "1 vertex that no face uses was dropped" in run.stdout


def test_extreme_vertex_counts(remesh, samples, tmp_path):
    run = remesh(f"{samples}/cad_part.ply", tmp_path / "few.ply", "-n", 4, "--global-iterations", 2)
    assert run.returncode == 0 and "vertices instead of 4" in run.stdout
    assert plyfile.count_ply(tmp_path / "few.ply")[0] > 4
    run = remesh(f"{samples}/cad_part.ply", tmp_path / "many.ply", "-n", 60000, "--global-iterations", 0, "--quiet")
    assert run.returncode == 0
    assert plyfile.count_ply(tmp_path / "many.ply")[0] == 60000
