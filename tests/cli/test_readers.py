# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of every format as other programs write them: one sheet in many spellings makes one result."""
import json
import os
import struct

import plyfile
import pytest

POINTS, FACES = plyfile.grid(6, 0.1)
FAST = ("-n", 60, "--global-iterations", 1)


def ply(form, body, vertex="float x\nproperty float y\nproperty float z", face="list uchar int vertex_indices",
        element="face", count=None, end="\n", extra=""):
    head = f"ply\nformat {form} 1.0\ncomment made by hand\nobj_info nothing\nelement vertex {len(POINTS)}\n" \
           f"property {vertex}\n{extra}element {element} {len(FACES) if count is None else count}\nproperty {face}\n" \
           "end_header\n"
    return head.replace("\n", end).encode() + body


def ply_text(separator="\n"):
    rows = ["%.17g %.17g %.17g" % p for p in POINTS] + ["3 %d %d %d" % f for f in FACES]
    return (separator.join(rows) + separator).encode()


def ply_binary(order, number="d"):
    return b"".join(struct.pack(f"{order}3{number}", *p) for p in POINTS) + \
        b"".join(struct.pack(f"{order}B3i", 3, *f) for f in FACES)


def strips():
    """Each row of squares is a strip; -1 stands between them."""
    indices = []
    for i in range(6):
        for j in range(7):
            indices += [i * 7 + j, (i + 1) * 7 + j]
        indices.append(-1)
    return indices


def off(keyword, extra="", counts_behind=False):
    counts = f"{len(POINTS)} {len(FACES)} 0"
    rows = [f"{keyword} {counts}" if counts_behind else f"{keyword}\n# a comment\n\n{counts}"]
    rows += ["%.17g %.17g %.17g%s # first" % (*p, extra) for p in POINTS] + ["3 %d %d %d 255 0 0" % f for f in FACES]
    return ("\n".join(rows) + "\n").encode()


def obj(spell, turn=lambda k: k):
    rows = ["mtllib a.mtl", "o sheet"] + ["v %.17g %.17g %.17g 0.5 0.5 0.5" % p for p in POINTS] + ["vt 0 0", "vn 0 0 1"]
    rows += ["s off"] + ["f " + " ".join(spell % turn(v + 1) for v in f) for f in FACES]
    return ("\n".join(rows) + "\n").encode()


DOUBLES = "double x\nproperty double y\nproperty double z"
SPELLINGS = {
    "text.ply": ply("ascii", ply_text()),
    "one_line.ply": ply("ascii", ply_text(" ")),
    "crlf.ply": ply("ascii", ply_text("\r\n"), end="\r\n"),
    "little.ply": ply("binary_little_endian", ply_binary("<"), DOUBLES),
    "big.ply": ply("binary_big_endian", ply_binary(">"), DOUBLES),
    "other_elements.ply": ply("ascii", ply_text() + b"4 1 2 3 4\n", extra="").replace(
        b"end_header", b"element odd 1\nproperty list uint8 float64 numbers\nend_header"),
    "plain.off": off("OFF"), "counts_behind.off": off("OFF", counts_behind=True),
    "colours.off": off("COFF", " 255 255 255 255"), "normals.off": off("NOFF", " 0 0 1"),
    "plain.obj": obj("%d"), "slashes.obj": obj("%d/1/1"), "no_texture.obj": obj("%d//1"),
    "backwards.obj": obj("%d", lambda k: k - len(POINTS) - 1),
}


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    return tmp_path_factory.mktemp("expected") / "o.ply"


@pytest.mark.parametrize("name", SPELLINGS)
def test_spellings_of_one_mesh(remesh, tmp_path, expected, name):
    (tmp_path / name).write_bytes(SPELLINGS[name])
    run = remesh(tmp_path / name, tmp_path / "o.ply", *FAST)
    assert run.returncode == 0, run.stderr
    assert "split" not in run.stdout
    if not expected.exists():
        plyfile.write_obj(str(tmp_path / "reference.obj"), POINTS, FACES)
        assert remesh(tmp_path / "reference.obj", expected, *FAST).returncode == 0
    assert (tmp_path / "o.ply").read_bytes() == expected.read_bytes()


def test_strips(remesh, tmp_path):
    indices = strips()
    body = "".join("%.17g %.17g %.17g\n" % p for p in POINTS) + f"{len(indices)} " + " ".join(map(str, indices)) + "\n"
    (tmp_path / "s.ply").write_bytes(ply("ascii", body.encode(), face="list int int vertex_indices", element="tristrips",
                                         count=1))
    report = tmp_path / "r.json"
    run = remesh(tmp_path / "s.ply", tmp_path / "o.ply", *FAST, "--report", report)
    assert run.returncode == 0, run.stderr
    told = json.loads(report.read_text())["input"]
    assert told["faces"] == 72 and told["boundary_loops"] == 1 and told["defects"]["turned_faces"] == 0


def test_polygons_that_are_not_convex_are_covered_once(remesh, tmp_path):
    # The letter L, a star, and a polygon whose first corner is the one that points inwards.
    for corners in ([(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)],
                    [(0, 3), (1, 1), (3, 0), (1, -1), (0, -3), (-1, -1), (-3, 0), (-1, 1)],
                    [(1, 1), (0, 4), (-4, -4), (4, 0)]):
        area = abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, corners[1:] + corners[:1]))) / 2
        path = plyfile.write_obj(str(tmp_path / "p.obj"), [(x, y, 0.0) for x, y in corners], [tuple(range(len(corners)))])
        report = tmp_path / "r.json"
        run = remesh(path, tmp_path / "o.ply", *FAST, "--report", report)
        assert run.returncode == 0, run.stderr
        assert f"{len(corners) - 2} triangles come from polygons" in run.stdout
        told = json.loads(report.read_text())
        assert told["input"]["folded_edges"] == 0 and told["result"]["folded_edges"] == 0
        content = plyfile.read_ply(tmp_path / "o.ply")
        p = [(v["x"], v["y"]) for v in content["vertex"]]
        covered = sum(abs((p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) - (p[c][0] - p[a][0]) * (p[b][1] - p[a][1])) / 2
                      for a, b, c in (f["vertex_indices"] for f in content["face"]))
        # Corners that turn by less than the feature angle are cut.
        assert covered == pytest.approx(area, rel=0.01)


def test_needles_that_took_minutes(remesh, tmp_path):
    """A file that was fuzzed: its first byte names the format. Without the sanitizers, as it was only slow."""
    corpus = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "fuzz", "corpus")
    source = tmp_path / "needles.stl"
    with open(os.path.join(corpus, "slow", "stl_of_needles_1e38_wide"), "rb") as file:
        source.write_bytes(file.read()[1:])
    done = remesh(source, tmp_path / "o.ply", "-n", 4, "--global-iterations", 0)
    assert done.returncode in (0, 6), done.stderr
    assert (done.returncode == 0) == (tmp_path / "o.ply").exists()
