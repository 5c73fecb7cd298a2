# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands the meshes to Dask, tries again what may be cured by it, and collects the rows of the summary."""

import queue
import time
import uuid
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional

from ccdm_batch.failure import WORTH_A_RETRY, Failure
from ccdm_batch.inputs import Job
from ccdm_batch.parameters import Parameters
from ccdm_batch.progress import Progress
from ccdm_batch.record import input_untouched, made_as_asked, read_record
from ccdm_batch.summary import report_columns
from ccdm_batch.task import STARTED, run_task

if TYPE_CHECKING:
    from distributed import Client, Future


@dataclass(frozen=True)
class Settings:
    """How every mesh is done; `limit` is the wall time of one attempt in seconds."""

    parameters: Parameters
    engine: str = "pymeshlab"
    engine_path: Optional[str] = None
    threads: int = 1
    limit: float = 600
    retries: int = 1
    verify: bool = False
    worker_wait: float = 60

    def key(self) -> Dict[str, Any]:
        """What an output depends on beside the input."""
        return {"engine": self.engine, "parameters": self.parameters.as_dict()}


@dataclass
class _State:
    job: Job
    starts: int = 0
    attempts: int = 0
    compare: bool = False
    row: Optional[Dict[str, Any]] = None


@dataclass
class Runner:
    """One run over a list of jobs with a connected client."""

    client: "Client"
    settings: Settings
    progress: Progress
    run: str = field(default_factory=lambda: uuid.uuid4().hex)

    def check_engine(self) -> str:
        """The engine's version as a worker sees it; raises Failure when it does not work there."""
        self._wait_for_worker()
        task = {**self._common(), "task": "check", "index": -1, "limit": min(self.settings.limit, 120)}
        outcome = self.client.submit(run_task, task, key=f"ccdm-check-{self.run}", pure=False).result()
        if outcome["status"] != "done":
            raise Failure(outcome["kind"], outcome["reason"])
        return str(outcome["version"])

    def remesh(self, jobs: List[Job]) -> List[Dict[str, Any]]:
        """Does all jobs; one row each, in their order. On KeyboardInterrupt the rows so far are in `rows`."""
        self._states = [_State(job) for job in jobs]
        self._done: "queue.Queue[tuple[int, Future[Any]]]" = queue.Queue()
        self._running: Dict[int, "Future[Any]"] = {}
        topic = f"{STARTED}-{self.run}"
        self.client.subscribe_topic(topic, self._count_start)
        try:
            self._loop()
        finally:
            self.client.cancel(list(self._running.values()), force=True)
            self.client.unsubscribe_topic(topic)
        return self.rows()

    def rows(self) -> List[Dict[str, Any]]:
        """The rows of the summary; what has not been finished has the status not_run."""
        for state in self._states:
            if state.row is None:
                state.row = self._row(state, {"status": "not_run", "reason": "the run was ended before"})
        return [state.row for state in self._states if state.row is not None]

    def _loop(self) -> None:
        waiting = self._to_do()
        more = True
        seen_worker = time.monotonic()
        while more or self._running:
            # A few more than there are threads, so that none waits and memory stays small.
            while more and len(self._running) < self._window():
                index = next(waiting, None)
                more = index is not None
                if index is not None:
                    self._submit(index)
            if not self._running:
                continue
            try:
                index, future = self._done.get(timeout=0.5)
            except queue.Empty:
                self.progress.draw()
                if self.client.status == "running" and self.client.nthreads():
                    seen_worker = time.monotonic()
                elif time.monotonic() - seen_worker > self.settings.worker_wait:
                    self._give_up(waiting)
                    return
                continue
            seen_worker = time.monotonic()
            self._collect(index, future)

    def _to_do(self) -> Iterator[int]:
        """The jobs that are neither finished by an earlier run nor hopeless."""
        key = self.settings.key()
        for index, state in enumerate(self._states):
            job = state.job
            record = read_record(job.target)
            if job.reason is not None:
                self._finish(state, {"status": "failed", "kind": "name", "reason": job.reason})
            elif record is not None and made_as_asked(record, key, job.target):
                if input_untouched(record, job.source) and not self.settings.verify:
                    self._finish(
                        state,
                        {"status": "kept", "report": record.get("report"), "seconds": record.get("seconds")},
                    )
                else:
                    state.compare = True
                    yield index
            else:
                yield index

    def _window(self) -> int:
        return 4 + 2 * sum(self.client.nthreads().values()) if self.client.status == "running" else 4

    def _submit(self, index: int) -> None:
        state = self._states[index]
        state.attempts += 1
        task = {
            **self._common(),
            "task": "remesh",
            "index": index,
            "source": str(state.job.source),
            "target": str(state.job.target),
            "compare": state.compare,
            "verify": self.settings.verify,
        }
        # Earlier meshes first, so that what is tried again does not wait for the end.
        name = f"ccdm-remesh-{self.run}-{index}-{state.attempts}"
        future = self.client.submit(run_task, task, key=name, pure=False, priority=-index)
        self._running[index] = future
        future.add_done_callback(lambda finished: self._done.put((index, finished)))

    def _common(self) -> Dict[str, Any]:
        settings = self.settings
        return {
            "run": self.run,
            "engine": settings.engine,
            "engine_path": settings.engine_path,
            "threads": settings.threads,
            "limit": settings.limit,
            "parameters": settings.parameters.as_dict(),
            "key": settings.key(),
        }

    def _collect(self, index: int, future: "Future[Any]") -> None:
        from distributed import KilledWorker

        state = self._states[index]
        if self._running.get(index) is not future:
            return
        del self._running[index]
        try:
            outcome = future.result()
        except KilledWorker:
            outcome = {"status": "failed", "kind": "worker", "reason": "every worker that took it died"}
        except Exception as error:  # the worker's trouble, not the mesh's; nothing may end the run
            outcome = {"status": "failed", "kind": "io", "reason": f"the worker failed: {error!r}"}
        failed_often = state.attempts > self.settings.retries
        if outcome["status"] == "failed" and outcome["kind"] in WORTH_A_RETRY and not failed_often:
            self._submit(index)
        else:
            self._finish(state, outcome)

    def _give_up(self, waiting: Iterator[int]) -> None:
        reason = f"no worker was there for {self.settings.worker_wait:g} s"
        outcome = {"status": "failed", "kind": "worker", "reason": reason}
        for index in [*self._running, *waiting]:
            self._finish(self._states[index], outcome)

    def _finish(self, state: _State, outcome: Dict[str, Any]) -> None:
        state.row = self._row(state, outcome)
        self.progress.add(outcome["status"])

    def _row(self, state: _State, outcome: Dict[str, Any]) -> Dict[str, Any]:
        reason = outcome.get("reason")
        finished = outcome["status"] in ("done", "kept")
        if not finished and state.attempts and read_record(state.job.target) is not None:
            reason = f"{reason}; an older output was left in place"
        return {
            "input": str(state.job.source),
            "output": state.job.name,
            "status": outcome["status"],
            "kind": outcome.get("kind"),
            "reason": reason,
            # A worker that died has started it without an answer.
            "attempts": max(state.starts, state.attempts),
            "seconds": outcome.get("seconds"),
            **report_columns(outcome.get("report"), finished),
        }

    def _count_start(self, event: Any) -> None:
        _, message = event
        if 0 <= message["index"] < len(self._states):
            self._states[message["index"]].starts += 1

    def _wait_for_worker(self) -> None:
        try:
            self.client.wait_for_workers(1, timeout=self.settings.worker_wait)
        except TimeoutError as error:
            reason = f"no worker joined the scheduler within {self.settings.worker_wait:g} s"
            raise Failure("worker", reason) from error
