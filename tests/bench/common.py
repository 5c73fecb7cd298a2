# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks share: paths, and the processor time of one process."""
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.join(ROOT, "build", "bin", "ccdm_remesh")
SERVER = os.path.join(ROOT, "build", "host", "bin", "meshlabserver")
MESHES = os.path.join(ROOT, "..", "shared", "meshes")
OUT = os.path.join(ROOT, "build", "bench")


def cpu_seconds(command, **options):
    """User + system seconds of a process and of those it waits for; its peak memory in MB."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"status {process.returncode}: {' '.join(map(str, command))}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def model(name):
    """A real model where they are at hand, else the sample that stands for it."""
    path = os.path.join(MESHES, name + ".ply")
    samples = {"joint": "cad_part", "foot": "bumpy", "bunny_scan": "bust", "igea": "bumpy"}
    return path if os.path.exists(path) else os.path.join(ROOT, "sample_meshes", samples[name] + ".ply")


def count_vertices(path):
    head = open(path, "rb").read(2000).decode("latin1")
    return int(head.split("element vertex ")[1].split()[0])
