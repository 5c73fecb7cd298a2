# SPDX-License-Identifier: GPL-3.0-or-later
"""What a Dask worker runs: one child process, watched."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Callable, Dict

from ccdm_batch.process import wait_or_kill

STARTED = "ccdm-batch-started"


def run_task(job: Dict[str, Any]) -> Dict[str, Any]:
    """Does one job and returns its outcome: status, kind, reason, report, seconds; never raises."""
    from distributed import get_worker

    worker = get_worker()
    key = worker.get_current_task()
    # The client counts the starts: a worker that dies cannot tell of its own.
    worker.log_event(f"{STARTED}-{job['run']}", {"index": job["index"]})

    def wanted() -> bool:
        state = worker.state.tasks.get(key)
        return state is not None and state.state in ("executing", "long-running")

    return run_child(job, worker.local_directory, wanted)


def run_child(job: Dict[str, Any], folder: str, wanted: Callable[[], bool] = lambda: True) -> Dict[str, Any]:
    """Starts the child in a scratch folder below `folder` and ends it when its time is over."""
    scratch = Path(tempfile.mkdtemp(prefix="ccdm-", dir=folder))
    try:
        content = {**job, "parent": os.getpid()}
        (scratch / "job.json").write_text(json.dumps(content), encoding="utf-8")
        with open(scratch / "errors", "wb") as errors:
            process = subprocess.Popen(
                [sys.executable, "-m", "ccdm_batch.child", str(scratch)],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                start_new_session=True,
                env=_environment(job["threads"]),
            )
        status = wait_or_kill(process, job["limit"], wanted)
        if status is None:
            reason = (
                f"it took longer than the limit of {job['limit']:g} s" if wanted() else "it was cancelled"
            )
            return {"status": "failed", "kind": "timeout", "reason": reason, "seconds": job["limit"]}
        try:
            outcome: Dict[str, Any] = json.loads((scratch / "outcome.json").read_text(encoding="utf-8"))
            return outcome
        except (OSError, ValueError):
            return {"status": "failed", "kind": "crash", "reason": _cause(status, scratch / "errors")}
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _environment(threads: int) -> Dict[str, str]:
    # The child finds this package where the worker found it.
    package = str(Path(__file__).resolve().parent.parent)
    paths = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    if threads:
        environment["OMP_NUM_THREADS"] = str(threads)
    return environment


def _cause(status: int, errors: Path) -> str:
    if status < 0:
        name = signal.Signals(-status).name
        return f"its process was ended by {name}" + (
            ", perhaps for want of memory" if name == "SIGKILL" else ""
        )
    lines = errors.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return f"its process ended with exit status {status}" + (f": {lines[-1]}" if lines else "")
