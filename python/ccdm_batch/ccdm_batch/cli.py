# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line, ccdm-batch."""

import argparse
import os
import shutil
import sys
import time
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence

from ccdm_batch import __version__
from ccdm_batch.engines import NAMES
from ccdm_batch.failure import Failure
from ccdm_batch.inputs import FORMATS, InputError, find_jobs
from ccdm_batch.parameters import DENSITIES, LEAST_VERTICES, Parameters, parse_further
from ccdm_batch.progress import Progress
from ccdm_batch.record import is_part
from ccdm_batch.runner import Runner, Settings

if TYPE_CHECKING:
    from distributed import Client

DONE, WRONG_USAGE, SOME_FAILED, INTERRUPTED = 0, 2, 3, 130


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command and returns its exit status."""
    options = _parser().parse_args(arguments)
    try:
        return _run(options, _settings(options))
    except (ValueError, InputError, Failure) as error:
        print(f"ccdm-batch: {error}", file=sys.stderr)
        return WRONG_USAGE


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ccdm-batch",
        description="Remeshes many meshes with CCDM: a folder, a list or a glob, one mesh a task, on a local "
        "Dask cluster or on a scheduler's. Started again, it does only what is not finished.",
        epilog="Exit status: 0 all done, 2 wrong usage, 3 some meshes failed, 130 interrupted.",
    )
    parser.add_argument(
        "inputs",
        nargs="+",
        metavar="INPUT",
        help=f"a folder (with its subfolders), a mesh ({', '.join(FORMATS)}), a quoted glob, or a text file "
        "with a path a line",
    )
    parser.add_argument("output", metavar="OUTPUT", help="folder for the results; made if it is not there")

    group = parser.add_argument_group("target (exactly one)")
    target = group.add_mutually_exclusive_group(required=True)
    target.add_argument("-n", "--vertices", type=int, metavar="N", help="number of vertices of every result")
    target.add_argument(
        "--vertices-factor", type=float, metavar="F", help="the same, relative to the vertices of the input"
    )

    group = parser.add_argument_group("parameters (defaults: the engine's)")
    group.add_argument("--feature-angle", type=float, metavar="DEGREES", help="above 0 up to 180")
    group.add_argument("--density", choices=DENSITIES)
    group.add_argument("--seed", type=int, metavar="N")
    group.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="a further parameter, named as in scripts, for example lambda=0.1; may be repeated",
    )

    group = parser.add_argument_group("engine")
    group.add_argument("--engine", choices=NAMES, default=NAMES[0], help="default: %(default)s")
    group.add_argument("--plugin", metavar="FILE", help="the plugin for PyMeshLab")
    group.add_argument(
        "--program", metavar="FILE", help="ccdm_remesh for the engine cli (default: on the PATH)"
    )
    group.add_argument("--threads", type=int, default=1, metavar="N", help="per mesh (default: 1)")

    group = parser.add_argument_group("running")
    group.add_argument("--workers", type=int, metavar="N", help="local processes (default: one a core)")
    group.add_argument(
        "--scheduler", metavar="ADDRESS", help="use the workers of this Dask scheduler instead"
    )
    group.add_argument(
        "--time-limit", type=float, default=600, metavar="SECONDS", help="per attempt (default: 600)"
    )
    group.add_argument(
        "--retries",
        type=int,
        default=1,
        metavar="N",
        help="after a time-out, a crash, an I/O error (default: 1)",
    )
    group.add_argument(
        "--wait", type=float, default=60, metavar="SECONDS", help="for a first or lost worker (default: 60)"
    )

    group = parser.add_argument_group("output")
    group.add_argument("--format", choices=FORMATS, help="of every result (default: that of the input)")
    group.add_argument(
        "--summary", metavar="PREFIX", help="writes PREFIX.csv and PREFIX.parquet (default: OUTPUT/summary)"
    )
    group.add_argument(
        "--verify", action="store_true", help="compare finished meshes by content, not by size and time"
    )
    group.add_argument("--quiet", action="store_true", help="print errors only")
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    return parser


def _settings(options: argparse.Namespace) -> Settings:
    """Checks what argparse cannot; raises ValueError with a sentence."""

    def demand(holds: bool, sentence: str) -> None:
        if not holds:
            raise ValueError(sentence)

    n, factor, angle = options.vertices, options.vertices_factor, options.feature_angle
    demand(n is None or n >= LEAST_VERTICES, f"--vertices must be at least {LEAST_VERTICES}")
    demand(factor is None or 0 < factor <= 1e6, "--vertices-factor must be above 0 up to 1000000")
    demand(angle is None or 0 < angle <= 180, "--feature-angle must be above 0 up to 180")
    demand(options.seed is None or 0 <= options.seed < 2**31, "--seed must be from 0 to 2147483647")
    demand(options.workers is None or options.workers > 0, "--workers must be at least 1")
    demand(options.workers is None or options.scheduler is None, "--workers does not go with --scheduler")
    demand(options.threads > 0, "--threads must be at least 1")
    demand(0 < options.time_limit <= 1e7, "--time-limit must be above 0 up to 10000000")
    demand(options.retries >= 0, "--retries must be at least 0")
    demand(options.wait > 0, "--wait must be above 0")
    if options.engine == "pymeshlab":
        demand(options.plugin is not None, "the engine pymeshlab needs --plugin")
        demand(options.program is None, "--program goes with --engine cli only")
    else:
        demand(options.plugin is None, "--plugin goes with --engine pymeshlab only")
    path = options.plugin if options.engine == "pymeshlab" else options.program
    parameters = Parameters(n, factor, angle, options.density, options.seed, parse_further(options.set))
    return Settings(
        parameters=parameters,
        engine=options.engine,
        engine_path=_absolute(path),
        threads=options.threads,
        limit=options.time_limit,
        retries=options.retries,
        verify=options.verify,
        worker_wait=options.wait,
    )


def _absolute(path: Optional[str]) -> Optional[str]:
    """A worker has a working directory of its own; a bare name is looked up on its PATH."""
    if path is None or (os.path.dirname(path) == "" and not os.path.exists(path) and shutil.which(path)):
        return path
    return os.path.abspath(path)


def _run(options: argparse.Namespace, settings: Settings) -> int:
    start = time.monotonic()
    output = Path(options.output).absolute()
    if output.exists() and not output.is_dir():
        raise InputError(f"the output folder '{options.output}' is a file")
    jobs = find_jobs(options.inputs, output, options.format)
    prefix = Path(options.summary) if options.summary else output / "summary"
    try:
        output.mkdir(parents=True, exist_ok=True)
        _remove_old_parts(output, settings.limit)
    except OSError as error:
        raise InputError(f"the output folder cannot be used: {error}") from error

    rows: List[Dict[str, Any]] = []
    status = DONE
    progress = Progress(len(jobs), quiet=options.quiet)
    with ExitStack() as stack:
        runner = Runner(_connect(options, len(jobs), stack), settings, progress)
        runner.check_engine()
        try:
            rows = runner.remesh(jobs)
        except KeyboardInterrupt:
            rows = runner.rows()
            status = INTERRUPTED
        progress.close()
    _write(rows, prefix)
    failed = [row for row in rows if row["status"] == "failed"]
    for row in failed:
        print(f"ccdm-batch: {row['input']}: {row['reason']}", file=sys.stderr)
    if not options.quiet:
        counts = ", ".join(
            f"{sum(row['status'] == name for row in rows)} {name.replace('_', ' ')}"
            for name in ("done", "kept", "failed", "not_run")
            if name != "not_run" or status == INTERRUPTED
        )
        total = "1 mesh" if len(rows) == 1 else f"{len(rows)} meshes"
        seconds = time.monotonic() - start
        print(f"{total}: {counts}; {seconds:.1f} s; table: {prefix}.csv, .parquet")
    return SOME_FAILED if failed and status == DONE else status


def _connect(options: argparse.Namespace, jobs: int, stack: ExitStack) -> "Client":
    """A client; the local cluster that it may need ends with the stack. Raises Failure."""
    import dask

    # Dask's own account of lost workers is not for the user of this command; ours follows.
    dask.config.set({"logging.distributed": "critical"})
    from distributed import Client, LocalCluster

    if options.scheduler is not None:
        try:
            client: "Client" = stack.enter_context(Client(options.scheduler, timeout=options.wait))
            return client
        except (OSError, ValueError) as error:
            raise Failure("worker", f"the scheduler '{options.scheduler}' does not answer") from error
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    cluster = LocalCluster(
        n_workers=options.workers or max(1, min(jobs, cores // options.threads)),
        threads_per_worker=1,
        processes=True,
        # Else it listens for everybody.
        dashboard_address="127.0.0.1:0",
        # The mesh is in the child; a limit on the worker itself has no meaning.
        memory_limit=0,
    )
    stack.enter_context(cluster)
    client = stack.enter_context(Client(cluster))
    return client


def _remove_old_parts(output: Path, limit: float) -> None:
    """What killed runs left. Nothing older than the time limit can still be being written."""
    oldest = time.time() - limit - 60
    for folder, _, files in os.walk(output):
        for name in filter(is_part, files):
            path = Path(folder, name)
            with suppress(FileNotFoundError):  # another run may be at it
                if path.stat().st_mtime < oldest:
                    path.unlink()


def _write(rows: List[Dict[str, Any]], prefix: Path) -> None:
    from ccdm_batch.summary import write_summary

    try:
        write_summary(rows, prefix)
    except OSError as error:
        raise InputError(f"the summary cannot be written: {error}") from error
