# SPDX-License-Identifier: GPL-3.0-or-later
"""What is installed here comes from a build that is done: nothing of the project is compiled by these tests."""
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
os.umask(0o022)
VERSION = re.search(r"^project\(\w+ VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]


def call(*command, expect=0, **options):
    """Runs a command within a minute, or two; gives back all that it printed."""
    run = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                         timeout=120, check=False, **options)
    assert expect is None or run.returncode == expect, f"{command}: {run.returncode}\n{run.stdout[-3000:]}"
    return run.stdout


def files_in(folder):
    """All files below a folder, as paths relative to it."""
    return sorted(str(p.relative_to(folder)) for p in Path(folder).rglob("*") if p.is_file())


@pytest.fixture(scope="session")
def build():
    return Path(os.environ["CCDM_BUILD"])


@pytest.fixture(scope="session")
def multiarch():
    return call("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()


@pytest.fixture(scope="session")
def has_plugin(build):
    if not (build / "plugins" / "2020.09" / "libfilter_ccdm.so").exists():
        pytest.skip("the build has no plugin for MeshLab 2020.09")


@pytest.fixture(scope="session")
def installed(build, tmp_path_factory):
    """A prefix of its own for a component."""
    def install(component):
        prefix = tmp_path_factory.mktemp(component)
        call("cmake", "--install", build, "--component", component, "--prefix", prefix)
        return prefix
    return install


@pytest.fixture(scope="session")
def packages(build, tmp_path_factory):
    """{name: path} of the Debian packages, made from what is built."""
    folder = tmp_path_factory.mktemp("packages")
    folder.chmod(0o755)
    folder.parent.chmod(0o755)
    call("cpack", "-G", "DEB", "--config", build / "CPackConfig.cmake", "-B", folder,
         "-D", f"CPACK_OUTPUT_FILE_PREFIX={folder}")
    return {p.name.split("_")[0]: p for p in folder.glob("*.deb")}
