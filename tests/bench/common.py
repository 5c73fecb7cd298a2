# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks share: paths, models, the machine, what one process costs and what its result is worth."""
import argparse
import datetime
import hashlib
import json
import os
import platform
import re
import signal
import subprocess
import sys
import tempfile
from collections import namedtuple

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
PROGRAM = os.environ.get("CCDM_REMESH", os.path.join(ROOT, "build", "bin", "ccdm_remesh"))
MEASURE = os.path.join(os.path.dirname(PROGRAM), "measure_mesh")
SERVER = os.path.join(ROOT, "build", "host", "bin", "meshlabserver")
MESHES = os.path.join(os.environ.get("CCDM_SHARED", os.path.join(ROOT, "..", "shared")), "meshes")
OUT = os.path.join(ROOT, "build", "bench")
# Models and vertex counts of a comparison: the real ones, and what stands for them where they are not at hand.
MODELS = (("joint", 6000), ("twist", 5000), ("wingnut", 6000), ("pig", 10000), ("klein_bottle", 5000),
          ("max_planck", 10000), ("moai", 10000), ("foot", 6000), ("gargoyle", 18000), ("bunny_scan", 10000),
          ("julius_noisy", 20000), ("koala", 10000), ("lion_vase", 30000), ("igea", 20000))
SAMPLES = (("cad_part", 5000), ("twisted_bar", 5000), ("plate", 5000), ("klein_bottle", 5000), ("high_genus", 8000),
           ("bumpy", 6000), ("bust", 10000))
# The feature angles, in degrees, at which models have creases worth keeping; the others have none. For the real models
# they are those at which their wanted figures are given, for the samples the command line's default.
OWN_ANGLES = {"joint": 40, "twist": 60, "wingnut": 60, "pig": 40, "cad_part": 40, "twisted_bar": 40, "plate": 40,
              "high_genus": 40}
NO_CREASES = 180
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
    with tempfile.TemporaryFile() as log, tempfile.NamedTemporaryFile("r", encoding="ascii") as cost:
        launcher = [sys.executable, "-I", "-S", os.path.join(HERE, "launch.py"), cost.name]
        process = subprocess.Popen(launcher + command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
                                   **options)
        try:
            status = process.wait(limit)
        except subprocess.TimeoutExpired:
            raise RuntimeError(f"not done after {limit:g} s") from None
        finally:
            if process.returncode is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        if status != 0:
            raise RuntimeError(f"status {status}: {last_line(log)}")
        return Usage(**json.load(cost))


def cpu_seconds(command, **options):
    """User + system seconds of a process and of those it waits for; its peak memory in MB."""
    usage = usage_of(command, **options)
    return usage.cpu, usage.megabytes


def model(name):
    """A real model where they are at hand, else the sample that stands for it."""
    path = os.path.join(MESHES, name + ".ply")
    samples = {"joint": "cad_part", "foot": "bumpy", "bunny_scan": "bust", "igea": "bumpy"}
    return path if os.path.exists(path) else os.path.join(ROOT, "sample_meshes", samples.get(name, name) + ".ply")


def cases(names=None):
    """(model, vertices) of the models at hand, or of those of them that are named."""
    return [case for case in (MODELS if os.path.isdir(MESHES) else SAMPLES) if not names or case[0] in names]


def models_asked_for(text, names):
    """Those of the names that the command line asks for, all without; `text`: the script's help."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", nargs="+", choices=names, default=names, metavar="MODEL",
                        help="only these, if at hand, of: " + ", ".join(names))
    return parser.parse_args().models


def measure(*files, samples=None):
    """What measure_mesh prints of one mesh, or of a result against its original by that many samples."""
    extra = [str(samples)] if samples else []
    done = subprocess.run([MEASURE, *files, *extra], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError("the result cannot be measured: " + done.stderr.strip().replace(ROOT + os.sep, ""))
    return json.loads(done.stdout)


def machine():
    cpu = re.search(r"model name\s*: (.*)", open("/proc/cpuinfo", encoding="utf-8").read())
    return {"cpu": cpu[1] if cpu else platform.machine(), "cores": os.cpu_count(),
            "system": platform.freedesktop_os_release()["PRETTY_NAME"]}


def engine():
    """A name for the engine as it is: pages that name the same one are of the same results."""
    digest = hashlib.sha256()
    for top, folders, names in os.walk(os.path.join(ROOT, "vcg_ext", "vcg")):
        folders.sort()
        for name in sorted(names):
            digest.update(name.encode())
            with open(os.path.join(top, name), "rb") as source:
                digest.update(source.read())
    return digest.hexdigest()[:8]


def provenance(command):
    """When, where, with what and how figures were made."""
    return {"command": command, "date": datetime.date.today().isoformat(), "machine": machine(), "engine": engine()}


def busy_seconds():
    """What all processes of the machine have used since it started."""
    with open("/proc/stat", encoding="ascii") as text:
        user, nice, system, _, _, *interrupts = (int(x) for x in text.readline().split()[1:9])
    return (user + nice + system + sum(interrupts)) / os.sysconf("SC_CLK_TCK")


def undisturbed(run, repeats):
    """The run with the least wall time, and how many cores others kept busy meanwhile."""
    rows = []
    for _ in range(repeats):
        before = busy_seconds()
        usage = run()
        rows.append({**usage._asdict(), "others": max(0, busy_seconds() - before - usage.cpu) / usage.wall})
    return min(rows, key=lambda row: row["wall"])


def write_figures(name, data):
    """Keeps what was measured, in build/bench."""
    os.makedirs(OUT, exist_ok=True)
    with open(os.path.join(OUT, name), "w", encoding="utf-8") as out:
        json.dump(data, out, indent=1)


def put_between(path, begin, end, lines):
    """Replaces what a page has between two marks."""
    with open(path, encoding="utf-8") as text:
        before, rest = text.read().split(begin)
    with open(path, "w", encoding="utf-8") as out:
        out.write(before + "\n".join([begin, "", *lines, "", end]) + rest.split(end)[1])


def count_vertices(path):
    head = open(path, "rb").read(2000).decode("latin1")
    return int(head.split("element vertex ")[1].split()[0])
