# SPDX-License-Identifier: GPL-3.0-or-later
"""One X server for all programs that a process starts: xvfb-run makes one for each, and now and then fails to clear it
away. And how servers of that kind are started."""
import atexit
import ctypes
import functools
import os
import select
import signal
import subprocess


def environment():
    """The variables of a program that needs a display."""
    return {**os.environ, "DISPLAY": _display()}


def first_line(command, start):
    """Of what prints a line to the file descriptor that stands for {fd} once it is ready; empty if it ended before.

    start(command, pass_fds) starts it."""
    reading, writing = os.pipe()
    try:
        start([word.replace("{fd}", str(writing)) for word in command], (writing,))
    finally:
        os.close(writing)
    with os.fdopen(reading) as pipe:
        if not select.select([pipe], [], [], 20)[0]:
            raise TimeoutError(f"{command[0]} does not start")
        return pipe.readline().strip()


def x_server(width, height):
    """The command for first_line, which is the number of the display then."""
    return ["Xvfb", "-displayfd", "{fd}", "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", "-noreset"]


def die_with_parent():
    """For the child's side of a start: it ends even when its parent is killed."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


@functools.lru_cache(maxsize=None)
def _display():
    def start(command, pass_fds):
        server = subprocess.Popen(command, pass_fds=pass_fds, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, preexec_fn=die_with_parent)
        atexit.register(_end, server)
    number = first_line(x_server(1280, 1024), start)
    if not number:
        raise RuntimeError("Xvfb did not start")
    return f":{number}"


def _end(server):
    server.terminate()
    server.wait()
