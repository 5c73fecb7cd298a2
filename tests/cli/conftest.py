# SPDX-License-Identifier: GPL-3.0-or-later
import os
import subprocess
import sys

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))

SHARED = os.environ.get("CCDM_SHARED", "")


@pytest.fixture
def remesh():
    """Runs ccdm_remesh; bounded in time, so that a hang is a failure."""
    def run(*args, **options):
        return subprocess.run([os.environ["CCDM_REMESH"], *map(str, args)], capture_output=True, text=True, timeout=120,
                              check=False, **options)
    return run


@pytest.fixture(scope="session")
def samples():
    return os.environ["CCDM_SAMPLES"]


@pytest.fixture(scope="session")
def measure(tmp_path_factory):
    """The independent metrics program, compiled."""
    source = os.path.join(SHARED, "tools", "measure", "measure.cpp")
    if not os.path.exists(source):
        pytest.skip("the independent metrics program is not at hand")
    program = str(tmp_path_factory.mktemp("measure") / "measure")
    subprocess.run(["g++", "-std=c++17", "-O2", "-DNDEBUG", "-DNO_CGAL", source, "-o", program, "-pthread"], check=True)
    return program


@pytest.fixture
def tiny_file_system(tmp_path):
    """A folder with room for 16 kilobytes."""
    if os.geteuid() != 0:
        pytest.skip("a file system of a few kilobytes needs root")
    folder = tmp_path / "full"
    folder.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", folder], check=False,
                      capture_output=True).returncode != 0:
        pytest.skip("no file system can be mounted here")
    yield folder
    subprocess.run(["umount", folder], check=True)
