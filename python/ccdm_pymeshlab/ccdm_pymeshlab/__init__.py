# SPDX-License-Identifier: GPL-3.0-or-later
"""The CCDM remesher as a filter of PyMeshLab.

    import ccdm_pymeshlab
    ccdm_pymeshlab.load()

Then every MeshSet, also one made before, has the filter `meshing_isotropic_ccdm`.
"""
import re
import threading
from importlib import metadata
from pathlib import Path

__all__ = ["FILTER", "UnsupportedHostError", "load", "plugin_path"]

FILTER = "meshing_isotropic_ccdm"
_PLUGINS = Path(__file__).parent / "plugins"
_lock = threading.Lock()


class UnsupportedHostError(ImportError):
    """PyMeshLab is missing, or is a version that this package has no plugin for."""


def plugin_path() -> Path:
    """The plugin for the installed PyMeshLab: one fits a single version of MeshLab, with its post releases."""
    try:
        version = metadata.version("pymeshlab")
    except metadata.PackageNotFoundError:
        raise UnsupportedHostError("PyMeshLab is not installed.") from None
    number = re.match(r"(\d+)\.(\d+)", version)
    path = _PLUGINS / (f"{number[1]}.{int(number[2]):02}" if number else version) / "libfilter_ccdm.so"
    if not path.is_file():
        there = ", ".join(sorted(p.parent.name for p in _PLUGINS.glob("*/libfilter_ccdm.so"))) or "none"
        raise UnsupportedHostError(
            f"There is no CCDM plugin for PyMeshLab {version} in this package, only for MeshLab: {there}."
        )
    return path


def load() -> None:
    """Registers the filter; does nothing where it is registered already, by this function or by a path."""
    path = plugin_path()
    import pymeshlab  # takes a second, and is not needed to see that there is no plugin for it

    with _lock:
        if FILTER not in pymeshlab.filter_list():
            pymeshlab.load_plugin(str(path))
        if not hasattr(pymeshlab.MeshSet, FILTER):
            # As PyMeshLab does for its own filters when it is imported.
            setattr(pymeshlab.MeshSet, FILTER, pymeshlab.bind_function(FILTER))
