# SPDX-License-Identifier: GPL-3.0-or-later
"""build_wheels.py PLUGINS OUT: the wheels of the Python packages, into the folder OUT.

PLUGINS is the build's folder of plugins, one subfolder for each MeshLab; nothing is compiled or fetched.
Needs pip, setuptools and wheel (in Debian packages of the same names).
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PACKAGES = ("ccdm_pymeshlab", "ccdm_batch")
# PyMeshLab's. That of 2020.09 is for Debian's MeshLab.
HOSTS = ("2022.02", "2025.07")


def add_plugins(plugins: Path, package: Path) -> None:
    """Copies the plugins that there are into the package, without the symbols that only a debugger reads."""
    found = [v for v in HOSTS if (plugins / v / "libfilter_ccdm.so").is_file()]
    if not found:
        sys.exit(f"build_wheels.py: {plugins} has no plugin for PyMeshLab")
    for version in found:
        copy = package / "plugins" / version / "libfilter_ccdm.so"
        copy.parent.mkdir(parents=True)
        shutil.copy(plugins / version / "libfilter_ccdm.so", copy)
        subprocess.run(["strip", "--strip-unneeded", copy], check=True)


def main() -> None:
    plugins, out = Path(sys.argv[1]), Path(sys.argv[2])
    source = Path(__file__).resolve().parent
    # A copy, because setuptools builds beside the sources.
    with tempfile.TemporaryDirectory() as folder:
        copies = [Path(folder) / name for name in PACKAGES]
        for copy in copies:
            litter = shutil.ignore_patterns("build", "*.egg-info", "__pycache__")
            shutil.copytree(source / copy.name, copy, ignore=litter)
            shutil.copy(source.parent / "LICENSE", copy)
        add_plugins(plugins, copies[0] / PACKAGES[0])
        offline = ("--disable-pip-version-check", "--no-index", "--no-deps", "--no-build-isolation")
        subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", *offline, "-w", out, *copies], check=True)


if __name__ == "__main__":
    main()
