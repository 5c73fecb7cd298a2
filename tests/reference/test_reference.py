# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of the public headers: all of it is documented, and what it says of the parameters is true."""
import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import pages  # noqa: E402

SAMPLE = ROOT / "sample_meshes" / "sphere.ply"
RELOCATIONS = {"CellCentroid": "cvt", "PatchCentroid": "cpt", "Circumcentres": "odt"}
FIELDS = re.compile(r"(?P<text>.*)Unit: (?P<unit>.+?)\. Range: (?P<range>.+?)\. Default: (?P<default>.+?)\. "
                    r"Source: (?P<source>.+)\.")


def generate(folder, *settings):
    doxyfile = (ROOT / "vcg_ext" / "Doxyfile").read_text(encoding="utf-8")
    lines = [doxyfile, f"OUTPUT_DIRECTORY = {folder}", *settings]
    return subprocess.run(["doxygen", "-"], input="\n".join(lines), cwd=ROOT / "vcg_ext", capture_output=True,
                          text=True, timeout=60, check=False)


@pytest.fixture(scope="module")
def xml(tmp_path_factory):
    """The compounds of the reference by their names."""
    folder = tmp_path_factory.mktemp("reference")
    run = generate(folder, "GENERATE_HTML = NO", "GENERATE_XML = YES")
    assert (run.returncode, run.stdout + run.stderr) == (0, "")
    compounds = [tree.parse(path).getroot().find("compounddef") for path in (folder / "xml").glob("*.xml")]
    return {c.findtext("compoundname"): c for c in compounds if c is not None}


def text_of(element):
    """All that is said of it, in one line."""
    parts = ["".join(element.find(k).itertext()) for k in ("briefdescription", "detaileddescription")]
    return " ".join(" ".join(parts).split())


def members(compound):
    return {m.findtext("name"): m for m in compound.iter("memberdef")}


@pytest.fixture(scope="module")
def params(xml):
    """{member of Params: what its documentation says, by field}."""
    found = {}
    for name, member in members(xml["vcg::ccdm::Params"]).items():
        fields = FIELDS.fullmatch(text_of(member))
        assert fields and fields["text"].strip(), f"{name} lacks text, unit, range, default or source"
        found[name] = {**fields.groupdict(), "initializer": (member.findtext("initializer") or "").strip(" =")}
    return found


def test_pages_are_made_without_a_warning(tmp_path):
    run = generate(tmp_path)
    assert (run.returncode, run.stdout + run.stderr) == (0, "")
    assert (tmp_path / "index.html").exists()


def test_what_users_see_is_there(xml):
    for name in ("vcg::tri::CCDMRemeshing", "vcg::ccdm::Params", "vcg::ccdm::Report", "vcg::ccdm::Provenance",
                 "vcg::tri::MeshQuality", "vcg::tri::MeshQualityReport"):
        assert text_of(xml[name]), name
    assert not any("Remesher" in name or "Finder" in name for name in xml), "the inside stays inside"


def test_each_member_and_each_value_is_documented(xml):
    """Doxygen itself says nothing of the values of an enumeration."""
    for name, compound in xml.items():
        if not name.startswith("vcg::") or compound.get("prot") == "private":
            continue
        for element in [*compound.iter("memberdef"), *compound.iter("enumvalue")]:
            if element.get("prot") == "public":
                assert text_of(element), f"{name}::{element.findtext('name')}"


def test_sources_are_headers_or_sections(params):
    headers = ROOT / "vcg_ext" / "vcg" / "complex" / "algorithms" / "ccdm"
    for name, said in params.items():
        named = re.findall(r"\w+\.h\b", said["source"])
        assert named or re.search(r"paper, sections? \d\.\d", said["source"]), name
        assert all((headers / header).exists() for header in named), name


def test_defaults_are_those_of_the_code(params):
    for name, said in params.items():
        stated, code = said["default"].split(",")[0].split(";")[0], said["initializer"].split("::")[-1]
        if code and stated != "not given":
            assert stated == code or float(stated) == float(code), name


# As users meet them.

def option_of(member):
    name = "vertices" if member == "vertexCount" else re.sub(r"([A-Z])", r"-\1", member).lower()
    return name if member not in ("useMarkedEdges", "selectedFacesOnly") else None


def plain(value):
    """A default as the command line writes it."""
    return RELOCATIONS.get(value, value.lower())


def defaults(said):
    """The default, and that with annealing."""
    main, _, annealing = said["default"].partition("; with annealing ")
    main = main.split(",")[0]
    return plain(main), plain(annealing or main)


def remesh(*arguments):
    command = [os.environ["CCDM_REMESH"], *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout


@pytest.mark.parametrize("optimizer", ["accelerated", "annealing"])
def test_defaults_are_those_of_a_run(params, tmp_path, optimizer):
    remesh(SAMPLE, tmp_path / "o.ply", "-n", 100, "--quiet", "--report", tmp_path / "r.json", "--optimizer", optimizer)
    used = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))["parameters"]
    compared = 0
    for name, said in params.items():
        key = (option_of(name) or "").replace("-", "_")
        if key not in used or key in ("vertices", "optimizer") or said["default"] == "not given":
            continue
        stated = defaults(said)[optimizer == "annealing"]
        assert stated == used[key] or float(stated) == used[key], name
        compared += 1
    assert compared == len(used) - 4


@pytest.fixture(scope="module")
def help_texts():
    """{option: what --help says of it, in one line}."""
    parts = re.split(r"^  (?:-\w,)?--([\w-]+)", remesh("--help"), flags=re.M)
    return {name: " ".join(text.split("\n\n")[0].split()) for name, text in zip(parts[1::2], parts[2::2])}


def in_words(limits):
    """A range as the command line writes it; None where it is no range of numbers."""
    found = re.match(r"([\[(])(.+), (.+)[\])]", limits)
    if found is None:
        return None
    opening, low, high = found.groups()
    if opening == "[":
        return f"from {low} to {high}"
    return f"above {low}" + (f" up to {high}" if high != "inf" else "")


def test_help_has_the_same_defaults_and_ranges(params, help_texts):
    for name, said in params.items():
        told = help_texts.get(option_of(name))
        if told is None or name == "threads":  # whose range ends in the command line only
            continue
        assert (in_words(said["range"]) or "") in told, (name, told)
        if said["default"] in ("not given", "0, not given"):
            continue
        main, annealing = defaults(said)
        if re.fullmatch(r"[\d.]+", main):
            assert f"(default: {main}" in told, (name, told)
            assert annealing == main or f"with annealing {annealing})" in told, (name, told)
        else:
            assert re.search(rf"{main}\b[^;]*\((the )?default|{main}, the default", told), (name, told)


def readme_rows():
    rows = pages.table(pages.section("Parameters"))[1:]
    return {row[0].strip("`-"): row for row in rows if row[0]}


def test_readme_has_the_same_defaults(params):
    rows = readme_rows()
    assert set(rows) == {option_of(name) for name in params} - {None}
    for name, said in params.items():
        if option_of(name) is None:
            continue
        _, _, default, meaning = rows[option_of(name)]
        if said["default"] in ("not given", "0, not given"):
            assert default == "", name
            continue
        main, annealing = defaults(said)
        assert default == ("all cores" if name == "threads" else main), name
        if annealing != main:
            assert re.search(rf"(?<![\d.]){re.escape(annealing)}(?![\d.])[^;)]*with annealing", meaning), name
