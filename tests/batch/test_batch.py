# SPDX-License-Identifier: GPL-3.0-or-later
"""Good and bad meshes, the summary, the ways to name inputs."""

import json
import math
import os

import plyfile
import pyarrow.parquet
import pytest

from conftest import PLUGIN

BUMPY = plyfile.grid(12, height=0.02)
GARBAGE = "this is not a mesh\n"
# Three triangles at one edge.
BOOK = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, -1, 0)], [(0, 1, 2), (0, 1, 3), (0, 1, 4)])


def vertices_of(path):
    return int(path.read_bytes().partition(b"element vertex ")[2].split()[0])


def test_good_and_bad_meshes(batch):
    (batch.inputs / "deep").mkdir()
    plyfile.write_ply(batch.inputs / "deep" / "box.ply", *plyfile.box())
    plyfile.write_off(batch.inputs / "sheet.off", *BUMPY)
    plyfile.write_off(batch.inputs / "book.off", *BOOK)
    (batch.inputs / "garbage.ply").write_text(GARBAGE)
    (batch.inputs / "empty.obj").write_text("")
    (batch.inputs / "notes.txt").write_text("no mesh")

    run = batch("--seed", 7, "--set", "lambda=0.1", expect=3)
    assert "5 meshes: 2 done, 0 kept, 3 failed" in run.stdout
    assert len(run.stderr.splitlines()) == 3
    assert "book.off: 1 edge has more than two faces" in run.stderr
    assert batch.files() == ["deep/box.ply", "deep/box.ply.json", "sheet.off", "sheet.off.json"]
    assert vertices_of(batch.output / "deep" / "box.ply") == 200

    rows = batch.rows()
    assert {name: row["status"] for name, row in rows.items()} == {
        "book.off": "failed",
        "deep/box.ply": "done",
        "empty.obj": "failed",
        "garbage.ply": "failed",
        "sheet.off": "done",
    }
    assert rows["book.off"]["kind"] == "refused" and rows["garbage.ply"]["kind"] == "unreadable"
    # The same comes out every time: none is tried again.
    assert {row["attempts"] for row in rows.values()} == {"1"}

    table = pyarrow.parquet.read_table(batch.output / "summary.parquet").to_pylist()
    box = {row["output"]: row for row in table}["deep/box.ply"]
    assert (box["vertices"], box["vertices_asked"], box["input_vertices"]) == (200, 200, 8)
    assert box["euler"] == box["input_euler"] == 2 and box["topology_preserved"] is True
    assert 40 < box["angle_min_avg"] <= 60 and 0 <= box["hausdorff"] < 0.01 and box["seconds"] > 0
    assert box["warnings"] is None and {row["output"]: row for row in table}["book.off"]["vertices"] is None
    assert len(table) == len(rows) and list(rows["book.off"]) == list(box)

    report = json.loads((batch.output / "deep" / "box.ply.json").read_text())["report"]
    assert report["parameters"]["seed"] == 7 and report["parameters"]["lambda"] == 0.1


def test_factor_format_list_and_glob(batch):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    plyfile.write_obj(batch.inputs / "b.obj", *BUMPY)
    plyfile.write_stl(batch.inputs / "c.stl", *BUMPY)
    plyfile.write_off(batch.inputs / "a.off", *BUMPY)
    (batch.folder / "list.txt").write_text("# meshes\nin/a.ply\n\nin/missing.ply\nin/b.obj\n")
    half = ("--vertices-factor", 0.5)

    run = batch(source=batch.folder / "list.txt", target=half, expect=3)
    assert "missing.ply: there is no such file" in run.stderr
    assert batch.rows()["in/a.ply"]["vertices"] == batch.rows()["in/b.obj"]["vertices"] == "84"

    batch("--format", "ply", source="in/[abc].[ops][btl][jly]", target=half)
    assert vertices_of(batch.output / "b.ply") == vertices_of(batch.output / "c.ply") == 84

    # Two inputs with one output: the first is done, the other is told of.
    run = batch("--format", "ply", target=half, expect=3)
    assert "its output 'a.ply' is already that of" in run.stderr
    assert [row["status"] for row in batch.rows().values()].count("kept") == 2


def test_a_file_of_somebody_else_is_left_alone(batch):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    batch.output.mkdir()
    (batch.output / "a.ply").write_text("precious")
    assert "was not made by ccdm-batch" in batch(expect=3).stderr
    assert (batch.output / "a.ply").read_text() == "precious"
    (batch.output / "a.ply").unlink()
    (batch.output / "a.ply.json").write_text('{"precious": true}')
    run = batch(expect=3)
    assert "a.ply.json' is there already and was not made by ccdm-batch" in run.stderr
    assert batch.rows()["a.ply"]["kind"] == "name" and batch.files() == ["a.ply.json"]
    assert (batch.output / "a.ply.json").read_text() == '{"precious": true}'


def test_annealing_has_random_samples(batch):
    """As the filter has them."""
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    batch("--set", "optimizer=annealing")
    parameters = json.loads((batch.output / "a.ply.json").read_text())["report"]["parameters"]
    assert (parameters["optimizer"], parameters["sampler"]) == ("annealing", "random")
    batch("--set", "optimizer=annealing", "--set", "sampler=front")
    parameters = json.loads((batch.output / "a.ply.json").read_text())["report"]["parameters"]
    assert (parameters["optimizer"], parameters["sampler"]) == ("annealing", "front")


@pytest.mark.parametrize(
    "options, message",
    [
        (["--vertices", "3"], "at least 4"),
        (["--feature-angle", "0"], "above 0"),
        (["--set", "lamda"], "NAME=VALUE"),
        (["--set", "lamda=0.1"], "has no parameter 'lamda'"),
        (["--set", "seed=1"], "use --seed"),
        (["--set", "max_error=1"], "the target is a number of vertices here"),
        (["--program", "/no/program"], "cannot be started"),
        (["--workers", "2"], "does not go with"),
        (["--engine", "pymeshlab"], "--plugin"),
        (["--time-limit", "0"], "--time-limit"),
    ],
)
def test_wrong_usage(batch, options, message):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    run = batch(*options, expect=2)
    assert message in run.stderr and len(run.stderr.splitlines()) == 1
    assert batch.files() == []


def test_wrong_folders(batch):
    assert "there is no mesh" in batch(expect=2).stderr
    assert "there is no '" in batch(source=batch.folder / "nowhere", expect=2).stderr
    mesh = plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    batch.output = batch.inputs
    assert "is one of the inputs" in batch(expect=2).stderr
    batch.output = mesh
    assert "is a file" in batch(expect=2).stderr
    batch.output = batch.folder / "out"
    run = batch("--scheduler", "tcp://127.0.0.1:1", "--wait", 1, expect=2)
    assert "does not answer" in run.stderr


@pytest.mark.skipif(not os.path.exists(PLUGIN), reason="CCDM_PYMESHLAB_PLUGIN names no plugin")
def test_pymeshlab(batch):
    pytest.importorskip("pymeshlab")
    plyfile.write_ply(batch.inputs / "sheet.ply", *BUMPY)
    plyfile.write_off(batch.inputs / "book.off", *BOOK)
    (batch.inputs / "garbage.ply").write_text(GARBAGE)
    options = ["--feature-angle", 60, "--density", "curvature", "--set", "lambda=0.1"]
    batch("--plugin", PLUGIN, *options, program=None, expect=3)
    with_pymeshlab = batch.rows()
    assert {row["kind"] for row in with_pymeshlab.values()} == {"", "refused", "unreadable"}
    assert "more than two faces" in with_pymeshlab["book.off"]["reason"]

    # The same run with the command line: not kept, as the engine is another, and with equal figures.
    batch(*options, expect=3)
    row, other = with_pymeshlab["sheet.ply"], batch.rows()["sheet.ply"]
    assert other["status"] == "done"
    for name in ("vertices", "faces", "euler", "topology_preserved", "vertices_asked", "input_vertices"):
        assert row[name] == other[name], name
    for name in ("angle_min_avg", "angle_min", "hausdorff", "rms", "pct_lt30"):
        assert float(row[name]) == pytest.approx(float(other[name]), rel=1e-3, abs=1e-9), name
    for suffix in ("off", "obj", "stl"):
        options = ["--plugin", PLUGIN, "--format", suffix, "--quiet"]
        batch(*options, source=batch.inputs / "sheet.ply", program=None)
        assert batch.rows()[f"sheet.{suffix}"]["vertices"] == "200"
    lines = (batch.output / "sheet.obj").read_text().splitlines()
    normals = [[float(x) for x in line.split()[1:]] for line in lines if line.startswith("vn ")]
    assert len(normals) == 200
    assert all(math.hypot(*normal) == pytest.approx(1, abs=1e-4) for normal in normals)
    batch("--plugin", PLUGIN, "--set", "optimizer=best", program=None, expect=3)
    assert (batch.rows()["sheet.ply"]["kind"], batch.rows()["book.off"]["kind"]) == ("usage", "usage")
    assert (
        "no parameter 'lamda'" in batch("--plugin", PLUGIN, "--set", "lamda=1", program=None, expect=2).stderr
    )
    assert "no plugin file" in batch("--plugin", "nothing.so", program=None, expect=2).stderr
