# SPDX-License-Identifier: GPL-3.0-or-later
"""The process that does one mesh: `python -m ccdm_batch.child FOLDER`.

Everything that may hang or crash happens here: reading the input, the engine, writing the output. The
folder is a private one on the worker's disk; it holds job.json, and outcome.json at the end. Exit status 0
when there is an outcome, good or bad.
"""

import contextlib
import hashlib
import json
import os
import sys
import time
from pathlib import Path
from typing import Any, Dict, Optional

from ccdm_batch.engines import Engine, make_engine
from ccdm_batch.failure import Failure
from ccdm_batch.parameters import Parameters
from ccdm_batch.process import end_with_parent
from ccdm_batch.record import part_path, read_record, record_path, stat_of, write_record

_BLOCK = 1 << 20
# The worker's own limit comes first; this one is for when there is no worker any more.
_GRACE = 10.0


def main(folder: str) -> None:
    """Does the job of the folder and writes its outcome."""
    scratch = Path(folder)
    job = json.loads((scratch / "job.json").read_text(encoding="utf-8"))
    end_with_parent(job["limit"] + _GRACE)
    if os.getppid() != job["parent"]:
        sys.exit(1)  # the worker is gone already
    start = time.monotonic()
    try:
        engine = make_engine(job["engine"], job["engine_path"], job["threads"])
        outcome = _check(engine, job) if job["task"] == "check" else _remesh(engine, job, scratch)
    except Failure as failure:
        outcome = {
            "status": "failed",
            "kind": failure.kind,
            "reason": failure.reason,
            "report": failure.report,
        }
    outcome.setdefault("seconds", time.monotonic() - start)
    (scratch / "outcome.json").write_text(json.dumps(outcome), encoding="utf-8")


def _check(engine: Engine, job: Dict[str, Any]) -> Dict[str, Any]:
    return {"status": "done", "version": engine.check(job["parameters"]["further"])}


def _remesh(engine: Engine, job: Dict[str, Any], scratch: Path) -> Dict[str, Any]:
    source, target = Path(job["source"]), Path(job["target"])
    copy = scratch / ("input" + source.suffix.lower())
    made = scratch / ("output" + target.suffix.lower())
    origin = _take_copy(source, copy)

    record = read_record(target)
    if job["compare"] and record is not None and _same_content(record, origin, target):
        record["input"] = origin
        write_record(target, record)
        return {"status": "kept", "report": record.get("report"), "seconds": record.get("seconds")}
    _demand_own(record, target, job["verify"])

    start = time.monotonic()
    report = engine.remesh(copy, made, Parameters(**job["parameters"]), job["limit"])
    seconds = time.monotonic() - start
    for part, name in (("input", source), ("result", target)):
        if isinstance(report.get(part), dict):
            report[part]["file"] = name.name
    record = {"key": job["key"], "input": origin, "seconds": seconds, "report": report}
    try:
        _publish(made, target, record)
    except OSError as error:
        raise Failure("io", f"the output cannot be written: {error.strerror or error}") from error
    return {"status": "done", "report": report}


def _take_copy(source: Path, copy: Path) -> Dict[str, Any]:
    """Copies the input, so that what is remeshed is what the hash is of, and a bucket is read once."""
    try:
        before = stat_of(source)
        digest = hashlib.sha256()
        with open(source, "rb") as reader, open(copy, "wb") as writer:
            while block := reader.read(_BLOCK):
                digest.update(block)
                writer.write(block)
        after = stat_of(source)
    except FileNotFoundError as error:
        raise Failure("unreadable", "there is no such file") from error
    except IsADirectoryError as error:
        raise Failure("unreadable", "it is a folder") from error
    except OSError as error:
        raise Failure("io", f"it cannot be read: {error.strerror or error}") from error
    if before != after:
        raise Failure("io", "it was changed while it was read")
    return {**before, "sha256": digest.hexdigest()}


def _hash(path: Path) -> str:
    digest = hashlib.sha256()
    with open(path, "rb") as reader:
        while block := reader.read(_BLOCK):
            digest.update(block)
    return digest.hexdigest()


def _same_content(record: Dict[str, Any], origin: Dict[str, Any], target: Path) -> bool:
    with contextlib.suppress(KeyError, TypeError):
        return bool(record["input"]["sha256"] == origin["sha256"]) and _same_output(record, target)
    return False


def _same_output(record: Dict[str, Any], target: Path) -> bool:
    with contextlib.suppress(OSError, KeyError, TypeError):
        return bool(_hash(target) == record["output"]["sha256"])
    return False


def _demand_own(record: Optional[Dict[str, Any]], target: Path, verify: bool) -> None:
    """Raises Failure where a file of somebody else, or one that was changed, would be replaced."""
    for path in (target, record_path(target)):
        if record is None and os.path.lexists(path):
            raise Failure("name", f"'{path}' is there already and was not made by ccdm-batch; move it away")
    finished = record is not None and record.get("state") == "done"
    if finished and not verify and os.path.lexists(target) and not _same_output(record or {}, target):
        raise Failure("name", f"'{target}' was changed after it was made; move it away, or give --verify")


def _publish(made: Path, target: Path, record: Dict[str, Any]) -> None:
    """The output and its record under their names, the output only when it is complete."""
    target.parent.mkdir(parents=True, exist_ok=True)
    part = part_path(target)
    try:
        digest = hashlib.sha256()
        with open(made, "rb") as reader, open(part, "wb") as writer:
            while block := reader.read(_BLOCK):
                digest.update(block)
                writer.write(block)
            writer.flush()
            os.fsync(writer.fileno())
        record["output"] = {"size": made.stat().st_size, "sha256": digest.hexdigest()}
        write_record(target, {"state": "publishing", **record})
        os.replace(part, target)
        write_record(target, {"state": "done", **record})
    finally:
        part.unlink(missing_ok=True)


if __name__ == "__main__":
    main(sys.argv[1])
