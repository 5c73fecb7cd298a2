# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's figures, computed again from the written file by other means, for every sample and model at hand."""
import glob
import json
import os
import subprocess

import numpy
import plyfile
import pytest
import surface

SAMPLES = sorted(glob.glob(os.path.join(os.environ.get("CCDM_SAMPLES", ""), "*.ply")))
MODELS = sorted(glob.glob(os.path.join(os.environ.get("CCDM_SHARED", ""), "meshes", "*.ply")))


SMALL = [path for path in MODELS if os.path.getsize(path) < 500000]


def near(value):
    return pytest.approx(value, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("path", SAMPLES + MODELS, ids=os.path.basename)
def test_report_tells_what_is_in_the_file(remesh, tmp_path, path):
    out, report = tmp_path / "o.ply", tmp_path / "r.json"
    run = remesh(path, out, "-n", 1500, "--global-iterations", 2, "--report", report)
    assert run.returncode == 0, run.stderr
    told = json.loads(report.read_text(encoding="utf-8"))
    content = plyfile.read_ply(out)
    points = numpy.array([(v["x"], v["y"], v["z"]) for v in content["vertex"]])
    faces = [tuple(f["vertex_indices"]) for f in content["face"]]
    found = surface.Surface(faces, len(points))
    assert not found.fault
    for side in ("input", "result"):
        assert tuple(told[side][key] for key in ("euler", "components", "boundary_loops", "orientable")) == found.topology
    assert (told["result"]["vertices"], told["result"]["faces"]) == (len(points), len(faces))
    assert told["topology_preserved"] and len(points) == 1500 + told["result"]["extra_vertices"]
    angles = surface.corner_angles(points, faces)
    smallest = angles.min(axis=1)
    assert told["result"]["angle_min_avg"] == near(smallest.mean())
    assert told["result"]["angle_min"] == near(smallest.min()) == near(told["smallest_angle"]["reached"])
    assert told["result"]["pct_lt30"] == near(100 * (angles < 30).mean())
    target = told["smallest_angle"]["target"]
    assert (smallest < target - 1e-6).sum() <= told["smallest_angle"]["below"] <= (smallest < target + 1e-6).sum()
    ratios = surface.aspect_ratios(points, faces)
    assert told["result"]["q_fb99_avg"] == near(ratios.mean()) and told["result"]["q_fb99_min"] == near(ratios.min())
    assert told["result"]["pct_valence6"] == near(found.percent_valence_6())


@pytest.mark.parametrize("path", SMALL, ids=os.path.basename)
def test_distances_are_those_of_another_program(remesh, measure, tmp_path, path):
    out, report = tmp_path / "o.ply", tmp_path / "r.json"
    assert remesh(path, out, "-n", 1500, "--global-iterations", 2, "--report", report).returncode == 0
    told = json.loads(report.read_text(encoding="utf-8"))["result"]
    run = subprocess.run([measure, path, out, "--samples", "1000000"], capture_output=True, text=True, check=True)
    found = json.loads(run.stdout)
    # The report's maximum is searched for; the other one is that of samples.
    assert found["hausdorff"] <= told["hausdorff"] * 1.001 and told["hausdorff"] <= found["hausdorff"] * 1.12
    assert told["rms"] == pytest.approx(found["rms"], rel=0.03)
