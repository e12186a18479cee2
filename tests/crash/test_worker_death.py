"""Whatever ends the worker: the window lives, knows why, and the run can go on. How soon it knows is measured by
tests/benchmarks/deaths.py."""

from __future__ import annotations

import os
import signal
import sys
import time

import pytest

from genmojo_studio.worker import death, runs
from tests.worker.driving import fake_request, watched

pytestmark = pytest.mark.skipif(os.name == "nt", reason="POSIX signals")


@pytest.fixture(autouse=True)
def _own_runs(tmp_path, monkeypatch):
    monkeypatch.setenv("GENMOJO_RUNS", str(tmp_path / "runs"))


def end_and_resume(run_dir, fault, at):
    """Run until a fault at a step, then resume to the end; the report and how many seconds after the fault it came.

    Kills come from outside at that step.
    """
    inside = fault if fault not in ("killed", "shot") else ""
    options = {"steps": 60, "lift": 30, "step_seconds": 0.004, "fault": inside, "at": at}
    options |= {} if inside else {"endless": 1}  # however late the kill comes
    with watched() as window:
        window.client.start(fake_request(run_dir, **options))
        if not inside:
            window.until(lambda: window.steps() >= at)
            os.kill(window.client._process.pid, signal.SIGKILL if fault == "killed" else signal.SIGSEGV)
        at_fault = time.time()
        window.until(lambda: window.reports)
        known = time.time()
        (report,) = window.reports
        if (run_dir / runs.EXIT).exists():
            at_fault = (run_dir / runs.EXIT).stat().st_mtime
        assert window.client.state == "failed" and report.final
        assert report.step == window.steps() and (report.step == at if inside else report.step >= at)
        assert report.title and report.advice and not window.client._line.is_open
        assert report.checkpoint == (run_dir / "checkpoint.json").exists()
        steps_before = window.steps()
        if report.checkpoint:
            window.client.resume_run(run_dir)
            window.until_state("done")
            after = [e for e in window.events if e["event"] == "Step"][steps_before:]
            assert after and len(after) >= 60 - steps_before and (run_dir / "scene.h5").exists()
    return report, known - at_fault


KINDS = {"killed": "killed", "shot": "segfault", "segfault": "segfault", "memory": "memory", "exception": "exception",
         "allocate": "memory",
         "input": "input", "exit": "exception"}  # fmt: skip


@pytest.mark.parametrize("fault", [
    pytest.param(fault, marks=pytest.mark.skipif(fault == "allocate" and sys.platform != "linux", reason="RLIMIT_AS"))
    for fault in KINDS
])  # fmt: skip
def test_each_end_is_named(tmp_path, fault):
    report, _ = end_and_resume(tmp_path, fault, 15)
    assert report.kind == KINDS[fault]
    if fault == "allocate":  # the system refused, nobody raised it by hand
        assert "Unable to allocate" in report.detail
    if fault == "exception":
        assert "ZeroDivisionError" in report.title and "_spoil" in report.detail
    if fault in ("shot", "segfault"):
        assert "SIGSEGV" in report.title and "Segmentation fault" in report.detail


def test_death_while_loading_is_named_too(tmp_path):
    """Before it could say a word: a program that is not there, and one that is killed at once."""
    with watched(["/bin/sh", "-c", "echo cannot find torch >&2; exit 7"]) as window:
        window.client.start(fake_request(tmp_path))
        window.until(lambda: window.reports)
        assert window.reports[0].kind == "start" and "cannot find torch" in window.reports[0].detail


def test_a_stopped_worker_is_named_and_may_come_back(tmp_path):
    """SIGSTOP: after 5 s of missed heartbeats it counts as lost; woken again it goes on."""
    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=100_000))
        window.until(lambda: window.steps() > 3)
        pid = window.client._process.pid
        os.kill(pid, signal.SIGSTOP)
        took = window.until_state("lost")
        assert took > 4.0
        (report,) = window.reports
        assert report.kind == "hang" and not report.final and "Wait" in report.advice
        os.kill(pid, signal.SIGCONT)
        window.until_state("running")
        assert window.answer(window.client.pause()) == (True, "paused")


def test_an_announced_compile_is_no_hang(tmp_path):
    """Seven seconds of a compiler holding the interpreter, announced: nobody calls it lost."""
    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=40, fault="compile", at=5))
        window.until_state("done")
        assert not window.reports and "lost" not in window.states


def test_a_hung_worker_can_be_ended_and_resumed(tmp_path):
    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=60, fault="hang", at=15))
        window.until_state("lost")
        window.client.kill()
        window.until_state("failed")
        assert [r.kind for r in window.reports] == ["hang", "killed"] and window.reports[1].checkpoint
        window.client.resume_run(tmp_path)
        window.until_state("done")


def test_a_kill_when_memory_was_short_is_called_that(tmp_path):
    beat = {"rss_mb": 7000.0, "available_mb": 200.0, "total_mb": 8000.0, "step": 12}
    report = death.classify(tmp_path, -9, beat, True, 1)
    assert report.kind == "memory" and "6.8 GB" in report.title and "draft" in report.advice and report.step == 12
    assert death.classify(tmp_path, -9, {**beat, "available_mb": 4000.0}, True, 1).kind == "killed"
    (tmp_path / "fault.log").write_text("Fatal Python error: Segmentation fault")
    assert death.classify(tmp_path, None, {}, True, 1).kind == "segfault"  # another window's child: only the log tells


def test_an_end_before_the_window_could_listen_is_no_failed_start(tmp_path):
    """The worker took the run's lock, worked and ended between two looks of the window."""
    assert death.classify(tmp_path, 3, {}, False, 7).kind == "start"
    (tmp_path / runs.LOCK).write_text('{"pid": 7}')
    assert death.classify(tmp_path, 3, {}, False, 7).kind == "exception"
    assert death.classify(tmp_path, 3, {}, False, 8).kind == "start"  # the lock is an earlier worker's
