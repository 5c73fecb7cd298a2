#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""launch.py COST COMMAND...: runs a command and writes what it cost to the file COST, as JSON.

Linux counts the memory of the process that starts another towards the peak of the one started. So this one,
which imports next to nothing, stands between a benchmark with its libraries and what it measures; about 7 MB
are the least that it can tell.
"""
import json
import os
import sys
import time


def main():
    start = time.monotonic()
    child = os.fork()
    if child == 0:
        try:
            os.execvp(sys.argv[2], sys.argv[2:])
        except OSError as fault:
            print(f"{sys.argv[2]}: {fault.strerror}", file=sys.stderr, flush=True)
            os._exit(127)
    _, status, usage = os.wait4(child, 0)
    with open(sys.argv[1], "w", encoding="ascii") as out:
        json.dump({"cpu": usage.ru_utime + usage.ru_stime, "wall": time.monotonic() - start,
                   "megabytes": usage.ru_maxrss / 1024}, out)
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main())
