# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of all reports, as CSV and Parquet."""

import contextlib
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from ccdm_batch.record import part_path

_TEXT, _WHOLE, _REAL, _FLAG = pa.string(), pa.int64(), pa.float64(), pa.bool_()

# Columns about the run, filled by the runner.
_RUN: List[Tuple[str, pa.DataType]] = [
    ("input", _TEXT),
    ("output", _TEXT),
    ("status", _TEXT),
    ("kind", _TEXT),
    ("reason", _TEXT),
    ("attempts", _WHOLE),
    ("seconds", _REAL),
]

# Columns from the report, with their place in it.
_REPORT: List[Tuple[str, pa.DataType, Tuple[str, ...]]] = [
    ("vertices_asked", _WHOLE, ("parameters", "vertices")),
    ("input_vertices", _WHOLE, ("input", "vertices")),
    ("input_faces", _WHOLE, ("input", "faces")),
    ("vertices", _WHOLE, ("result", "vertices")),
    ("faces", _WHOLE, ("result", "faces")),
    ("input_angle_min_avg", _REAL, ("input", "angle_min_avg")),
    ("input_angle_min", _REAL, ("input", "angle_min")),
    ("angle_min_avg", _REAL, ("result", "angle_min_avg")),
    ("angle_min", _REAL, ("result", "angle_min")),
    ("pct_lt30", _REAL, ("result", "pct_lt30")),
    ("q_fb99_avg", _REAL, ("result", "q_fb99_avg")),
    ("pct_valence6", _REAL, ("result", "pct_valence6")),
    ("hausdorff", _REAL, ("result", "hausdorff")),
    ("rms", _REAL, ("result", "rms")),
    ("input_euler", _WHOLE, ("input", "euler")),
    ("euler", _WHOLE, ("result", "euler")),
    ("components", _WHOLE, ("result", "components")),
    ("boundary_loops", _WHOLE, ("result", "boundary_loops")),
    ("genus", _REAL, ("result", "genus")),
    ("orientable", _FLAG, ("result", "orientable")),
    ("topology_preserved", _FLAG, ("topology_preserved",)),
    ("feature_curves", _WHOLE, ("features", "curves")),
    ("feature_corners", _WHOLE, ("features", "corners")),
    ("iterations_accepted", _WHOLE, ("accepted",)),
    ("warnings", _TEXT, ("warnings",)),
]

SCHEMA = pa.schema(
    [*_RUN, *((name, kind) for name, kind, _ in _REPORT)],
    metadata={"angles": "degrees", "hausdorff, rms": "in bounding-box diagonals of the input"},
)


def report_columns(report: Optional[Dict[str, Any]], finished: bool) -> Dict[str, Any]:
    """The report's figures by column; what the report does not have is None.

    Where there is no result, only what is known of the input counts.
    """
    return {
        name: _convert(_look_up(report, place), kind)
        for name, kind, place in _REPORT
        if finished or place[0] in ("parameters", "input")
    }


def _look_up(report: Any, place: Tuple[str, ...]) -> Any:
    for key in place:
        report = report.get(key) if isinstance(report, dict) else None
    return report


def _convert(value: Any, kind: pa.DataType) -> Any:
    if isinstance(value, list):
        value = "; ".join(map(str, value))
    with contextlib.suppress(TypeError, ValueError, OverflowError):
        if value is not None and value != "":
            return {_TEXT: str, _WHOLE: int, _REAL: float, _FLAG: bool}[kind](value)
    return None


def write_summary(rows: List[Dict[str, Any]], prefix: Path) -> None:
    """PREFIX.csv and PREFIX.parquet, each replaced in one step; raises OSError."""
    table = pa.Table.from_pylist(rows, schema=SCHEMA)
    prefix.parent.mkdir(parents=True, exist_ok=True)
    for suffix, write in ((".csv", pyarrow.csv.write_csv), (".parquet", pyarrow.parquet.write_table)):
        path = prefix.with_name(prefix.name + suffix)
        part = part_path(path)
        try:
            write(table, str(part))
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
