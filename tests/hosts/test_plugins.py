# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin files of all hosts, and the page that maps the parameters' names."""
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as tree

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
from filter_parameters import declared, page_rows, readme_names  # noqa: E402

PLUGINS = os.environ["CCDM_PLUGINS"]
SCRIPTS = os.environ["CCDM_SCRIPTS"]
VERSIONS = ["2020.09", "2022.02", "2025.07"]


@pytest.fixture(params=VERSIONS)
def plugin(request):
    path = os.path.join(PLUGINS, request.param, "libfilter_ccdm.so")
    if not os.path.exists(path):
        if request.param == "2020.09":
            pytest.fail("the plugin for 2020.09 was not built")
        pytest.skip(f"the sources of MeshLab {request.param} are not at hand")
    return path


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_exports_nothing_but_the_plugin_entry_points(plugin):
    symbols = output_of("nm", "-D", "--defined-only", plugin)
    assert sorted(re.findall(r" [A-Za-z] (\S+)", symbols)) == ["qt_plugin_instance", "qt_plugin_query_metadata"]


def test_takes_no_weak_code_from_the_host(plugin):
    """What the plugin shares with the host by name are functions that the host defines once, no templates: an
    instantiation of the host's over its own types would not fit."""
    undefined = output_of("nm", "-DC", "--undefined-only", plugin)
    assert not re.findall(r"vcg::(?:tri|ccdm)::\S*", undefined)


def test_needs_no_library_that_a_wheel_lacks(plugin):
    dynamic = output_of("objdump", "-p", plugin)
    needed = set(re.findall(r"NEEDED\s+(\S+)", dynamic))
    system = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6", "ld-linux-x86-64.so.2", "libpthread.so.0",
              "libdl.so.2", "ld-linux-aarch64.so.1"}
    assert "libmeshlab-common.so" in needed and needed - system == {"libmeshlab-common.so"}
    assert not re.search(r"R(UN)?PATH", dynamic)
    flags = int(re.search(r"FLAGS_1\s+0x([0-9a-f]+)", dynamic)[1], 16)
    assert flags & 1, "bound when loaded, not in mid-run"
    assert flags & 8, "never unloaded"


def test_has_no_thread_local_data(plugin):
    """Where there is no memory for it, the C library ends the host when a thread first asks for it."""
    assert " TLS " not in output_of("readelf", "-lW", plugin)


def test_page_maps_every_parameter():
    rows = page_rows()
    assert [(row[3], row[1].strip("`"), row[0], row[6] == "yes") for row in rows] == declared()
    assert [row[2].strip("`") for row in rows] == [row[1].strip("`").replace("lambda", "lambda_") for row in rows]


def test_readme_names_every_parameter():
    assert sorted(readme_names()) == sorted(name for _, name, _, _ in declared())


@pytest.mark.parametrize("name", sorted(n for n in os.listdir(SCRIPTS) if n.endswith(".mlx")))
def test_page_and_scripts_agree(name):
    element = tree.parse(os.path.join(SCRIPTS, name)).getroot().findall("filter")[-1] # others may prepare
    rows = page_rows()
    assert [(p.get("name"), p.get("type")) for p in element] == [(row[1].strip("`"), row[3]) for row in rows]
    for p, row in zip(element, rows):
        if p.get("type") == "RichEnum":
            words = [p.get(f"enum_val{k}") for k in range(int(p.get("enum_cardinality")))]
            assert ", ".join(f"'{w}'" for w in words) == row[4]
