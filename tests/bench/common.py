# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks share: paths, and what one process costs."""
import os
import signal
import subprocess
import tempfile
import threading
import time
from collections import namedtuple

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.join(ROOT, "build", "bin", "ccdm_remesh")
SERVER = os.path.join(ROOT, "build", "host", "bin", "meshlabserver")
MESHES = os.path.join(ROOT, "..", "shared", "meshes")
OUT = os.path.join(ROOT, "build", "bench")


Usage = namedtuple("Usage", "cpu wall megabytes")


def last_line(log):
    """The last thing that a process said, without this tree's path."""
    log.seek(0)
    lines = [line for line in log.read().decode("utf-8", "replace").split("\n") if line.strip()]
    return lines[-1].replace(ROOT + os.sep, "").strip() if lines else "it said nothing"


def usage_of(command, limit=3600, **options):
    """User + system seconds of a process and of those it waits for, wall seconds, peak memory in MB.

    A RuntimeError says why it failed; a process that takes more than `limit` wall seconds is ended.
    """
    with tempfile.TemporaryFile() as log:
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True, **options)
        overdue = threading.Timer(limit, os.killpg, (process.pid, signal.SIGKILL))
        overdue.daemon = True
        overdue.start()
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        overdue.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        if wall >= limit:
            raise RuntimeError(f"not done after {limit:g} s")
        if process.returncode != 0:
            raise RuntimeError(f"status {process.returncode}: {last_line(log)}")
    return Usage(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024)


def cpu_seconds(command, **options):
    """User + system seconds of a process and of those it waits for; its peak memory in MB."""
    usage = usage_of(command, **options)
    return usage.cpu, usage.megabytes


def model(name):
    """A real model where they are at hand, else the sample that stands for it."""
    path = os.path.join(MESHES, name + ".ply")
    samples = {"joint": "cad_part", "foot": "bumpy", "bunny_scan": "bust", "igea": "bumpy"}
    return path if os.path.exists(path) else os.path.join(ROOT, "sample_meshes", samples.get(name, name) + ".ply")


def count_vertices(path):
    head = open(path, "rb").read(2000).decode("latin1")
    return int(head.split("element vertex ")[1].split()[0])
