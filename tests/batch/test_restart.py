# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that is started again, or was killed: what is finished stays, nothing partial is seen."""

import contextlib
import json
import os
import signal
import time

import plyfile
import psutil

BUMPY = plyfile.grid(12, height=0.02)


def statuses(batch):
    return {name: row["status"] for name, row in batch.rows().items()}


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while not (found := condition()):
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.05)
    return found


def test_restart_skips_the_finished_and_redoes_the_changed(batch):
    for name in "abcd":
        plyfile.write_ply(batch.inputs / f"{name}.ply", *BUMPY)
    batch()
    first = {name: (batch.output / name).stat().st_mtime_ns for name in batch.files()}
    figures = batch.rows()["a.ply"]

    # b has other content, c is as it was but for its time, d's output is gone.
    plyfile.write_ply(batch.inputs / "b.ply", *plyfile.grid(12, height=0.03))
    os.utime(batch.inputs / "c.ply", (1, 1))
    (batch.output / "d.ply").unlink()
    batch()
    assert statuses(batch) == {"a.ply": "kept", "b.ply": "done", "c.ply": "kept", "d.ply": "done"}
    changed = {n for n in batch.files() if (batch.output / n).stat().st_mtime_ns != first[n]}
    assert changed == {"b.ply", "b.ply.json", "c.ply.json", "d.ply", "d.ply.json"}
    again = batch.rows()["a.ply"]
    assert {k: v for k, v in again.items() if k not in ("status", "attempts")} == {
        k: v for k, v in figures.items() if k not in ("status", "attempts", "seconds")
    } | {"seconds": again["seconds"]}

    # A damaged output of the same size is found by content only.
    damaged = bytearray((batch.output / "a.ply").read_bytes())
    damaged[-1] ^= 1
    (batch.output / "a.ply").write_bytes(damaged)
    batch("--verify")
    assert statuses(batch) == {"a.ply": "done", "b.ply": "kept", "c.ply": "kept", "d.ply": "kept"}

    # Without --verify an output that was changed is somebody's work.
    edited = (batch.output / "a.ply").read_bytes() + b"precious"
    (batch.output / "a.ply").write_bytes(edited)
    for options in ((), ("--seed", 2)):
        assert "a.ply' was changed after it was made" in batch(*options, expect=3).stderr
        assert statuses(batch)["a.ply"] == "failed" and batch.rows()["a.ply"]["kind"] == "name"
        assert (batch.output / "a.ply").read_bytes() == edited
    (batch.output / "a.ply").unlink()
    batch()

    # Other parameters: all of them.
    batch("--seed", 2)
    assert set(statuses(batch).values()) == {"done"}

    # An input that went bad: the older output stays, and the table says so.
    (batch.inputs / "a.ply").write_text("no mesh")
    assert "an older output was left in place" in batch("--seed", 2, expect=3).stderr
    assert (batch.output / "a.ply").exists()


def test_killed_between_output_and_record(batch):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    batch()
    record = json.loads((batch.output / "a.ply.json").read_text())
    record["state"] = "publishing"
    (batch.output / "a.ply.json").write_text(json.dumps(record))
    (batch.output / "a.ply").write_text("older")
    batch()
    assert statuses(batch) == {"a.ply": "done"}
    assert (batch.output / "a.ply").stat().st_size == record["output"]["size"]


def test_killed_run_is_taken_up(batch, stand_in):
    """The whole command is killed while the second mesh is in work; its processes end with it."""
    for name in "ab":
        plyfile.write_ply(batch.inputs / f"{name}.ply", *BUMPY)
    # The second one writes half of its output and hangs.
    once = batch.folder / "once"
    program = stand_in(f'if [ -e "{once}" ]; then echo half > "$2"; exec sleep 1000; fi; touch "{once}"')
    run = batch.start(program=program, workers=1)
    try:
        wait_for(lambda: (batch.output / "a.ply.json").exists())
        wait_for(lambda: sleepers(run.pid))
        engines = sleepers(run.pid)
    finally:
        os.kill(run.pid, signal.SIGKILL)
        run.communicate()
    wait_for(lambda: all(map(ended, engines)), 20)
    assert batch.files() == ["a.ply", "a.ply.json"]

    # What such a run can leave is removed when nobody can still be writing it.
    left = batch.output / ".b.ply.0.ccdm-part"
    left.write_text("half")
    os.utime(left, (1, 1))
    batch()
    assert statuses(batch) == {"a.ply": "kept", "b.ply": "done"}
    assert not left.exists()


def ended(process):
    """Whether it runs no more; nobody may have asked yet how it ended."""
    try:
        return not process.is_running() or process.status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


def sleepers(pid):
    """The hanging engines below a process."""
    return below(pid, lambda process: process.name() == "sleep")


def below(pid, wanted):
    """The processes below one for which `wanted` holds; any of them may end while it is looked at."""
    found = []
    for process in psutil.Process(pid).children(recursive=True):
        with contextlib.suppress(psutil.NoSuchProcess):
            if wanted(process):
                found.append(process)
    return found


def test_interrupted(batch, stand_in):
    plyfile.write_ply(batch.inputs / "a.ply", *BUMPY)
    run = batch.start(program=stand_in("exec sleep 1000"), workers=1)
    wait_for(lambda: sleepers(run.pid))
    engines = sleepers(run.pid)
    run.send_signal(signal.SIGINT)
    _, errors = run.communicate(timeout=60)
    assert run.returncode == 130 and "Traceback" not in errors, errors
    wait_for(lambda: all(map(ended, engines)), 20)
    assert statuses(batch) == {"a.ply": "not_run"} and batch.files() == []
