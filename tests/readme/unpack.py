# SPDX-License-Identifier: GPL-3.0-or-later
"""unpack.py install WHAT...: what pip does with wheels and folders of the project, into the folder that SITE names.

Everything that they need is in the build's environment, in the version that is asked for.
"""
import os
import re
import shutil
import sys
import zipfile
from pathlib import Path

import conftest


def main(verb, *wanted):
    assert verb == "install"
    site = Path(os.environ["SITE"])
    for what in wanted:
        path = Path(re.sub(r"\[\w+\]$", "", what))
        if path.suffix == ".whl":
            zipfile.ZipFile(path).extractall(site)
        elif path.is_dir():
            assert (path / "pyproject.toml").exists()
            shutil.copytree(path / path.name, site / path.name)
        else:
            name, version = what.split("==")
            assert list(conftest.VENV.glob(f"lib/python3*/site-packages/{name}-{version}*.dist-info")), what


if __name__ == "__main__":
    main(*sys.argv[1:])
