# SPDX-License-Identifier: GPL-3.0-or-later
"""CITATION.cff is one, and agrees with what the README and the build say."""
import re
import subprocess

import pages
import pytest
import yaml
from conftest import ROOT, VENV

CITATION = ROOT / "CITATION.cff"
# Of the format's version 1.2.0, what is needed here.
KEYS = {"cff-version", "message", "title", "type", "abstract", "authors", "version", "license", "keywords",
        "references", "date-released", "doi", "repository-code", "url", "contact", "identifiers", "preferred-citation"}


@pytest.fixture(scope="module")
def citation():
    return yaml.safe_load(CITATION.read_text(encoding="utf-8"))


def test_form(citation):
    assert {"cff-version", "message", "title", "authors"} <= set(citation) <= KEYS
    assert citation["cff-version"] == "1.2.0" and citation["type"] == "software"
    for entry in (citation, *citation["references"]):
        for author in entry["authors"]:
            assert set(author) in ({"name"}, {"family-names", "given-names"})
    for reference in citation["references"]:
        assert {"type", "title", "authors"} <= set(reference)
        assert isinstance(reference["year"], int)


def test_official_tool_is_content():
    """Where ./run.sh test has installed it."""
    tool = VENV / "bin" / "cffconvert"
    if not tool.exists():
        pytest.skip("cffconvert is not installed")
    subprocess.run([tool, "--validate", "-i", CITATION], check=True, timeout=60)


def test_software_is_that_of_the_build(citation):
    cmake = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert citation["version"] == re.search(r"^project\(\w+ VERSION (\S+)", cmake, re.M)[1]
    assert pages.README.read_text(encoding="utf-8").startswith(f"# {citation['title']}\n")
    assert citation["license"] in pages.section("Licence and citation")


def test_bibtex_is_the_papers(citation):
    (block,) = [b for b in pages.blocks() if b.language == "bibtex"]
    assert re.fullmatch(r"@article\{\w+,\n(  \w+ +=\s\{.*\},?\n)+\}\n", block.text)
    fields = dict(re.findall(r"^  (\w+) += \{(.*)\},?$", block.text, re.M))
    paper = citation["references"][0]
    authors = " and ".join(f"{a['family-names']}, {a['given-names']}" for a in paper["authors"])
    assert fields.pop("author") == authors
    assert fields.pop("title").replace("{", "").replace("}", "") == paper["title"]
    assert fields == {"journal": paper["journal"], "volume": str(paper["volume"]), "number": str(paper["issue"]),
                      "year": str(paper["year"])}
