# SPDX-License-Identifier: GPL-3.0-or-later
"""Every block of code in the README is run, each as it is written, and does what it is there for.

A block is known by its first words. One that is not known here makes a test fail.
"""
import ast
import re
import shutil
import subprocess

import pages
import plyfile
import pytest
from conftest import BUILD, ROOT, STAND_INS, VENV
from meshfile import read_ply
from surface import corner_angles


def vertices(path):
    return plyfile.count_ply(path)[0]


def demo(place, _):
    """The figures are those of the caption of the README's picture."""
    points, faces = read_ply(place.folder / "build/demo/cad_part_ccdm.ply")
    least = corner_angles(points, faces).min(axis=1)
    caption = re.sub(r"\s+", " ", pages.README.read_text(encoding="utf-8")).split("*Left: ")[1].split("*")[0]
    assert f"Right: {len(points)} vertices, average smallest angle {least.mean():.1f} degrees" in caption
    assert len(points) == 5000 and least.min() > 40 and "none under 40" in caption
    assert (place.folder / "build/demo/before_after.png").stat().st_size > 10000


def plugin_package(place, _):
    assert list(place.machine.glob("usr/lib/*/meshlab/plugins/libfilter_ccdm.so"))


def plugin_without_package(place, _):
    plugin_package(place, _)
    assert vertices(place.folder / "build" / "bust.ply") == 5000


def wheel(place, _):
    assert list(place.site.glob("ccdm_pymeshlab/plugins/2025.07/libfilter_ccdm.so"))


def command_line_package(place, printed):
    assert (place.machine / "usr/bin/ccdm_remesh").exists()
    assert "--feature-angle" in printed


def headers(place, printed):
    assert (place.folder.parent / "home/ccdm/share/ccdm/cmake/ccdm-config.cmake").exists()
    assert "Build files have been written to" in printed and "2000 vertices" in printed
    assert vertices(place.folder / "build/bust_2000.ply") == 2000


def command_line(place, printed):
    assert vertices(place.folder / "build" / "bust_4000.ply") == 4000 and "topology preserved" in printed
    assert (place.folder / "build" / "bust.json").exists()


def own_script(place, printed):
    assert vertices(place.folder / "build" / "part.ply") == 2000 and "topology preserved" in printed


def batch(place, _):
    for name in ("sphere", "high_genus"):
        before, after = (vertices(place.folder / folder / f"{name}.ply") for folder in ("scans", "remeshed"))
        assert after == pytest.approx(before / 2, abs=1)


# By the first words; of the blocks that start alike, in order.
SHELL = {
    "./run.sh demo": (demo,),
    "./run.sh package": (plugin_package, wheel, command_line_package),
    "./run.sh build": (plugin_without_package, headers),
    "build/bin/ccdm_remesh": (command_line,),
    "sed": (own_script,),
    "pip install": (batch,),
}
# Blocks that other tests run, straight from the page.
EXAMPLE = ROOT / "tests" / "install" / "example" / "remesh_a_box.cpp"
ELSEWHERE = {"cpp": "tests/install/test_components.py::test_example_is_built_and_runs",
             "text": "tests/window/test_readme.py::test_example_of_the_readme",
             "bibtex": "tests/readme/test_citation.py::test_bibtex_is_the_papers"}
ALL = pages.blocks()
NEEDS_VENV = {wheel, batch}


def of(language):
    return [b for b in ALL if b.language == language]


def checks():
    """(block, its check) of the shell's, and the checks that have no block."""
    left = {words: list(found) for words, found in SHELL.items()}
    pairs = []
    for block in of("sh"):
        line = pages.first_line(block) + " "
        found = [checks for words, checks in left.items() if checks and line.startswith(words + " ")]
        pairs.append((block, found[0].pop(0) if found else None))
    return pairs, left


def test_every_block_is_known():
    pairs, left = checks()
    unknown = [f"line {b.line}: {pages.first_line(b)}" for b, check in pairs if check is None]
    unknown += [f"line {b.line}: a block of {b.language or 'no language'}" for b in ALL
                if b.language not in ("sh", "python", *ELSEWHERE)]
    assert not unknown, "add what each is to do"
    assert not any(left.values()), "what is looked for is not in the README any more"
    assert [len(of(language)) for language in ("python", *ELSEWHERE)] == [1, 1, 1, 1]


@pytest.mark.parametrize("where", sorted({*ELSEWHERE.values(), *(test for _, test in STAND_INS.values())}))
def test_what_is_run_elsewhere_is(where):
    path, _, name = where.partition("::")
    text = (ROOT / path).read_text(encoding="utf-8")
    assert not name or re.search(rf"^def {name}\(", text, re.M)


@pytest.mark.parametrize("block, check", checks()[0], ids=lambda x: getattr(x, "__name__", None))
def test_shell(place, block, check):
    assert check is not None
    if check in NEEDS_VENV and not VENV.exists():
        pytest.skip("PyMeshLab is not installed")
    if check is batch:  # the reader's scans
        (place.folder / "scans").mkdir()
        for name in ("sphere", "high_genus"):
            shutil.copy(ROOT / "sample_meshes" / f"{name}.ply", place.folder / "scans")
    check(place, place.run(block.text))


def test_python(place):
    if not VENV.exists():
        pytest.skip("PyMeshLab is not installed")
    (block,) = of("python")
    ast.parse(block.text)
    printed = subprocess.run([VENV / "bin" / "python", "-c", block.text], cwd=place.folder, env=place.environment,
                             capture_output=True, text=True, timeout=120, check=True).stdout
    assert 54 < float(printed.split()[-1]) < 60, "the average smallest angle"


def test_cpp_is_part_of_the_program_that_is_built():
    """Line by line and in one piece, but for the #include."""
    (block,) = of("cpp")
    program = [line.strip() for line in EXAMPLE.read_text(encoding="utf-8").splitlines()]
    include, statements = block.text.split("\n\n")
    assert include in program
    assert "\n".join(line.strip() for line in statements.splitlines()) in "\n".join(program)


def test_results_stay_out_of_the_checkout(place):
    place.run("touch made; touch build/made")
    assert not (ROOT / "made").exists() and not (BUILD / "made").exists()
