# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that hang, engines that crash, workers that die, a scheduler by its address."""

import os
import pty
import signal
import subprocess
import threading
import time

import plyfile

from conftest import local_cluster
from test_restart import below, ended, sleepers, statuses, wait_for

BUMPY = plyfile.grid(12, height=0.02)


def test_hanging_input_is_ended(batch):
    """A named pipe that nobody writes to: reading it never ends."""
    os.mkfifo(batch.inputs / "pipe.ply")
    plyfile.write_ply(batch.inputs / "sheet.ply", *BUMPY)
    begin = time.monotonic()
    run = batch("--time-limit", 3, "--retries", 1, expect=3)
    assert time.monotonic() - begin < 60
    assert "pipe.ply: it took longer than the limit of 3 s" in run.stderr
    assert statuses(batch) == {"pipe.ply": "failed", "sheet.ply": "done"}
    assert (batch.rows()["pipe.ply"]["kind"], batch.rows()["pipe.ply"]["attempts"]) == ("timeout", "2")


def test_hanging_engine_is_ended(batch, stand_in):
    """An engine that hangs for one mesh and has written half of its output; nothing of it is seen."""
    for name in ("hangs", "sheet"):
        plyfile.write_ply(batch.inputs / f"{name}.ply", *BUMPY)
    this_one = "cmp -s \"$1\" '%s'" % (batch.inputs / "hangs.ply")
    plyfile.write_ply(batch.inputs / "sheet.ply", *plyfile.grid(10))
    run = batch.start(
        "--time-limit",
        4,
        "--retries",
        0,
        workers=1,
        program=stand_in(f'if {this_one}; then echo half >"$2"; exec sleep 1000; fi'),
    )
    wait_for(lambda: sleepers(run.pid))
    engines = sleepers(run.pid)
    seen = set()
    while run.poll() is None:
        seen.update(path.name for path in batch.output.rglob("*hangs*"))
        time.sleep(0.05)
    assert run.returncode == 3, run.communicate()
    run.communicate()
    assert statuses(batch) == {"hangs.ply": "failed", "sheet.ply": "done"}
    assert not seen and all(map(ended, engines))


def test_crash_is_tried_again(batch, stand_in):
    for name in "ab":
        plyfile.write_ply(batch.inputs / f"{name}.ply", *BUMPY)
    once = batch.folder / "once"
    batch(program=stand_in(f'if [ ! -e "{once}" ]; then touch "{once}"; kill -SEGV $$; fi'))
    assert sorted(row["attempts"] for row in batch.rows().values()) == ["1", "2"]
    batch("--seed", 3, "--retries", 2, program=stand_in("kill -SEGV $$"), expect=3)
    row = batch.rows()["a.ply"]
    assert (row["kind"], row["attempts"]) == ("crash", "3") and "SIGSEGV" in row["reason"]


def test_outputs_are_seen_complete_only(batch):
    """Whoever looks at the folder during the run sees complete meshes, under no other name."""
    for k in range(6):
        plyfile.write_ply(batch.inputs / f"{k}.ply", *BUMPY)
    run = batch.start(target=("--vertices", 1000), workers=2)
    sizes = {}
    while run.poll() is None:
        for path in batch.output.glob("*.ply"):
            sizes.setdefault(path.name, set()).add(path.stat().st_size)
    assert run.returncode == 0, run.communicate()
    run.communicate()
    assert len(sizes) == 6
    for name, seen in sizes.items():
        assert seen == {(batch.output / name).stat().st_size} and not name.startswith(".")
    assert batch.files() == sorted(n for k in range(6) for n in (f"{k}.ply", f"{k}.ply.json"))


def workers_of(pid):
    """The Dask worker processes below a process."""
    return below(pid, lambda process: "spawn_main" in " ".join(process.cmdline()))


def test_killed_worker(batch, stand_in):
    """kill -9 of the worker that has a mesh in work: the mesh is done again, the result is complete."""
    for k in range(6):
        plyfile.write_ply(batch.inputs / f"{k}.ply", *BUMPY)
    once = batch.folder / "once"
    program = stand_in(f'if mkdir "{once}" 2>/dev/null; then exec sleep 1000; fi')
    run = batch.start("--time-limit", 120, program=program, workers=2)
    wait_for(lambda: sleepers(run.pid))
    engines = sleepers(run.pid)
    (worker,) = [p for p in workers_of(run.pid) if engines[0] in p.children(recursive=True)]
    os.kill(worker.pid, signal.SIGKILL)
    output, errors = run.communicate(timeout=100)
    assert run.returncode == 0, (output, errors)
    assert "6 meshes: 6 done" in output and errors == ""
    # Its engine did not outlive it, and the attempt that was lost is counted.
    assert all(map(ended, engines))
    assert sorted(row["attempts"] for row in batch.rows().values()) == ["1"] * 5 + ["2"]
    assert len(batch.files()) == 12


def test_scheduler_by_address(batch, stand_in):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    address = ["--scheduler", batch.scheduler]
    batch(*address)
    assert statuses(batch) == {"a.ply": "done"}

    # The command is killed, the cluster lives on: the engine of the mesh in work is ended all the same.
    run = batch.start(*address, "--seed", 2, program=stand_in("exec sleep 1000"))
    wait_for(lambda: sleepers(os.getpid()))
    run.send_signal(signal.SIGKILL)
    run.communicate()
    wait_for(lambda: not sleepers(os.getpid()))
    batch(*address, "--seed", 2)
    assert statuses(batch) == {"a.ply": "done"}


def test_lost_workers(batch, stand_in):
    """Every worker goes away and none comes back: the run ends and says so."""
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    with local_cluster() as made:
        address = ["--scheduler", made.scheduler_address]
        run = batch.start(*address, "--wait", 2, program=stand_in("exec sleep 1000"))
        wait_for(lambda: sleepers(os.getpid()))
        made.scale(0)
        output, _ = run.communicate(timeout=60)
    assert run.returncode == 3 and "1 failed" in output
    assert batch.rows()["a.ply"]["kind"] == "worker"


def test_progress_bar_on_a_terminal_only(batch):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    assert batch(workers=1).stderr == ""
    main, side = pty.openpty()
    line = batch.arguments("--seed", 2)
    run = subprocess.Popen(line, stderr=side, stdout=subprocess.PIPE, env=batch.environment)
    os.close(side)
    text = bytearray()

    def read():
        try:
            while block := os.read(main, 4096):
                text.extend(block)
        except OSError:
            pass  # the other side is closed

    reader = threading.Thread(target=read)
    reader.start()
    run.communicate(timeout=60)
    reader.join(10)
    os.close(main)
    assert b"\r[########################] 1/1  done 1  0:0" in text
