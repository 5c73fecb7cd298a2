# SPDX-License-Identifier: GPL-3.0-or-later
"""A progress bar in plain text; silent where nobody watches."""

import shutil
import sys
import time
from typing import Callable, Dict, Optional, TextIO

_BAR = 24


class Progress:
    """Counts finished meshes by status and draws a line, at most ten times a second."""

    def __init__(
        self,
        total: int,
        stream: Optional[TextIO] = None,
        quiet: bool = False,
        clock: Callable[[], float] = time.monotonic,
    ):
        self._stream = sys.stderr if stream is None else stream
        self._shown = not quiet and self._stream.isatty()
        self._clock = clock
        self._total = total
        self._counts: Dict[str, int] = {}
        self._start = clock()
        self._drawn: Optional[float] = None

    def add(self, status: str) -> None:
        """One more mesh is finished."""
        self._counts[status] = self._counts.get(status, 0) + 1
        self.draw()

    def draw(self, force: bool = False) -> None:
        """The line as it is now."""
        now = self._clock()
        if not self._shown or (not force and self._drawn is not None and now - self._drawn < 0.1):
            return
        self._drawn = now
        width = shutil.get_terminal_size().columns - 1
        self._stream.write("\r" + self.line()[:width].ljust(width))
        self._stream.flush()

    def close(self) -> None:
        """Draws the last state and leaves the line."""
        if self._shown:
            self.draw(force=True)
            self._stream.write("\n")
            self._stream.flush()

    def line(self) -> str:
        """For example `[######------] 2/4  done 1  failed 1  0:12, about 0:12 left`."""
        finished = sum(self._counts.values())
        full = _BAR * finished // self._total if self._total else _BAR
        counts = "".join(f"  {name} {self._counts[name]}" for name in sorted(self._counts))
        passed = self._clock() - self._start
        # What was kept took no time.
        worked = finished - self._counts.get("kept", 0)
        left = passed / worked * (self._total - finished) if worked else None
        times = _clock_text(passed) + (f", about {_clock_text(left)} left" if left else "")
        return f"[{'#' * full}{'-' * (_BAR - full)}] {finished}/{self._total}{counts}  {times}"


def _clock_text(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
