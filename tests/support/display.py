# SPDX-License-Identifier: GPL-3.0-or-later
"""One X server for all programs that a test process starts: xvfb-run makes one for each, and now and then fails to
clear it away."""
import atexit
import functools
import os
import subprocess


def environment():
    """The variables of a program that needs a display."""
    return {**os.environ, "DISPLAY": _display()}


@functools.lru_cache(maxsize=None)
def _display():
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
                              pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    atexit.register(_end, server)
    with os.fdopen(read) as number:
        name = number.readline().strip()
    if not name:
        raise RuntimeError("Xvfb did not start")
    return f":{name}"


def _end(server):
    server.terminate()
    server.wait()
