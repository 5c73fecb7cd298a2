# SPDX-License-Identifier: GPL-3.0-or-later
"""The record beside each output, OUTPUT.json: what it was made of, and the report.

An output appears in three steps: a record that says "publishing", the output under its name, a record that
says "done". So a run that is killed anywhere leaves either a finished output, or one that the next run
knows as its own and makes again.
"""

import json
import os
import uuid
from pathlib import Path
from typing import Any, Dict, Optional

FORMAT = 1


def record_path(target: Path) -> Path:
    """Where the record of an output lies."""
    return target.with_name(target.name + ".json")


def part_path(target: Path) -> Path:
    """A name in the output's folder for what is not complete; no pattern for meshes matches it."""
    return target.with_name(f".{target.name}.{uuid.uuid4().hex}.ccdm-part")


def is_part(name: str) -> bool:
    """Whether a file name is one of part_path's."""
    return name.startswith(".") and name.endswith(".ccdm-part")


def read_record(target: Path) -> Optional[Dict[str, Any]]:
    """The record, or None where there is none that can be read."""
    try:
        record = json.loads(record_path(target).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return record if isinstance(record, dict) and record.get("format") == FORMAT else None


def write_record(target: Path, record: Dict[str, Any]) -> None:
    """Replaces the record in one step."""
    path = record_path(target)
    part = part_path(path)
    try:
        with open(part, "w", encoding="utf-8") as out:
            json.dump({"format": FORMAT, **record}, out, indent=1)
            out.flush()
            os.fsync(out.fileno())
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def stat_of(path: Path) -> Dict[str, int]:
    """Size and time of change, as records hold them; raises OSError."""
    info = os.stat(path)
    return {"size": info.st_size, "mtime_ns": info.st_mtime_ns}


def made_as_asked(record: Optional[Dict[str, Any]], key: Dict[str, Any], target: Path) -> bool:
    """Whether the record tells of a finished output with these parameters that is still there."""
    if record is None or record.get("state") != "done" or record.get("key") != key:
        return False
    try:
        return bool(stat_of(target)["size"] == record["output"]["size"])
    except (OSError, KeyError, TypeError):
        return False


def input_untouched(record: Dict[str, Any], source: Path) -> bool:
    """Whether size and time of the input are those of the record."""
    try:
        return stat_of(source) == {k: record["input"][k] for k in ("size", "mtime_ns")}
    except (OSError, KeyError, TypeError):
        return False
