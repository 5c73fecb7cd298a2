# SPDX-License-Identifier: GPL-3.0-or-later
"""A place where the README's commands run as they are written, but for what would install or build.

The place looks like the checkout after a build: links to everything in it, `build` a folder of its own with links to
what is built, so that whatever a command writes stays there. In front of the machine's programs stand a few that take
the place of what changes the machine; STAND_INS says what each does, and which test does it in earnest.
"""
import functools
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests/support", "tests/bench", "sample_meshes")]
BUILD = Path(os.environ.get("CCDM_BUILD", ROOT / "build")).resolve()
VENV = BUILD / "venv-2025.07"

# name: (what runs instead, the test that runs the thing itself)
STAND_INS = {
    # For the rest of its line the machine's files are those below $MACHINE.
    "sudo": ('DESTDIR="$MACHINE" exec "$@"',
             "tests/install/test_debian.py::test_apt_installs_into_the_systems_meshlab"),
    # Unpacks packages below $MACHINE.
    "apt": ('test "$1" = install; shift; for package; do dpkg-deb --extract "$package" "$MACHINE"; done',
            "tests/install/test_debian.py::test_apt_installs_into_the_systems_meshlab"),
    # What pip makes of a pure wheel or a folder, without what they need; that lies in the build's environment.
    "pip": (f'exec /usr/bin/python3 "{ROOT}/tests/readme/unpack.py" "$@"',
            "tests/install/test_wheel.py::test_load_registers_the_filter"),
    "python3": (f'PYTHONPATH="$SITE" exec "{VENV}/bin/python" "$@"',
                "tests/install/test_wheel.py::test_load_registers_the_filter"),
    "ccdm-batch": (f'PYTHONPATH="$SITE" exec "{VENV}/bin/python" -m ccdm_batch "$@"',
                   "tests/batch/test_batch.py"),
    # The private host instead of the machine's, if the plugin has been put where the machine's looks for it.
    "meshlabserver": ('test -e "$MACHINE"/usr/lib/*/meshlab/plugins/libfilter_ccdm.so; '
                      f'exec "{BUILD}/host/bin/meshlabserver" "$@"',
                      "tests/install/test_debian.py::test_apt_installs_into_the_systems_meshlab"),
    "meshlab": ('test -e "$MACHINE"/usr/lib/*/meshlab/plugins/libfilter_ccdm.so; test -r "$1"',
                "tests/window/test_readme.py::test_example_of_the_readme"),
    # Into this place rather than into the build.
    "cpack": ('exec /usr/bin/cpack "$@" -B "$PWD" -D CPACK_OUTPUT_FILE_PREFIX="$PWD/packages"',
              "tests/install/test_debian.py::test_plugin_package"),
}

# In run.sh, which is otherwise as it is: the build is there, and the tests are what is running.
STAND_IN_STEPS = """
install_packages() { :; }
build() { test -x build/bin/ccdm_remesh; }
run_tests() { build; }
if [ "${1:-}" = package ] && ls "$PACKED"/*.deb >/dev/null 2>&1; then
    ln -s "$PACKED" build/packages
    exit 0
fi
"""


def script(path, text):
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


@pytest.fixture(scope="session")
def stand_ins(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stand_ins")
    for name, (command, _) in STAND_INS.items():
        script(folder / name, f"#!/bin/sh\nset -e\n{command}\n")
    return folder


class Place:
    """To run commands in; what they leave behind is below `folder`, what they install below `machine`."""

    def __init__(self, folder, stand_ins, packed):
        self.folder, self.machine, self.site = folder / "checkout", folder / "machine", folder / "site"
        for path in (self.folder / "build", self.machine, self.site, folder / "home"):
            path.mkdir(parents=True)
        links = [p for p in ROOT.iterdir() if p.name not in ("build", ".git", "run.sh")]
        for path in links:
            (self.folder / path.name).symlink_to(path)
        for path in BUILD.iterdir():
            if path.name not in ("packages", "demo", "example", "reference"):
                (self.folder / "build" / path.name).symlink_to(path)
        steps, verbs = (ROOT / "run.sh").read_text(encoding="utf-8").split('\ncase "${1:-}" in\n')
        script(self.folder / "run.sh", f'{steps}\n{STAND_IN_STEPS}\ncase "${{1:-}}" in\n{verbs}')
        self.environment = {
            **os.environ, "HOME": str(folder / "home"), "MACHINE": str(self.machine), "SITE": str(self.site),
            "PACKED": str(packed), "QT_QPA_PLATFORM": "xcb", "OMP_NUM_THREADS": "1",
            "PATH": os.pathsep.join([str(stand_ins), str(self.machine / "usr" / "bin"), os.environ["PATH"]])}

    def run(self, text):
        """A shell's block; all that it prints."""
        run = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=self.folder, env=self.environment,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False)
        assert run.returncode == 0, f"{run.returncode}: {text}\n{run.stdout[-3000:]}"
        return run.stdout


@pytest.fixture(scope="session")
def packed(tmp_path_factory):
    """Where the packages are left once they have been made."""
    return tmp_path_factory.mktemp("packed") / "packages"


@pytest.fixture
def place(tmp_path, stand_ins, packed):
    made = Place(tmp_path, stand_ins, packed)
    yield made
    packages = made.folder / "build" / "packages"
    if packages.is_dir() and not packages.is_symlink() and list(packages.glob("*.whl")):
        packages.rename(packed)


@pytest.fixture(scope="session")
def remesh(tmp_path_factory):
    """A run of the command line on a sample, and its report; no run is done twice."""
    folder = tmp_path_factory.mktemp("remesh")

    @functools.cache
    def run(mesh, *options, expect=0):
        mesh = mesh if Path(mesh).is_absolute() else ROOT / "sample_meshes" / mesh
        ended = subprocess.run([os.environ["CCDM_REMESH"], mesh, folder / "o.ply", "--report", folder / "r.json",
                                "--quiet", *map(str, options)], timeout=120, check=False, capture_output=True)
        assert ended.returncode == expect, ended.stderr
        return json.loads((folder / "r.json").read_text(encoding="utf-8"))
    return run
