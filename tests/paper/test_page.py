# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the paper's tables and figures, from a short run on the sample meshes."""
import csv
import json
import os
import re
import subprocess
import sys

import pytest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "bench"), os.path.join(os.path.dirname(HERE), "support")]
sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(HERE)), "sample_meshes"))
from meshfile import read_ply
from surface import aspect_ratios, corner_angles
from tables import file_name

PICTURES = ["figure_3d", "figure_4c", "figure_4d", "figures_3_4", *(f"figure_{k}" for k in range(5, 11))]
# Column of the page: the name in printed.csv and in the data, and the factor between the data and the page.
COLUMNS = {"∠ avg": ("angle_min_avg", "angle_min_avg", 1), "∠ min": ("angle_min", "angle_min", 1),
           "< 30° %": ("pct_lt30", "pct_lt30", 1), "aspect avg": ("q_fb99_avg", "q_fb99_avg", 1),
           "aspect min": ("q_fb99_min", "q_fb99_min", 1), "error 1e-3": ("error", "hausdorff", 1e3),
           "seconds": ("seconds", "cpu", 1)}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("paper")
    subprocess.run([sys.executable, os.path.join(HERE, "reproduce.py"), "--quick", "--out", out], check=True,
                   env={**os.environ, "CCDM_SHARED": str(out / "none")}, timeout=120, stdout=subprocess.DEVNULL)
    return out


@pytest.fixture(scope="module")
def page(folder):
    return (folder / "index.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def data(folder):
    return json.loads((folder / "paper.json").read_text(encoding="utf-8"))


def table_of(page, heading):
    """The rows of the first table under a heading, by column."""
    lines = page.split(f"\n## {heading}\n")[1].split("\n## ")[0].splitlines()
    rows = [[cell.strip() for cell in line.strip("| ").split(" | ")] for line in lines if line.startswith("|")]
    return [dict(zip(rows[0], row)) for row in rows[2:]]


def agrees(cell, value):
    """Whether a cell is a number rounded to the digits that it shows."""
    mantissa, _, exponent = cell.partition("e")
    digits = len(mantissa.partition(".")[2])
    return abs(float(cell) - value) <= 0.501 * 10.0 ** (int(exponent or 0) - digits)


def printed_rows():
    with open(os.path.join(HERE, "printed.csv"), encoding="utf-8", newline="") as text:
        return list(csv.DictReader(line for line in text if not line.startswith("#")))


def test_every_picture_is_there_and_shown(folder, page):
    shown = re.findall(r"!\[[^]]*\]\(([^)]+)\)", page)
    assert sorted(shown) == sorted(f"{name}.png" for name in PICTURES)
    for name in shown:
        picture = (folder / name).read_bytes()
        assert picture[:8] == b"\x89PNG\r\n\x1a\n" and len(picture) > 10000, name


def test_page_says_how_it_was_made(page, data):
    assert "`./run.sh paper --quick" in page and data["date"] in page and data["machine"]["cpu"] in page
    assert "The real models are not at hand" in page and "A short run" in page


@pytest.mark.parametrize("number", (1, 2))
def test_printed_rows(page, number):
    rows = [r for r in table_of(page, f"Table {number}") if "printed" in r["method"]]
    wanted = [r for r in printed_rows() if r["table"] == str(number)]
    assert len(rows) == len(wanted) > 4
    for row, want in zip(rows, wanted):
        assert row["model"] == want["model"]
        assert row["method"] == "*" + want["method"].replace("*", "\\*") + ", printed*"
        for column, (key, _, _) in COLUMNS.items():
            assert float(row[column]) == float(want[key]), (want["model"], column)


@pytest.mark.parametrize("number", (1, 2))
def test_measured_rows_are_those_of_the_data(page, data, number):
    rows = [r for r in table_of(page, f"Table {number}") if "printed" not in r["method"]]
    wanted = [r for r in data["tables"]["rows"] if r["table"] == number]
    assert len(rows) == len(wanted) >= 10
    for row, want in zip(rows, wanted):
        assert want["reason"] == "" and want["topology_kept"] and want["vertices"] == want["n"]
        assert row["model"] == f"{want['paper']}: {want['model']}" and row["method"] == want["peer"]
        assert row["vertices"] == f"{data['before'][want['model']]:,} – {want['vertices']:,}"
        for column, (_, key, factor) in COLUMNS.items():
            assert agrees(row[column], factor * want[key]), (row, column)


@pytest.mark.parametrize("number", (1, 2))
def test_csv_has_the_rows_of_the_page(folder, page, number):
    rows = table_of(page, f"Table {number}")
    with open(folder / f"table_{number}.csv", encoding="utf-8", newline="") as text:
        files = list(csv.DictReader(text))
    assert len(files) == len(rows)
    for row, line in zip(rows, files):
        assert all(agrees(row[column], float(line[key])) for column, (key, _, _) in COLUMNS.items())


def test_figures_are_those_of_the_meshes(folder, data):
    """Found from the files by the tests' own count."""
    rows = data["tables"]["rows"]
    assert len({file_name(row["paper"], row["model"], row["peer"]) for row in rows}) == len(rows)
    for row in rows:
        points, faces = read_ply(folder / "meshes" / file_name(row["paper"], row["model"], row["peer"]))
        assert len(points) == row["vertices"]
        least, aspect = corner_angles(points, faces).min(axis=1), aspect_ratios(points, faces)
        assert least.mean() == pytest.approx(row["angle_min_avg"], abs=1e-6)
        assert least.min() == pytest.approx(row["angle_min"], abs=1e-6)
        assert aspect.mean() == pytest.approx(row["q_fb99_avg"], abs=1e-6)
        assert aspect.min() == pytest.approx(row["q_fb99_min"], abs=1e-6)


def test_curves(folder, page, data):
    curves = data["curves"]
    assert len(curves["local"]["mean"]) == curves["local_iterations"] + 1
    for kind in ("lambda", "NL"):
        assert len(curves[kind]) >= 3
        assert all(len(c["mean"]) == curves["global_iterations"] + 1 for c in curves[kind].values())
    # One and the same setting in both figures, and a gain by either optimisation.
    assert curves["lambda"]["0.2"] == curves["NL"][str(curves["many"])]
    assert curves["local"]["mean"][5] > curves["local"]["mean"][0] + 5
    assert curves["lambda"]["0.2"]["mean"][-1] > curves["lambda"]["0.2"]["mean"][0]
    rows = table_of(page, "Figures 3 and 4")
    assert [r["figure"] for r in rows] == ["3", "3(d)", "4", "4(c)", "4(d)"]
    assert f"{curves['local']['mean'][5]:.2f}° after 5" in rows[1]["here"]
    with open(folder / "curves.csv", encoding="utf-8", newline="") as text:
        lines = list(csv.DictReader(text))
    last = [float(r["mean_smallest_angle"]) for r in lines if r["setting"] == "lambda = 0.2"][-1]
    assert last == curves["lambda"]["0.2"]["mean"][-1]


def test_curve_ends_at_the_mesh(folder, data):
    for stage, curve in (("local", data["curves"]["local"]), ("global", data["curves"]["lambda"]["0.2"])):
        points, faces = read_ply(folder / "meshes" / f"plank_{stage}.ply")
        end = corner_angles(points, faces).min(axis=1).mean()
        # The last round of the global optimisation is followed by a last local one.
        assert end == pytest.approx(curve["ends"][0], abs=1e-6 if stage == "local" else 0.5)

