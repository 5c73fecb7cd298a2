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
