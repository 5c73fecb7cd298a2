# SPDX-License-Identifier: GPL-3.0-or-later
"""Links lead somewhere, figures name what made them, lists are complete."""
import os
import re
import subprocess

import pages
import peers_in_readme
import pytest
from conftest import ROOT

FOLDERS = ("filter_ccdm", "python", "sample_meshes", "tests", "vcg_ext")
PAGES = sorted([*ROOT.glob("*.md"), *(page for folder in FOLDERS for page in (ROOT / folder).rglob("*.md"))])
MEASURED = [ROOT / "tests" / "bench" / name
            for name in ("README.md", "ANGLES.md", "APPROXIMATION.md", *peers_in_readme.PAGES, "RULES.md")]


def verbs():
    """Those that run.sh takes."""
    cases = (ROOT / "run.sh").read_text(encoding="utf-8").split('\ncase "${1:-}" in\n')[1]
    return set(re.findall(r"^(\w+)\)", cases, re.M))


def anchors(page):
    heads = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}


def title(page):
    return str(page.relative_to(ROOT))


@pytest.mark.parametrize("page", PAGES, ids=title)
def test_links(page):
    for target in re.findall(r"\]\(([^)]+)\)", page.read_text(encoding="utf-8")):
        if "://" in target:
            continue
        path, _, anchor = target.partition("#")
        there = page.parent / path if path else page
        assert there.exists(), target
        assert not anchor or anchor in anchors(there), target


@pytest.mark.parametrize("page", PAGES, ids=title)
def test_named_files_and_verbs_exist(page):
    text = page.read_text(encoding="utf-8")
    for verb in re.findall(r"\./run\.sh ([a-z]\w*)", text):
        assert verb in verbs(), verb
    for name in re.findall(r"`((?:tests|vcg_ext|filter_ccdm|sample_meshes|python|cmake)/[\w/.]*)`", text):
        assert (ROOT / name).exists(), name
    sources = {p.name for top in ("vcg_ext", "filter_ccdm", "tests", "sample_meshes") for p in (ROOT / top).rglob("*")}
    for name in re.findall(r"`(\w+\.(?:h|cpp|py|mlx))`", text):
        assert name in sources or name == "import_obj.h", f"{name}, which is none of MeshLab's"


def test_script_tells_of_every_verb():
    usage = (ROOT / "run.sh").read_text(encoding="utf-8").split("<<'TEXT'")[1].split("\nTEXT\n")[0]
    assert set(re.findall(r"^  (\w+)(?: |$)", usage, re.M)) == verbs()


def test_pictures_name_the_command_that_made_them():
    parts = re.split(r"^!\[.*?\]\(.*?\)$", pages.README.read_text(encoding="utf-8"), flags=re.M)[1:]
    assert len(parts) > 2
    for part in parts:
        caption = part.strip().split("\n\n")[0]
        assert not caption or re.fullmatch(r"\*.*`\./run\.sh \w+`\.\*", caption, re.S), caption
    assert parts[-1].strip(), "the last of a row has the caption"


def test_tables_of_figures_name_the_command_that_made_them():
    """A table with three cells or more that are figures; what is set, not measured, is in the table of parameters."""
    text = pages.README.read_text(encoding="utf-8")
    for table in re.findall(r"(?:^\|.*\n)+", text, re.M):
        figures = re.findall(r"\| (?:[\d.]+ to [\d.]+|\d+ of \d+|[\d.]+)(?=[ ,])", table)
        if len(figures) > 2 and "| default |" not in table.splitlines()[0]:
            after = text.split(table)[1].lstrip().split("\n\n")[0]
            assert re.search(r"`\./run\.sh \w+[^`]*`,\s\d{4}-\d\d-\d\d", after), table


def test_other_remeshers_are_as_on_their_page():
    text = pages.README.read_text(encoding="utf-8")
    part = text.split(peers_in_readme.BEGIN)[1].split(peers_in_readme.END)[0]
    assert part.strip().splitlines() == peers_in_readme.lines(), \
        "tests/bench/peers_in_readme.py writes it anew"


def test_measured_pages_are_of_one_engine():
    """Else the same run would have other figures on another page."""
    text = "\n".join(page.read_text(encoding="utf-8") for page in MEASURED)
    stamps = re.findall(r"That\scommand\swrites\sthis\s(?:page|section)", text)
    named = re.findall(r",\sengine\s(\w{8})\.\sThat\scommand", text)
    assert len(named) == len(stamps) == 8 and len(set(named)) == 1, named


def test_every_script_is_listed():
    table = pages.table("\n| script |" + pages.section("Ways to use it").split("\n| script |")[1])
    assert {row[0].strip("`") for row in table[1:]} == {p.name for p in (ROOT / "filter_ccdm/scripts").glob("*.mlx")}


def test_exit_statuses_are_those_of_the_help():
    said = subprocess.run([os.environ["CCDM_REMESH"], "--help"], capture_output=True, text=True, check=True).stdout
    statuses = re.findall(r"\b(\d) \w+", said.split("Exit status:")[1])
    told = pages.section("Ways to use it").split("The exit status is")[1].split(" and 128")[0]
    assert len(statuses) > 5 and re.findall(r"\b(\d)\s(?:when|for)", told) == statuses
