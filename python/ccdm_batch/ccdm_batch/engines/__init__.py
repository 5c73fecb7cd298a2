# SPDX-License-Identifier: GPL-3.0-or-later
"""What does the work on one mesh; an engine runs in a process of its own, which may crash or be killed."""

from pathlib import Path
from typing import Any, Collection, Dict, Optional, Protocol

from ccdm_batch.failure import Failure
from ccdm_batch.parameters import Parameters

NAMES = ("pymeshlab", "cli")


class Engine(Protocol):
    """Reads a mesh, remeshes it, writes it, reports."""

    name: str

    def check(self, further: Collection[str]) -> str:
        """The engine's version; raises Failure when it does not work or does not know a parameter."""

    def remesh(self, source: Path, target: Path, parameters: Parameters, limit: float) -> Dict[str, Any]:
        """Writes `target` in the format of its suffix and returns the report (the command line's form).

        `limit`, in seconds, is for processes that the engine starts. Raises Failure.
        """


def make_engine(name: str, path: Optional[str], threads: int) -> Engine:
    """The engine of that name; `path` is the plugin or the program."""
    if name == "cli":
        from ccdm_batch.engines.cli import CommandLineEngine

        return CommandLineEngine(path or "ccdm_remesh", threads)
    if name == "pymeshlab":
        from ccdm_batch.engines.pymeshlab import PyMeshLabEngine

        return PyMeshLabEngine(path, threads)
    raise Failure("engine", f"there is no engine '{name}'")
