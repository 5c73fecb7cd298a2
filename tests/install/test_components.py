# SPDX-License-Identifier: GPL-3.0-or-later
"""`cmake --install`, component by component, and a project that finds the library."""
import os
import re

import pytest
from conftest import ROOT, VERSION, call, files_in
from plyfile import count_ply

EXAMPLE = ROOT / "tests" / "install" / "example"


@pytest.fixture(scope="module")
def development(installed):
    return installed("development")


def test_plugin(installed, multiarch, has_plugin):
    assert files_in(installed("plugin")) == [f"lib/{multiarch}/meshlab/plugins/libfilter_ccdm.so",
                                             "share/doc/meshlab-filter-ccdm/copyright"]


def test_command_line(installed):
    prefix = installed("cli")
    assert files_in(prefix) == ["bin/ccdm_remesh", "share/doc/ccdm-remesh/copyright"]
    assert VERSION in call(prefix / "bin" / "ccdm_remesh", "--version")


def test_headers(development):
    headers = [f"include/{p}" for p in files_in(ROOT / "vcg_ext") if p.startswith("vcg/")]
    config = [f"share/ccdm/cmake/ccdm-{n}.cmake" for n in ("config", "config-version", "targets")]
    assert files_in(development) == sorted(headers + config)
    for name in config:
        text = (development / name).read_text()
        assert str(ROOT) not in text and str(development) not in text, "the prefix can be moved"


def test_everything_below_destdir(build, tmp_path, multiarch, has_plugin):
    """Without a prefix: where the installed MeshLab looks."""
    if not os.path.exists(f"/usr/lib/{multiarch}/meshlab/libmeshlab-common.so"):
        pytest.skip("Debian's MeshLab is not installed")
    prefix = re.search(r"^CMAKE_INSTALL_PREFIX:PATH=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)[1]
    if prefix != "/usr":
        pytest.skip(f"the build was set up for another prefix, {prefix}")
    call("cmake", "--install", build, env={**os.environ, "DESTDIR": str(tmp_path)})
    assert (tmp_path / f"usr/lib/{multiarch}/meshlab/plugins/libfilter_ccdm.so").exists()
    assert (tmp_path / "usr/bin/ccdm_remesh").exists()


def configure(folder, *options, expect=0):
    return call("cmake", "-S", EXAMPLE, "-B", folder, "-G", "Ninja", "-DCMAKE_CXX_FLAGS=-O0", *options, expect=expect)


def test_example_is_built_and_runs(development, tmp_path):
    configure(tmp_path, f"-DCMAKE_PREFIX_PATH={development}", f"-DVCGLIB_INCLUDE_DIR={os.environ['CCDM_VCGLIB']}")
    log = call("cmake", "--build", tmp_path, "-v")
    assert "-ffp-contract=off" in log, "as where the project itself uses the library: equal bits"
    assert call(tmp_path / "remesh_a_box") == "2000 vertices, 3996 triangles\n"
    call(tmp_path / "remesh_a_box", ROOT / "sample_meshes" / "sphere.ply", tmp_path / "sphere.ply")
    assert count_ply(tmp_path / "sphere.ply")[0] == 2000


def test_missing_vcglib_is_said(development, tmp_path):
    log = configure(tmp_path, f"-DCMAKE_PREFIX_PATH={development}", "-DVCGLIB_INCLUDE_DIR=VCGLIB_INCLUDE_DIR-NOTFOUND",
                    "-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF", expect=1)
    assert "set VCGLIB_INCLUDE_DIR to its folder" in " ".join(log.split())


def test_another_minor_version_is_refused(development, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.24)\nproject(p LANGUAGES CXX)\n"
                                             "find_package(ccdm 0.2 REQUIRED)\n")
    log = call("cmake", "-S", tmp_path, "-B", tmp_path / "b", f"-DCMAKE_PREFIX_PATH={development}", expect=1)
    assert f"version: {VERSION}" in log
