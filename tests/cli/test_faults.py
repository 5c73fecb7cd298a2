# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever fails around it: no crash, no hang, no file that is half written, nothing left behind."""
import concurrent.futures
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import tempfile
import time

import pytest

import plyfile

FAST = ("--global-iterations", "0", "--quiet")
FORMATS = ("ply", "off", "obj", "stl")
MEGABYTE = 1 << 20


def limited(kind, most):
    return {"preexec_fn": lambda: resource.setrlimit(kind, (most, most))}


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def command(*args):
    return [os.environ["CCDM_REMESH"], *map(str, args)]


# Where it cannot be written.

@pytest.mark.parametrize("extension", FORMATS)
def test_output_that_cannot_be_written_to_its_end(remesh, samples, tmp_path, extension):
    out = tmp_path / f"o.{extension}"
    args = (f"{samples}/sphere.ply", out, "-n", 300, *FAST)
    assert remesh(*args).returncode == 0
    complete = out.read_bytes()
    for most in (0, 1, 100, len(complete) // 2, len(complete) - 4097, len(complete) - 100, len(complete) - 1):
        out.write_bytes(b"old")
        run = remesh(*args, **limited(resource.RLIMIT_FSIZE, most))
        assert run.returncode == 5 and f"{out}: it could not be written to its end: File too large" in run.stderr
        assert out.read_bytes() == b"old" and names(tmp_path) == [out.name]
    assert remesh(*args, **limited(resource.RLIMIT_FSIZE, len(complete))).returncode == 0
    assert out.read_bytes() == complete


def test_report_that_cannot_be_written_to_its_end(remesh, samples, tmp_path):
    args = (f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 30, "--report", tmp_path / "r.json", *FAST)
    assert remesh(*args).returncode == 0
    complete, size = (tmp_path / "o.ply").read_bytes(), (tmp_path / "r.json").stat().st_size
    assert len(complete) < size - 200
    (tmp_path / "r.json").write_text("old")
    run = remesh(*args, **limited(resource.RLIMIT_FSIZE, size - 100))
    assert run.returncode == 5 and "r.json: it could not be written to its end" in run.stderr
    assert (tmp_path / "o.ply").read_bytes() == complete
    assert (tmp_path / "r.json").read_text() == "old" and names(tmp_path) == ["o.ply", "r.json"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full")
def test_full_device(remesh, samples, tmp_path):
    for extension in FORMATS:
        full, void = tmp_path / f"full.{extension}", tmp_path / f"void.{extension}"
        full.symlink_to("/dev/full")
        void.symlink_to("/dev/null")
        run = remesh(f"{samples}/sphere.ply", full, "-n", 30, *FAST)
        assert run.returncode == 5 and "No space left on device" in run.stderr
        assert remesh(f"{samples}/sphere.ply", void, "-n", 30, *FAST).returncode == 0
        assert full.is_symlink() and void.is_symlink()
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 30, "--report", "/dev/full", *FAST)
    assert run.returncode == 5 and "/dev/full: it could not be written to its end" in run.stderr
    assert plyfile.count_ply(tmp_path / "o.ply")[0] == 30


def test_full_file_system(remesh, samples, tmp_path, tiny_file_system):
    for extension in FORMATS:
        run = remesh(f"{samples}/sphere.ply", tiny_file_system / f"o.{extension}", "-n", 500, *FAST)
        assert run.returncode == 5 and "No space left on device" in run.stderr
        assert not names(tiny_file_system)
    (tiny_file_system / "other").write_bytes(bytes(15000))
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 30, "--report", tiny_file_system / "r.json", *FAST)
    assert run.returncode == 5 and "r.json" in run.stderr and names(tiny_file_system) == ["other"]


def test_folders_that_take_no_file(remesh, samples, tmp_path):
    (tmp_path / "file").write_text("")
    for folder, told in ((tmp_path / "file", "its folder does not exist"),
                         (pathlib.Path("/proc"), "no file can be made")):
        if folder.exists():
            run = remesh(f"{samples}/sphere.ply", folder / "o.ply", "-n", 30, *FAST)
            assert run.returncode == 5 and told in run.stderr
            run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 30, "--report", folder / "r.json", *FAST)
            assert run.returncode == 5 and told in run.stderr
    assert names(tmp_path) == ["file"]


def test_read_only_folder(samples):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        # Permissions do not keep root out; others may not be let into the project's folders.
        program, source = folder / "ccdm_remesh", folder / "in.ply"
        shutil.copy(os.environ["CCDM_REMESH"], program)
        shutil.copy(f"{samples}/sphere.ply", source)
        source.chmod(0o644)
        folder.chmod(0o555)
        other = {"user": 65534, "group": 65534} if os.geteuid() == 0 else {}
        run = subprocess.run([program, source, folder / "o.ply", "-n", "30", *FAST], capture_output=True, text=True,
                             timeout=60, check=False, cwd="/", **other)
        folder.chmod(0o755)
        assert run.returncode == 5 and "o.ply: no file can be made in its folder" in run.stderr
        assert names(folder) == ["ccdm_remesh", "in.ply"]


def test_output_in_place_of_the_input(remesh, samples, tmp_path):
    mesh = tmp_path / "mesh.ply"
    shutil.copy(f"{samples}/sphere.ply", mesh)
    assert remesh(mesh, tmp_path / "other.ply", "-n", 50, *FAST).returncode == 0
    assert remesh(mesh, mesh, "-n", 50, *FAST).returncode == 0
    assert mesh.read_bytes() == (tmp_path / "other.ply").read_bytes()
    before = mesh.read_bytes()
    assert remesh(mesh, mesh, "-n", 3000, *FAST, **limited(resource.RLIMIT_FSIZE, 1000)).returncode == 5
    assert mesh.read_bytes() == before and names(tmp_path) == ["mesh.ply", "other.ply"]


def test_names_as_long_as_they_may_be(remesh, samples, tmp_path):
    out = tmp_path / ("o" * 251 + ".ply")
    assert remesh(f"{samples}/sphere.ply", out, "-n", 30, *FAST).returncode == 0
    assert names(tmp_path) == [out.name]


# Runs that are ended.

def kill_after(args, wait, number):
    with subprocess.Popen(args, stderr=subprocess.DEVNULL) as process:
        wait(process)
        process.send_signal(number)
        return process.wait(timeout=60)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_what_ends_a_run_is_told(samples, tmp_path, number):
    report = tmp_path / "r.json"
    args = command(f"{samples}/bumpy.ply", tmp_path / "o.ply", "-n", 30000, "--global-iterations", 100000, "--quiet",
                   "--report", report)
    assert kill_after(args, lambda _: time.sleep(0.5), number) == 128 + number
    assert names(tmp_path) == ["r.json"] and json.loads(report.read_text())["status"] == 128 + number


def test_signals_that_the_caller_ignores(samples, tmp_path):
    args = command(f"{samples}/bumpy.ply", tmp_path / "o.ply", "-n", 1000, "--global-iterations", 20, "--quiet")
    with subprocess.Popen(args, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) as process:
        time.sleep(0.1)
        process.send_signal(signal.SIGHUP)
        assert process.wait(timeout=60) == 0
    assert names(tmp_path) == ["o.ply"]


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_ended_at_any_time(remesh, samples, tmp_path, number):
    """At random times, and as soon as there is a temporary file."""
    out = tmp_path / "o.off"
    args = command(f"{samples}/sphere.ply", out, "-n", 3000, *FAST)
    start = time.monotonic()
    subprocess.run(args, check=True)
    seconds = time.monotonic() - start
    new = out.read_bytes()
    rng = random.Random(1)

    def any_time(_):
        time.sleep(rng.uniform(0, 1.1 * seconds))

    def size(path):
        try:
            return path.stat().st_size
        except FileNotFoundError:  # renamed in between
            return 0

    def while_writing(process):
        # The first is made to see whether there can be one.
        while process.poll() is None and not any(size(path) > 0 for path in tmp_path.glob(".*")):
            pass
    for wait in [any_time] * 8 + [while_writing] * 4:
        out.write_bytes(b"old")
        status = kill_after(args, wait, number)
        assert out.read_bytes() in (b"old", new)
        left = [name for name in names(tmp_path) if name != out.name]
        if number == signal.SIGKILL:
            assert status in (0, -number) and all(name.startswith(".o.off.part") for name in left)
        else:
            # By default until the program has come so far as to catch it.
            assert status in (0, -number, 128 + number) and not left
        if status == 0:
            assert out.read_bytes() == new
    assert remesh(*args[1:]).returncode == 0 and out.read_bytes() == new


def test_left_by_killed_runs(remesh, samples, tmp_path):
    for k in range(20):
        (tmp_path / f".o.ply.part{k}").write_text("left behind")
        os.utime(tmp_path / f".o.ply.part{k}", (1000 - k, 1000 - k))
    before = set(names(tmp_path))
    for _ in range(2):
        assert remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 30, *FAST).returncode == 0
    assert set(names(tmp_path)) - before == {"o.ply"}, "no more of them than before"
    assert before - set(names(tmp_path)) == {".o.ply.part7"}, "the oldest of those in the way gives way"


def test_runs_beside_each_other(remesh, samples, tmp_path):
    out = tmp_path / "o.ply"
    args = (f"{samples}/sphere.ply", out, "-n", 2000, *FAST)
    assert remesh(*args).returncode == 0
    complete = out.read_bytes()
    out.unlink()
    with concurrent.futures.ThreadPoolExecutor(6) as pool:
        assert all(run.returncode == 0 for run in pool.map(lambda _: remesh(*args), range(6)))
    assert out.read_bytes() == complete and names(tmp_path) == ["o.ply"]


# Streams.

@pytest.mark.parametrize("closed", [(1,), (2,), (0, 1, 2)])
def test_closed_streams(samples, tmp_path, closed):
    args = command(f"{samples}/sphere.ply", tmp_path / "a.ply", "-n", 30, "--global-iterations", 0)
    assert subprocess.run(args, check=False, capture_output=True).returncode == 0
    args[2] = str(tmp_path / "b.ply")
    run = subprocess.run([*args, "--report", tmp_path / "r.json"], check=False, timeout=60,
                         preexec_fn=lambda: [os.close(k) for k in closed])
    assert run.returncode == 0
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()
    assert json.loads((tmp_path / "r.json").read_text())["status"] == 0
    run = subprocess.run(command(tmp_path / "none.ply", tmp_path / "c.ply", "-n", 30), check=False, timeout=60,
                         preexec_fn=lambda: [os.close(k) for k in closed])
    assert run.returncode == 3


def test_readers_that_went_away(samples, tmp_path):
    read, write = os.pipe()
    os.close(read)
    report = tmp_path / "r.json"
    run = subprocess.run(command(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 30, "--global-iterations", 0,
                                 "--report", report), check=False, timeout=60, stdout=write, stderr=write)
    os.close(write)
    assert run.returncode == 0 and json.loads(report.read_text())["status"] == 0


# What comes in.

def test_input_that_is_no_file(remesh, tmp_path):
    os.mkfifo(tmp_path / "pipe.ply")
    (tmp_path / "folder.ply").mkdir()
    for name in ("pipe.ply", "folder.ply"):
        run = remesh(tmp_path / name, tmp_path / "o.ply", "-n", 30, *FAST)
        assert run.returncode == 3 and "it is not a file" in run.stderr


PLY = "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n" \
      "element face {}\nproperty list {} int vertex_indices\nend_header\n"
TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
MANY = 2147483647
LYING = {
    "vertices.ply": PLY.format("binary_little_endian", MANY, 1, "uchar").encode() + TRIANGLE,
    "faces.ply": PLY.format("binary_little_endian", 3, MANY, "uchar").encode() + TRIANGLE + b"\3" + bytes(12),
    "corners.ply": PLY.format("binary_little_endian", 3, 1, "uint").encode() + TRIANGLE + b"\xff" * 64,
    "vertices_big.ply": PLY.format("binary_big_endian", MANY, 1, "uchar").encode() + TRIANGLE,
    "faces_big.ply": PLY.format("binary_big_endian", 3, MANY, "uchar").encode() + TRIANGLE + b"\3" + bytes(12),
    "corners_big.ply": PLY.format("binary_big_endian", 3, 1, "int").encode() + TRIANGLE + b"\x7f" * 64,
    "vertices_text.ply": PLY.format("ascii", MANY, 1, "uchar").encode() + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "faces_text.ply": PLY.format("ascii", 3, MANY, "uchar").encode() + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "corners_text.ply": PLY.format("ascii", 3, 1, "int").encode() + b"0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n",
    "beyond.ply": PLY.format("ascii", 10 ** 30, 1, "int").encode() + b"0 0 0\n",
    "vertices.off": f"OFF\n{MANY} 1 0\n0 0 0\n".encode(),
    "faces.off": f"OFF\n3 {MANY} 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n".encode(),
    "corners.off": f"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n{MANY} 0 1 2\n".encode(),
    "beyond.off": b"OFF\n99999999999999999999 1 0\n0 0 0\n",
    "index.obj": f"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {MANY}\n".encode(),
    "beyond.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n",
    "facets.stl": bytes(80) + struct.pack("<I", 0xffffffff) + bytes(100),
    "facets_text.stl": b"solid a\n" + b"facet normal 0 0 1\n" * 100000,
}


@pytest.mark.parametrize("name", LYING)
def test_what_a_file_promises_takes_no_memory(remesh, tmp_path, name):
    (tmp_path / name).write_bytes(LYING[name])
    run = remesh(tmp_path / name, tmp_path / "o.ply", "-n", 30, *FAST, **limited(resource.RLIMIT_AS, 300 * MEGABYTE))
    assert run.returncode == 3 and run.stderr.startswith(f"ccdm_remesh: {tmp_path / name}: "), run.stderr
    assert "memory" not in run.stderr and names(tmp_path) == [name]


def big_endian(path, points, faces):
    data = PLY.format("binary_big_endian", len(points), len(faces), "uchar").encode()
    data += b"".join(struct.pack(">3f", *p) for p in points) + b"".join(struct.pack(">B3i", 3, *f) for f in faces)
    pathlib.Path(path).write_bytes(data)


def text_stl(path, points, faces):
    lines = ["solid a"]
    for f in faces:
        lines += ["facet normal 0 0 1", "outer loop", *("vertex {} {} {}".format(*points[v]) for v in f), "endloop",
                  "endfacet"]
    pathlib.Path(path).write_text("\n".join([*lines, "endsolid a", ""]), encoding="ascii")


WRITERS = {"little.ply": plyfile.write_ply, "big.ply": big_endian,
           "text.ply": lambda *mesh: plyfile.write_ply(*mesh, binary=False), "mesh.off": plyfile.write_off,
           "mesh.obj": plyfile.write_obj, "binary.stl": plyfile.write_stl, "text.stl": text_stl}


@pytest.mark.parametrize("name", WRITERS)
def test_files_that_are_cut_anywhere(remesh, tmp_path, name):
    points, faces = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    WRITERS[name](str(tmp_path / name), points, faces)
    whole = (tmp_path / name).read_bytes()

    def status(size):
        folder = tmp_path / str(size)
        folder.mkdir()
        (folder / name).write_bytes(whole[:size])
        run = remesh(folder / name, folder / "o.ply", "-n", 30, "--threads", 1, *FAST)
        assert set(names(folder)) == ({name, "o.ply"} if run.returncode == 0 else {name})
        assert (run.returncode == 0) == (run.stderr == "")
        return run.returncode
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        sizes = [*range(0, len(whole), 7), len(whole)]
        statuses = list(pool.map(status, sizes))
    assert statuses[-1] == 0 and set(statuses) <= {0, 3, 4}
    # Of a text, what is left may be a smaller mesh.
    assert name in ("mesh.obj", "text.stl") or set(statuses[:len(whole) // 8]) == {3}


# Memory.

@pytest.mark.parametrize("megabytes", [30, 40, 60, 80, 120, 160])
def test_not_enough_memory(remesh, samples, tmp_path, megabytes):
    report = tmp_path / "r.json"
    run = remesh(f"{samples}/bumpy.ply", tmp_path / "o.ply", "-n", 300000, "--report", report, *FAST,
                 **limited(resource.RLIMIT_AS, megabytes * MEGABYTE))
    assert run.returncode == 4 and "not enough memory" in run.stderr, run.stderr
    assert names(tmp_path) in (["r.json"], [])
    assert not report.exists() or json.loads(report.read_text())["status"] == 4
