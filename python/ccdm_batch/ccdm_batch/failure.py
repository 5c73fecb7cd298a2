# SPDX-License-Identifier: GPL-3.0-or-later
"""Why a mesh was not done."""

from typing import Any, Dict, Optional

# What trying again may cure; everything else comes out the same every time.
WORTH_A_RETRY = frozenset({"timeout", "crash", "io"})


class Failure(Exception):
    """One mesh was not done.

    `kind` is one of: unreadable (not a mesh), refused (a mesh that cannot be remeshed), usage (wrong
    parameters), output (cannot be written in that format), check (the result failed its check), engine
    (the engine itself does not work), name (the output's name is taken), io (a file could not be read or
    written), crash, timeout, worker.
    """

    def __init__(self, kind: str, reason: str, report: Optional[Dict[str, Any]] = None):
        super().__init__(reason)
        self.kind = kind
        self.reason = reason
        self.report = report
