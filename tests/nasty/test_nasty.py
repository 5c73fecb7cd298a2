# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever comes in, a proven mesh or a clear refusal comes out. What is proven is found here from the written file."""
import os

import numpy as np
import pytest

import surface
from nasty_meshes import CASES
from outcome import DONE, REFUSED, Outcome
from surface import Surface

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "README.md")


def parameters():
    for case in CASES:
        marks = [pytest.mark.xfail(strict=True, reason=case.fails)] if case.fails else []
        yield pytest.param(case, id=case.name, marks=marks)


@pytest.mark.parametrize("case", parameters())
def test_input(case, tmp_path):
    outcome = Outcome(case, tmp_path)
    files = {p.name for p in tmp_path.iterdir()}
    if case.refused:
        assert outcome.status == REFUSED, outcome.error
        assert case.refused in outcome.reason
        assert case.refused in outcome.report["message"]
        assert files == {f"{case.name}.{case.form}", "report.json"}
        return
    assert outcome.status == DONE, outcome.error
    assert files == {f"{case.name}.{case.form}", "report.json", "result.ply"}
    for note in case.notes:
        assert any(note in warning for warning in outcome.report["warnings"]), outcome.report["warnings"]
    check_topology(case, outcome)
    check_report(case, outcome)
    check_places(case, outcome)


def check_topology(case, outcome):
    found = Surface(outcome.triangles, len(outcome.result))
    assert found.fault == ""
    assert found.topology == case.topology
    assert found.coherent == case.topology.orientable
    assert len(outcome.result) == case.vertices + outcome.report["result"]["extra_vertices"]
    told = outcome.report["result"]
    assert (told["euler"], told["components"], told["boundary_loops"], told["orientable"]) == found.topology
    assert (told["vertices"], told["faces"]) == (len(outcome.result), len(outcome.triangles))
    assert outcome.report["topology_preserved"]


def check_report(case, outcome):
    """Distances that can be, and no faces that cross where none can."""
    told = outcome.report["result"]
    assert 0 <= told["hausdorff"] <= 1 and told["rms"] <= told["hausdorff"]
    if case.simple:
        assert (outcome.report["input"]["self_intersections"], told["self_intersections"]) == (0, 0)


def check_places(case, outcome):
    """In the unit of the input's diagonal: where the vertices lie, the angles, that no part of the input is missing."""
    faces = [f for f in outcome.faces if len(set(f)) == len(f)]
    there = outcome.points[sorted({v for f in faces for v in f})]
    low, high = there.min(axis=0), there.max(axis=0)
    unit = (high - low).max()
    unit *= np.linalg.norm((high - low) / unit)
    result = (outcome.result - low) / unit
    assert np.isfinite(outcome.result).all()
    assert (result >= -1e-6).all() and (result <= (high - low) / unit + 1e-6).all()
    for corner in case.corners:
        assert np.linalg.norm(result - (corner - low) / unit, axis=1).min() < 1e-6, corner
    if case.volume:
        assert surface.volume(result, outcome.triangles) * unit ** 3 == pytest.approx(case.volume, rel=case.tolerance)
    told, angles = outcome.report["result"], surface.corner_angles(result, outcome.triangles).min(axis=1)
    assert told["angle_min"] == pytest.approx(angles.min(), abs=1e-3)
    assert told["angle_min_avg"] == pytest.approx(angles.mean(), abs=1e-3)
    area = surface.area((outcome.points - low) / unit, faces)
    assert surface.area(result, outcome.triangles) > 0.3 * area  # a tetrahedron in a sphere has 0.37 of its area
    spacing = (2 * area / (3 ** 0.5 * len(result))) ** 0.5
    places = (there[::max(1, len(there) // 60)] - low) / unit
    assert surface.farthest(places, result, outcome.triangles) <= 1.5 * spacing


def test_page_lists_every_input():
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    assert [case.name for case in CASES if f"| `{case.name}` |" not in page] == []


def test_names_are_unique():
    assert len({case.name for case in CASES}) == len(CASES)
