# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that are sure to end: by the time limit, or with the process that started them."""

import os
import signal
import subprocess
import sys
import time
from typing import Callable, Optional

_PR_SET_PDEATHSIG = 1
_libc = None
if sys.platform == "linux":
    import ctypes

    # Loaded here, because little may be done between fork and exec.
    _libc = ctypes.CDLL(None)


def end_with_parent(seconds: float) -> None:
    """Makes this process end when its parent does (Linux), and after `seconds` in any case (POSIX).

    The kernel sees to both, so that it works while native code holds the interpreter; the alarm outlives
    an exec.
    """
    if _libc is not None:
        _libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, seconds)


def kill_group(process: "subprocess.Popen[bytes]") -> None:
    """Ends a process that was started with start_new_session, and all that it started."""
    try:
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    except ProcessLookupError:
        pass
    try:
        process.wait(10)
    except subprocess.TimeoutExpired:
        pass  # stuck in the kernel, in a dead mount for example; it ends when that call does


def wait_or_kill(
    process: "subprocess.Popen[bytes]", seconds: float, wanted: Callable[[], bool]
) -> Optional[int]:
    """The exit status; None when the process had to be ended, by the limit or as no longer wanted."""
    deadline = time.monotonic() + seconds
    try:
        while True:
            try:
                return process.wait(max(0.0, min(0.25, deadline - time.monotonic())))
            except subprocess.TimeoutExpired:
                if time.monotonic() >= deadline or not wanted():
                    return None
    finally:
        kill_group(process)
