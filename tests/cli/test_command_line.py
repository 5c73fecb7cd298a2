# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line as its users drive it: options, exit statuses, formats, reports."""
import json
import os
import shutil
import signal
import struct
import subprocess
import time

import pytest

import plyfile

FAST = ("--global-iterations", "3", "--quiet")


def test_help_names_every_option(remesh):
    text = remesh("--help").stdout
    for option in ("--vertices", "--edge-length", "--max-error", "--feature-angle", "--lambda", "--global-iterations", "--local-iterations", "--density",
                   "--density-exponent", "--approximation", "--boundary", "--optimizer", "--sampler", "--seed", "--report", "--quiet", "--version"):
        assert option in text
    assert remesh("--version").stdout.startswith("ccdm_remesh ")
    assert "annealing" in text and "uniform" in text and "Target (exactly one)" in text
    for noise in ("ENUM", ":value in", "FLOAT", "1e-06", "Option Group", "\n\n\n"):
        assert noise not in text
    assert max(map(len, text.splitlines())) <= 100


@pytest.mark.parametrize("args, told", [
    (("-n", "100", "--density", "1"), "--density: '1' is none of curvature, quality, uniform"),
    (("-n", "100", "--optimizer", "magic"), "--optimizer: 'magic' is none of accelerated, annealing"),
    (("--vertces", "100"), "there is no option --vertces; is --vertices meant?"),
    (("-n", "100", "--seeed=4"), "there is no option --seeed; is --seed meant?"),
    (("-n", "100", "--no-such-option"), "there is no option --no-such-option\n"),
    (("-n", "1e3"), "--vertices: '1e3' is not a whole number from 4 to 100000000"),
    (("-n", "100", "--lambda", "2"), "--lambda: '2' is not a number from 0 to 1"),
    (("--edge-length", "nan"), "--edge-length: 'nan' is not a number above 0"),
    ((), "exactly one of --vertices, --edge-length and --max-error is needed"),
    (("-n", "100", "--max-error", "0.1"), "exactly one of --vertices, --edge-length and --max-error is needed")])
def test_wrong_usage_is_told_clearly(remesh, samples, tmp_path, args, told):
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", *args)
    assert run.returncode == 2 and run.stderr.startswith(f"ccdm_remesh: {told}"), run.stderr


def test_choices_may_be_written_in_capitals(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    assert remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 100, "--optimizer", "Annealing", "--report", report,
                  *FAST).returncode == 0
    assert json.loads(report.read_text())["parameters"]["optimizer"] == "annealing"


def test_boundary_by_choice(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    corners = {}
    for kind in ("sliding", "fixed", "smooth"):
        assert remesh(f"{samples}/plate.ply", tmp_path / "o.ply", "-n", 600, "--boundary", kind, "--report", report,
                      *FAST).returncode == 0
        told = json.loads(report.read_text())
        assert told["parameters"]["boundary"] == kind
        corners[kind] = told["features"]["corners"]
    assert corners["smooth"] < corners["sliding"] < corners["fixed"]


def test_exact_vertex_count_and_table(remesh, samples, tmp_path):
    out = tmp_path / "out.ply"
    run = remesh(f"{samples}/bumpy.ply", out, "-n", 1000, "--global-iterations", 3)
    assert run.returncode == 0, run.stderr
    assert plyfile.count_ply(out)[0] == 1000
    assert "average smallest angle" in run.stdout and "topology preserved" in run.stdout


def test_quiet_prints_nothing(remesh, samples, tmp_path):
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 100, *FAST)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


def test_report_has_every_key(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    run = remesh(f"{samples}/cad_part.ply", tmp_path / "o.ply", "-n", 800, "--report", report, *FAST, "--seed", 7)
    assert run.returncode == 0
    data = json.loads(report.read_text())
    assert set(data) >= {"input", "parameters", "result", "topology_preserved", "energy", "accepted", "seconds", "warnings"}
    assert set(data["result"]) >= {"vertices", "faces", "euler", "components", "boundary_loops", "genus", "orientable",
                                   "angle_min_avg", "angle_min", "pct_lt30", "q_fb99_avg", "q_fb99_min", "hausdorff",
                                   "rms", "pct_valence6"}
    assert data["result"]["vertices"] == 800 and data["result"]["genus"] == 2 and data["result"]["euler"] == -2
    assert data["topology_preserved"] is True
    assert len(data["energy"]) == 4 and 0 <= data["accepted"] <= 3
    assert data["parameters"]["seed"] == 7 and data["parameters"]["density_exponent"] == 2
    assert data["seconds"]["total"] > 0 and data["seconds"]["optimising"] > 0 and data["seconds"]["measuring"] > 0
    phases = sum(seconds for phase, seconds in data["seconds"].items() if phase != "total")
    assert phases == pytest.approx(data["seconds"]["total"], abs=0.2)
    assert 0 < data["result"]["hausdorff"] < 0.02


def test_edge_length_is_met(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    assert remesh(f"{samples}/bumpy.ply", tmp_path / "o.ply", "--edge-length", 0.09, "--report", report,
                  *FAST).returncode == 0
    data = json.loads(report.read_text())
    assert data["target"]["kind"] == "edge_length" and data["target"]["asked"] == 0.09
    assert data["target"]["reached"] == data["result"]["mean_edge_length"] == pytest.approx(0.09, rel=0.02)
    assert data["target"]["runs"] == 1 and data["target"]["met"] is True
    assert data["parameters"]["edge_length"] == 0.09 and data["parameters"]["vertices"] is None


def test_edge_length_out_of_reach_is_told(remesh, tmp_path):
    report = tmp_path / "r.json"
    source = plyfile.write_ply(str(tmp_path / "t.ply"), [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    run = remesh(source, tmp_path / "o.ply", "--edge-length", 100, "--report", report, "--global-iterations", 1)
    assert run.returncode == 0, run.stderr
    assert "mean edge length: asked 100, reached" in run.stdout and "(not met)" in run.stdout
    assert "note: the edge length asked for was not reached" in run.stdout
    data = json.loads(report.read_text())
    assert data["target"]["met"] is False and data["target"]["reached"] < 2
    assert any("was not reached" in w for w in data["warnings"])


def test_what_the_input_does_not_allow_is_refused(remesh, samples, tmp_path):
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "--edge-length", "1e-9")
    assert run.returncode == 4 and "takes more than 100000000 vertices" in run.stderr
    assert not list(tmp_path.iterdir())


def test_max_error_by_default(remesh, samples, tmp_path):
    # Without --global-iterations, which once took the cheap runs out of the search.
    report = tmp_path / "r.json"
    run = remesh(f"{samples}/bust.ply", tmp_path / "o.ply", "--max-error", 0.005, "--report", report, "--quiet")
    assert run.returncode == 0, run.stderr
    data = json.loads(report.read_text())
    assert data["target"]["met"] is True and data["result"]["hausdorff"] <= 0.005
    given = remesh(f"{samples}/bust.ply", tmp_path / "p.ply", "--max-error", 0.005, "--global-iterations", 14, "--quiet")
    assert given.returncode == 0 and (tmp_path / "p.ply").read_bytes() == (tmp_path / "o.ply").read_bytes()


def test_dropped_creases_are_told(remesh, samples, tmp_path):
    run = remesh(f"{samples}/bust.ply", tmp_path / "o.ply", "-n", 1000, "--global-iterations", 0)
    assert run.returncode == 0 and "edges that turn by more than 40 degrees were taken for roughness" in run.stdout
    run = remesh(f"{samples}/cad_part.ply", tmp_path / "o.ply", "-n", 1000, "--global-iterations", 0)
    assert run.returncode == 0 and "taken for roughness" not in run.stdout


def test_creases_of_a_thin_plate_are_kept(remesh, tmp_path):
    points, faces = plyfile.box()
    plate = plyfile.write_ply(str(tmp_path / "in.ply"), [(x, y, 0.03 * z) for x, y, z in points], faces)
    report = tmp_path / "r.json"
    assert remesh(plate, tmp_path / "o.ply", "-n", 1000, "--report", report, *FAST).returncode == 0
    features = json.loads(report.read_text())["features"]
    assert features == {"curves": 12, "corners": 8, "pruned": 0}


def test_max_error_is_kept(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    run = remesh(f"{samples}/bumpy.ply", tmp_path / "o.ply", "--max-error", 0.005, "--report", report,
                 "--global-iterations", 8)
    assert run.returncode == 0 and "largest error: asked 0.005, reached" in run.stdout
    data = json.loads(report.read_text())
    assert data["target"]["kind"] == "max_error" and 1 < data["target"]["runs"] <= 8
    assert 0.002 < data["target"]["reached"] <= 0.005
    assert data["result"]["hausdorff"] <= 0.005
    assert len(data["energy"]) == 9


def test_max_error_out_of_reach(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "--max-error", 1e-9, "--report", report,
                 "--global-iterations", 0, "--quiet")
    assert run.returncode == 7 and "came within" in run.stderr
    assert not (tmp_path / "o.ply").exists()
    assert json.loads(report.read_text())["status"] == 7


def test_narrow_parts_are_told(remesh, samples, tmp_path):
    points, faces = plyfile.box()
    thin = plyfile.write_ply(str(tmp_path / "thin.ply"), [(x, y, 0.03 * z) for x, y, z in points], faces)
    report = tmp_path / "r.json"

    def run(source, n):
        text = remesh(source, tmp_path / "o.ply", "-n", n, "--report", report, "--global-iterations", 1).stdout
        narrow = json.loads(report.read_text())["narrow"]
        assert narrow["count"] == len(narrow["places"])
        for place in narrow["places"]:
            assert place["width"] < 0.7 * place["spacing"] and place["vertices"] > n and len(place["position"]) == 3
        return text, {place["kind"] for place in narrow["places"]}
    text, kinds = run(thin, 300)
    # The plate between its faces, and its walls between their creases.
    assert kinds == {"thin_part", "close_features"}
    assert "the surface is thinner than the spacing allows at 1 place" in text
    # The walls beside the holes.
    text, kinds = run(f"{samples}/cad_part.ply", 90)
    assert kinds == {"close_features"} and "features are closer together than the spacing allows at" in text
    text, kinds = run(f"{samples}/cad_part.ply", 1000)
    assert not kinds and "spacing allows" not in text


def test_every_small_angle_has_a_reason(remesh, samples, tmp_path):
    report = tmp_path / "r.json"
    run = remesh(f"{samples}/bust.ply", tmp_path / "o.ply", "-n", 3000, "--report", report, "--global-iterations", 5,
                 "--feature-angle", 180)
    assert run.returncode == 0
    data = json.loads(report.read_text())
    angles = data["smallest_angle"]
    assert angles["target"] == 40 and angles["reached"] == pytest.approx(data["result"]["angle_min"], abs=1e-6)
    assert set(angles["reasons"]) == {"input_corner", "close_features", "thin_part", "few_vertices", "unexplained"}
    assert angles["below"] == sum(angles["reasons"].values()) == len(angles["triangles"]) > 0
    assert f"triangles below 40 deg: {angles['below']} (" in run.stdout
    # The boundary of the neck is jagged.
    assert angles["reasons"]["close_features"] > 0
    for triangle in angles["triangles"]:
        assert 0 <= triangle["face"] < data["result"]["faces"] and triangle["angle"] < 40
        assert len(triangle["position"]) == 3 and triangle["reason"] in angles["reasons"]
    assert remesh(f"{samples}/bust.ply", tmp_path / "o.ply", "-n", 3000, "--report", report, *FAST, "--feature-angle",
                  180, "--min-angle", 0).returncode == 0
    assert json.loads(report.read_text())["smallest_angle"]["below"] == 0


def test_same_bytes_twice_and_another_seed_differs(remesh, samples, tmp_path):
    def run(name, *extra, **options):
        assert remesh(f"{samples}/bumpy.ply", tmp_path / name, "-n", 700, *FAST, *extra, **options).returncode == 0
        return (tmp_path / name).read_bytes()
    first = run("a.ply")
    assert run("b.ply", cwd="/", env={**os.environ, "LC_ALL": "de_DE.UTF-8"}) == first
    assert run("c.ply", "--seed", 2) != first
    for threads in (1, 2, 4):
        assert run("d.ply", "--threads", threads) == first


@pytest.mark.parametrize("model", ["bumpy", "cad_part", "sphere"])
@pytest.mark.parametrize("density", ["uniform", "curvature"])
def test_same_bytes_with_another_mathematics_library(remesh, samples, tmp_path, model, density):
    """The C library has variants of its sines for processors with and without fused products."""
    def run(name, tunables):
        assert remesh(f"{samples}/{model}.ply", tmp_path / name, "-n", 700, "--density", density, *FAST,
                      env={**os.environ, "GLIBC_TUNABLES": tunables}).returncode == 0
        return (tmp_path / name).read_bytes()
    assert run("a.ply", "") == run("b.ply", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX")


def test_more_approximation_comes_closer(remesh, samples, tmp_path):
    def rms(weight):
        report = tmp_path / "report.json"
        assert remesh(f"{samples}/bust.ply", tmp_path / "out.ply", "-n", 3000, *FAST, "--approximation", weight,
                      "--report", report).returncode == 0
        data = json.loads(report.read_text())
        assert data["parameters"]["approximation"] == weight
        return data["result"]["rms"]
    assert rms(0) >= rms(0.5) > 1.1 * rms(1)


@pytest.mark.parametrize("extension", ["ply", "off", "obj", "stl", "PLY"])
def test_formats_there_and_back(remesh, tmp_path, extension):
    points, faces = plyfile.box()
    write = {"ply": plyfile.write_ply, "off": plyfile.write_off, "obj": plyfile.write_obj, "stl": plyfile.write_stl}
    source = write[extension.lower()](str(tmp_path / f"in.{extension}"), points, faces)
    middle, back = tmp_path / f"out.{extension}", tmp_path / "back.ply"
    assert remesh(source, middle, "-n", 200, *FAST).returncode == 0
    assert remesh(middle, back, "-n", 150, "--report", tmp_path / "r.json", *FAST).returncode == 0
    data = json.loads((tmp_path / "r.json").read_text())
    assert data["input"]["vertices"] == 200 and data["result"]["euler"] == 2


def test_obj_keeps_every_digit(remesh, tmp_path):
    # A sphere of radius 1e-9, away from the origin: PLY and OBJ read back as the same numbers.
    source = plyfile.write_ply(str(tmp_path / "in.ply"), *plyfile.box())
    assert remesh(source, tmp_path / "u.obj", "-n", 100, *FAST).returncode == 0
    lines = [line.split() for line in (tmp_path / "u.obj").read_text().splitlines()]
    points = [[1e-9 * float(x) + 1e-8 for x in line[1:]] for line in lines if line[0] == "v"]
    faces = [[int(x) - 1 for x in line[1:]] for line in lines if line[0] == "f"]
    assert "part" not in (tmp_path / "u.obj").read_text(), "the name of the temporary file"
    tiny = plyfile.write_obj(str(tmp_path / "tiny.obj"), points, faces)
    for name in ("t.obj", "t.off", "t.ply"):
        assert remesh(tiny, tmp_path / name, "-n", 80, *FAST).returncode == 0
    binary = (tmp_path / "t.ply").read_bytes()
    body = binary[binary.index(b"end_header\n") + 11:]
    exact = [x for v in range(80) for x in struct.unpack_from("<3d", body, 24 * v)]
    read = [float(x) for line in open(tmp_path / "t.obj", encoding="ascii") if line[0] == "v" for x in line.split()[1:]]
    assert read == exact and max(exact) - min(exact) > 1e-10


def test_stl_that_would_spoil_the_mesh_is_refused(remesh, tmp_path):
    points, faces = plyfile.box()
    far = plyfile.write_obj(str(tmp_path / "far.obj"), [[x + 1e7 for x in p] for p in points], faces)
    run = remesh(far, tmp_path / "o.stl", "-n", 200, *FAST)
    assert run.returncode == 5 and "single precision" in run.stderr
    assert not (tmp_path / "o.stl").exists()
    assert remesh(far, tmp_path / "o.obj", "-n", 200, *FAST).returncode == 0
    near = plyfile.write_obj(str(tmp_path / "near.obj"), [[x + 10 for x in p] for p in points], faces)
    assert remesh(near, tmp_path / "o.stl", "-n", 200, *FAST).returncode == 0


def test_output_through_a_symbolic_link(remesh, samples, tmp_path):
    (tmp_path / "sub").mkdir()
    for link, target in (("there.ply", "sub/there.ply"), ("new.ply", "sub/new.ply"), ("twice.ply", "there.ply")):
        (tmp_path / link).symlink_to(target)
    (tmp_path / "sub" / "there.ply").write_text("old")
    for link in ("there.ply", "new.ply", "twice.ply"):
        assert remesh(f"{samples}/sphere.ply", tmp_path / link, "-n", 100, *FAST).returncode == 0
        assert (tmp_path / link).is_symlink() and plyfile.count_ply(tmp_path / link)[0] == 100
    assert sorted(p.name for p in (tmp_path / "sub").iterdir()) == ["new.ply", "there.ply"]


def test_report_to_a_device(remesh, samples, tmp_path):
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 100, "--report", "/dev/stdout", *FAST)
    assert run.returncode == 0 and json.loads(run.stdout)["status"] == 0


def test_report_in_place_of_a_mesh_is_wrong_usage(remesh, samples, tmp_path):
    source = tmp_path / "in.ply"
    shutil.copy(f"{samples}/sphere.ply", source)
    (tmp_path / "link.ply").symlink_to("in.ply")
    (tmp_path / "sub").mkdir()
    before = source.read_bytes()
    for report, told in ((source, "the input"), (tmp_path / "link.ply", "the input"), (tmp_path / "o.ply", "the output"),
                         (tmp_path / "sub" / ".." / "o.ply", "the output")):
        run = remesh(source, tmp_path / "o.ply", "-n", 100, "--report", report, *FAST)
        assert run.returncode == 2 and told in run.stderr, run.stderr
    run = remesh("in.ply", "o.ply", "-n", 100, "--report", tmp_path / "o.ply", *FAST, cwd=tmp_path)
    assert run.returncode == 2
    assert source.read_bytes() == before and not (tmp_path / "o.ply").exists()


def test_options_change_the_result(remesh, samples, tmp_path):
    def result(*extra):
        run = remesh(f"{samples}/bumpy.ply", tmp_path / "o.ply", "-n", 500, *FAST, *extra)
        assert run.returncode == 0, run.stderr
        return (tmp_path / "o.ply").read_bytes()
    seen = {result()}
    for extra in (("--lambda", "0.05"), ("--local-iterations", "1"), ("--density", "curvature"),
                  ("--density", "curvature", "--density-exponent", "1")):
        seen.add(result(*extra))
    for extra in (("--sampler", "random"), ("--optimizer", "annealing"),
                  ("--optimizer", "annealing", "--sampler", "random")):
        seen.add(result(*extra))
    assert len(seen) == 8
    assert result("--optimizer", "accelerated", "--sampler", "front", "--density", "uniform") in seen


def test_density_from_vertex_quality(remesh, tmp_path):
    points, faces = plyfile.grid(30)
    source = plyfile.write_ply(str(tmp_path / "q.ply"), points, faces, [1 + 9 * (p[0] > 0.5) for p in points])
    assert remesh(source, tmp_path / "o.obj", "-n", 1500, "--density", "quality", *FAST).returncode == 0
    xs = [float(line.split()[1]) for line in open(tmp_path / "o.obj", encoding="ascii") if line.startswith("v ")]
    assert sum(x > 0.55 for x in xs) > 4 * sum(x < 0.45 for x in xs)
    plain = plyfile.write_ply(str(tmp_path / "p.ply"), points, faces)
    run = remesh(plain, tmp_path / "o2.ply", "-n", 100, "--density", "quality", *FAST)
    assert run.returncode == 4 and "density" in run.stderr
    bad = plyfile.write_ply(str(tmp_path / "b.ply"), points, faces, [-1.0] * 5 + [1.0] * (len(points) - 5))
    run = remesh(bad, tmp_path / "o3.ply", "-n", 100, "--density", "quality", *FAST)
    assert run.returncode == 4 and "5 vertices" in run.stderr


@pytest.mark.parametrize("args", [
    (), ("-n", "0"), ("-n", "1"), ("-n", "3"), ("-n", "-5"), ("-n", "many"), ("-n", "1e3"), ("-n", "99999999999"),
    ("-n", "100", "--feature-angle", "0"), ("-n", "100", "--feature-angle", "181"), ("-n", "100", "--lambda", "2"),
    ("-n", "100", "--density", "red"), ("-n", "100", "--optimizer", "magic"), ("-n", "100", "--sampler", "x"),
    ("-n", "100", "--global-iterations", "-1"), ("-n", "100", "--local-iterations", "0"), ("-n", "100", "--seed", "-1"),
    ("--edge-length", "0"), ("--edge-length", "-1"), ("--edge-length", "nan"),
    ("--max-error", "0"), ("--max-error", "2"), ("--max-error", "nan"), ("-n", "100", "--edge-length", "0.1"),
    ("-n", "100", "--max-error", "0.1"), ("--edge-length", "0.1", "--max-error", "0.1"),
    ("-n", "100", "--no-such-option")])
def test_wrong_usage(remesh, samples, tmp_path, args):
    run = remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", *args)
    assert run.returncode == 2
    assert run.stderr + run.stdout
    assert not list(tmp_path.iterdir())


def test_unknown_output_format_is_wrong_usage(remesh, samples, tmp_path):
    assert remesh(f"{samples}/sphere.ply", tmp_path / "o.xyz", "-n", 100).returncode == 2


def test_output_that_cannot_be_written(remesh, samples, tmp_path):
    run = remesh(f"{samples}/sphere.ply", tmp_path / "no" / "such" / "o.ply", "-n", 100, *FAST)
    assert run.returncode == 5 and run.stderr
    (tmp_path / "o.ply").mkdir()
    assert remesh(f"{samples}/sphere.ply", tmp_path / "o.ply", "-n", 100, *FAST).returncode == 5
    assert [p.name for p in tmp_path.iterdir()] == ["o.ply"]


def test_what_cannot_be_written_is_told_at_once(remesh, samples, tmp_path):
    # Long before these runs would end.
    many = (f"{samples}/bumpy.ply", tmp_path / "o.ply", "-n", 100000, "--global-iterations", 1000000)
    run = remesh(*many, "--report", tmp_path / "no" / "r.json")
    assert run.returncode == 5 and "r.json: its folder does not exist" in run.stderr
    (tmp_path / "o.ply").mkdir()
    run = remesh(*many, "--report", tmp_path / "r.json")
    assert run.returncode == 5 and "o.ply: it is a folder" in run.stderr
    assert json.loads((tmp_path / "r.json").read_text())["status"] == 5


def test_no_space_left(remesh, samples, tiny_file_system):
    run = remesh(f"{samples}/sphere.ply", tiny_file_system / "o.ply", "-n", 3000, *FAST)
    assert run.returncode == 5
    assert not list(tiny_file_system.iterdir())


def test_existing_output_survives_a_failure(remesh, tmp_path):
    out = tmp_path / "o.ply"
    out.write_text("precious")
    assert remesh(tmp_path / "missing.ply", out, "-n", 100, *FAST).returncode == 3
    assert out.read_text() == "precious"


def test_interrupt_writes_nothing(samples, tmp_path):
    out = tmp_path / "o.ply"
    process = subprocess.Popen([os.environ["CCDM_REMESH"], f"{samples}/bumpy.ply", out, "-n", "30000",
                                "--global-iterations", "100000", "--quiet"])
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 130
    assert not list(tmp_path.iterdir())


def test_figures_agree_with_the_independent_program(remesh, measure, samples, tmp_path):
    for name, angle in (("cad_part", 40), ("klein_bottle", 180), ("plate", 60), ("bust", 180)):
        out, report = tmp_path / "o.ply", tmp_path / "r.json"
        source = f"{samples}/{name}.ply"
        assert remesh(source, out, "-n", 2000, "--feature-angle", angle, "--report", report, *FAST).returncode == 0
        ours = json.loads(report.read_text())["result"]
        theirs = json.loads(subprocess.run([measure, source, out, "--samples", "200000"], capture_output=True, text=True,
                                           check=True).stdout)
        for key in ("euler", "components", "boundary_loops", "genus", "orientable"):
            assert ours[key] == theirs[key], (name, key)
        for key in ("angle_min_avg", "angle_min", "pct_lt30", "q_fb99_avg", "q_fb99_min", "pct_valence6"):
            assert ours[key] == pytest.approx(theirs[key], rel=1e-6, abs=1e-9), (name, key)
        assert ours["hausdorff"] == pytest.approx(theirs["hausdorff"], rel=0.12), name
        assert ours["rms"] == pytest.approx(theirs["rms"], rel=0.03), name
        assert theirs["topology_kept"]


def test_real_models_keep_topology_and_count(remesh, measure, tmp_path):
    meshes = os.path.join(os.environ.get("CCDM_SHARED", ""), "meshes")
    if not os.path.isdir(meshes):
        pytest.skip("the real models are not at hand")
    for name, n in (("joint", 3000), ("twist", 2500), ("pig", 3000), ("klein_bottle", 2500), ("moai", 3000),
                    ("bunny_scan", 4000), ("julius_noisy", 5000)):
        out = tmp_path / "o.ply"
        run = remesh(f"{meshes}/{name}.ply", out, "-n", n, "--feature-angle", 60 if name in ("joint", "twist") else 180,
                     "--global-iterations", 10, "--quiet")
        assert run.returncode == 0, run.stderr
        got = json.loads(subprocess.run([measure, f"{meshes}/{name}.ply", out, "--samples", "20000"], capture_output=True,
                                        text=True, check=True).stdout)
        assert got["nv"] == n and got["topology_kept"], name
        assert got["angle_min_avg"] > 49.5, name
