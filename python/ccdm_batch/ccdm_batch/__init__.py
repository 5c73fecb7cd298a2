# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshes many meshes with CCDM: one mesh a task, on a local Dask cluster or on a scheduler's.

One mesh from top to bottom: `inputs` finds it and names its output, `record` says whether an earlier run
has finished it, `runner` submits it, `task` runs on a worker and starts the killable process `child`, which
calls an engine of `engines` and puts the output into its place; `summary` makes the table.
"""

__version__ = "0.1.0"
