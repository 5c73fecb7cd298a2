# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives ccdm-batch as its users do: as a command, on folders of small meshes."""

import csv
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "ccdm_batch"
sys.path[:0] = [str(ROOT / "tests" / "support"), str(PACKAGE)]

# Without these there is nothing to collect, which is pytest's exit status 5.
if not all(importlib.util.find_spec(name) for name in ("distributed", "pyarrow")):
    collect_ignore_glob = ["test_*.py"]

PROGRAM = os.environ.get("CCDM_REMESH", str(ROOT / "build" / "bin" / "ccdm_remesh"))
PLUGIN = os.environ.get("CCDM_PYMESHLAB_PLUGIN", "")

# Runs the real program; what it does before that is in PRELUDE.
STAND_IN = """#!/bin/sh
case "$1" in --*) exec "{program}" "$@";; esac
{prelude}
exec "{program}" "$@"
"""


class Command:
    """ccdm-batch on the folder `inputs`, with the results in `output`."""

    def __init__(self, folder, scheduler):
        self.folder = folder
        self.scheduler = scheduler
        self.inputs = folder / "in"
        self.output = folder / "out"
        self.inputs.mkdir()
        self.environment = {**os.environ, "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1"}

    def arguments(self, *options, source=None, program=PROGRAM, target=("--vertices", 200), workers=None):
        """The whole command line; with `workers` a cluster of its own, else that of the session."""
        line = [sys.executable, "-m", "ccdm_batch", source or self.inputs, self.output, *target]
        line += ["--engine", "cli", "--program", program] if program else []
        if workers:
            line += ["--workers", workers]
        elif "--scheduler" not in options:
            line += ["--scheduler", self.scheduler]
        return [str(item) for item in (*line, *options)]

    def __call__(self, *options, expect=0, **named):
        """Runs it to the end and returns standard output and error."""
        run = subprocess.run(
            self.arguments(*options, **named),
            capture_output=True,
            text=True,
            timeout=180,
            check=False,
            env=self.environment,
            cwd=self.folder,
        )
        assert run.returncode == expect, (run.returncode, run.stdout, run.stderr)
        assert "Traceback" not in run.stderr, run.stderr
        return run

    def start(self, *options, **named):
        """Starts it and returns the process."""
        return subprocess.Popen(
            self.arguments(*options, **named),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=self.environment,
            cwd=self.folder,
        )

    def rows(self):
        """The summary's rows by output name."""
        with open(self.output / "summary.csv", newline="", encoding="utf-8") as table:
            return {row["output"]: row for row in csv.DictReader(table)}

    def files(self):
        """Everything in the output folder but the summary."""
        found = (str(path.relative_to(self.output)) for path in self.output.rglob("*") if path.is_file())
        return sorted(name for name in found if not name.startswith("summary."))


def local_cluster():
    """One worker that finds the package."""
    from distributed import LocalCluster

    os.environ["PYTHONPATH"] = str(PACKAGE)
    return LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0", memory_limit=0, silence_logs=50
    )


@pytest.fixture(scope="session")
def cluster():
    with local_cluster() as made:
        yield made


@pytest.fixture
def batch(tmp_path, cluster):
    return Command(tmp_path, cluster.scheduler_address)


@pytest.fixture
def stand_in(tmp_path):
    """A program that does something before it becomes ccdm_remesh ($1 is the input, $2 the output)."""

    def make(prelude):
        path = tmp_path / "stand_in"
        path.write_text(STAND_IN.format(program=PROGRAM, prelude=prelude))
        path.chmod(0o755)
        return path

    return make
