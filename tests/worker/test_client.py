"""A window and a worker together: states from acks, pausing and stepping, parameters, going away and coming back."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QTimer

from genmojo_core.errors import GenmojoError
from genmojo_studio.worker import runs
from tests.worker.driving import FAKE, Watched, fake_request, watched

ROOT = Path(__file__).resolve().parents[2]


def test_a_run_from_start_to_scene(tmp_path):
    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=40))
        window.until_state("done")
        assert [s for s in window.states if s != "ready"] == ["starting", "running", "finishing", "done"]
        assert window.steps() == 40 and window.events[-1]["event"] == "SceneWritten"
        last = window.snapshots[-1]
        assert last.step == 40 and last.T == 4 and last.objects[0].name == "one" and last.cameras.size == (128, 96)
        assert (tmp_path / "scene.h5").exists() and not window.reports and runs.live_runs() == []


def test_the_next_run_begins_while_the_last_worker_leaves(tmp_path):
    """A person who starts anew at once is not told that a run is going on: the last one has said that it is done."""
    with watched() as window:
        window.client.start(fake_request(tmp_path / "first", steps=20))
        begun = []

        def again(state):
            if state == "done" and not begun:
                begun.append(True)  # within the next moment, so that the last process still lives
                QTimer.singleShot(0, lambda: window.client.start(fake_request(tmp_path / "second", steps=30)))

        window.client.state_changed.connect(again)
        window.until(lambda: (tmp_path / "second" / "scene.h5").exists() and window.client.state == "done")
        assert (tmp_path / "first" / "scene.h5").exists() and (tmp_path / "second" / "scene.h5").exists()
        assert not window.reports
        assert not list((tmp_path / "first").glob("*.bus"))


def test_pause_step_and_stage(tmp_path):
    """Acknowledged within a step; n steps are n steps; a pause makes none; the next stage begins paused."""
    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=100_000, lift=100, step_seconds=0.01))
        window.until(lambda: window.steps() >= 5)
        assert window.answer(window.client.pause()) == (True, "paused")
        assert window.client.state == "paused"
        stood, begun = window.steps(), time.monotonic()
        window.until(lambda: time.monotonic() - begun > 0.6)
        assert window.steps() == stood
        for n in (1, 3):
            before = window.steps()
            window.answer(window.client.step(n))
            window.until_state("paused")
            assert window.steps() == before + n
        window.answer(window.client.run_to_next_stage())
        window.until(lambda: window.client.state == "paused")
        assert window.events[-1]["event"] == "StageStarted" and window.events[-1]["stage"] == "joint"
        assert window.steps() == 100
        window.answer(window.client.resume())
        assert window.client.state == "running"
        window.answer(window.client.stop(keep=True))
        window.until_state("done")
        assert window.events[-1]["event"] == "SceneWritten" and window.steps() < 100_000


def test_starting_paused_waits_before_the_first_step(tmp_path):
    from dataclasses import replace

    with watched() as window:
        window.client.start(replace(fake_request(tmp_path), paused=True))
        window.until_state("paused")
        window.until(lambda: window.snapshots)
        assert window.steps() == 0


def test_parameters_checkpoints_and_refusals(tmp_path):
    with watched() as window:
        number = window.client.set_parameter("rates.means", 0.5)  # before the worker listens: kept until it does
        assert window.answer(number) == (False, "There is no run.")
        window.client.start(fake_request(tmp_path, steps=5000))
        number = window.client.set_parameter("rates.means", 0.5)
        window.until(lambda: window.steps() > 0)
        assert window.answer(number)[0] in (True, False)  # it may have come before there was a run
        assert window.answer(window.client.set_parameter("rates.means", 0.25)) == (True, 0.25)
        ok, sentence = window.answer(window.client.set_parameter("seed", 1))
        assert not ok and "cannot be changed" in sentence
        ok, sentence = window.answer(window.client.set_parameter("rates.means", "fast"))
        assert not ok and "cannot be" in sentence
        assert window.answer(window.client.checkpoint())[0]
        assert window.answer(window.client.write_scene(str(tmp_path / "now.h5")))[0]
        window.until(lambda: any(e["event"] == "SceneWritten" for e in window.events))
        assert (tmp_path / "now.h5").exists()
        changed = [e for e in window.events if e["event"] == "ParameterChanged"]
        assert changed[-1]["new"] == 0.25 and changed[-1]["name"] == "rates.means"
        ok, sentence = window.answer(window.client._command("open", {"path": "x"}))
        assert not ok and "no command" in sentence
        window.answer(window.client.stop(keep=False))
        window.until_state("done")
        assert not (tmp_path / "scene.h5").exists()


def test_the_frame_asked_for_is_shown_and_a_sweep_brings_all(tmp_path):
    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=5000, frames=6))
        window.until(lambda: window.snapshots and window.steps() > 1)
        window.answer(window.client.pause())
        window.answer(window.client.look(5))
        window.until(lambda: window.snapshots[-1].frame == 5)
        window.answer(window.client.sweep())
        window.until(lambda: window.snapshots[-1].frames is not None)
        shown = window.snapshots[-1]
        assert len(shown.frames) == 6
        moved = shown.at(3).positions - shown.at(0).positions
        np.testing.assert_allclose(moved[:150], np.tile([0.3, 0, 0], (150, 1)), atol=1e-5)
        assert np.abs(moved[150:]).max() == 0 and shown.at(5).positions.shape == shown.positions.shape
        window.answer(window.client.set_view("off"))
        window.answer(window.client.resume())
        count = len(window.snapshots)
        window.until(lambda: window.steps() > 60)
        assert len(window.snapshots) == count
        window.answer(window.client.stop())
        window.until_state("done")
        assert len(window.snapshots) > count  # the end is shown even so


def test_a_window_that_was_closed_finds_its_run(tmp_path):
    """The run goes on alone; another window finds it, hears everything once, and sees it."""
    run_dir = tmp_path / "run"
    run_dir.mkdir()
    with watched() as first:
        first.client.start(fake_request(run_dir, steps=3000))
        first.until(lambda: first.steps() > 3)
        first.client.detach()
        with watched() as second:
            (found,) = runs.live_runs()
            assert (found.run_dir, found.clip) == (str(run_dir.resolve()), "clip")
            second.client.attach(found.run_dir)
            second.until(lambda: second.steps() > 50 and second.snapshots)
            steps = [e["step"] for e in second.events if e["event"] == "Step"]
            assert steps == list(range(1, len(steps) + 1)) and second.client.state == "running"
            with pytest.raises(GenmojoError):
                Watched(FAKE).client.start(fake_request(run_dir))
            second.answer(second.client.stop())
            second.until_state("done")
        with pytest.raises(GenmojoError):
            first.client.attach(run_dir)


STARTER = """
import sys, time
from pathlib import Path
from tests.worker.driving import fake_request, Watched, FAKE
window = Watched(FAKE)
window.client.start(fake_request(Path(sys.argv[1]), steps=3000))
window.until(lambda: window.steps() > 3)
sys.stdout.write("running\\n"); sys.stdout.flush()
time.sleep(60)
"""


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_a_window_that_was_killed_leaves_its_run_alive(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        [sys.executable, "-c", STARTER, str(tmp_path)], stdout=subprocess.PIPE, env=environment
    ) as child:
        assert child.stdout.readline() == b"running\n"
        child.send_signal(signal.SIGKILL)
    with watched() as window:
        window.client.attach(tmp_path)
        window.until(lambda: window.client.state == "running")
        before = window.steps()
        window.until(lambda: window.steps() > before + 20)


def test_events_that_got_lost_on_the_way_are_read_from_their_file(tmp_path):
    """A worker short of memory drops messages; a window that hears of a later event tells the missing ones first."""
    window = Watched(FAKE)
    client = window.client
    client.run_dir = str(tmp_path)
    said = [{"event": "Step", "stage": "lift", "step": n} for n in range(1, 6)]
    (tmp_path / runs.EVENTS).write_text("".join(json.dumps(event) + "\n" for event in said))
    for n in (0, 3, 3, 4):
        client._on_event({"type": "event", "n": n, "event": said[n]})
    assert window.events == said
    assert runs.read_events(tmp_path, 3) == said[3:] and runs.read_events(tmp_path, 9) == []
    (tmp_path / runs.EVENTS).write_text("no JSON\n" * 5)  # what is known is not read again
    client._catch_up(None)
    assert window.events == said
    assert runs.steps_told(said) == 5
    resumed = [*said, {"event": "Step", "stage": "joint", "step": 1}, {"event": "Step", "stage": "lift", "step": 4}]
    assert runs.steps_told(resumed[:-1]) == 6 and runs.steps_told(resumed) == 4  # told again from a checkpoint


def test_the_line_outlives_a_shortage_of_memory():
    """Whatever fails for want of memory, its thread goes on and says what comes after."""
    import socket

    from genmojo_studio.worker.link import Link
    from genmojo_studio.worker.protocol import VERSION, Decoder, encode

    heard, shortages = [], iter(range(3))

    def beat():
        if next(shortages, None) is not None:
            raise MemoryError
        return {"step": 1}

    with Link("token", dict, beat, heard.append) as link:
        kind, _, path = link.address.partition(":")
        if kind != "unix":
            pytest.skip("loopback socket")
        with socket.socket(socket.AF_UNIX) as line:
            line.connect(path)
            line.settimeout(60)
            line.sendall(encode({"type": "hello", "version": VERSION, "token": "token"}))
            decoder, said = Decoder(), []
            while not any(message["type"] == "beat" for message in said):
                said += decoder.feed(line.recv(1 << 16))
            assert said[0]["type"] == "hello" and next(shortages, None) is None


def test_two_windows_see_the_same_run(tmp_path):
    with watched() as one, watched() as two:
        one.client.start(fake_request(tmp_path, steps=5000))
        one.until(lambda: one.steps() > 2)
        two.client.attach(tmp_path)
        two.until_state("running")
        one.answer(one.client.pause())
        two.until_state("paused")
        two.answer(two.client.resume())
        one.until_state("running")
        two.client.detach()


def test_nobody_without_the_token_gets_in(tmp_path):
    """A connection that does not know the token, or talks nonsense, hears nothing and does no harm."""
    import socket

    with watched() as window:
        window.client.start(fake_request(tmp_path, steps=5000))
        window.until(lambda: window.steps() > 2)
        kind, _, path = runs.live_run(tmp_path).address.partition(":")
        if kind != "unix":
            pytest.skip("loopback socket")
        from genmojo_studio.worker.protocol import VERSION, encode

        wrong = encode({"type": "hello", "version": VERSION, "token": "guess"})
        for said in (
            wrong,
            b"GET / HTTP/1.1\r\n\r\n",
            encode({"type": "command", "id": 1, "name": "stop", "arguments": {}}),
        ):
            with socket.socket(socket.AF_UNIX) as stranger:
                stranger.connect(path)
                stranger.sendall(said)
                stranger.settimeout(0.5)
                with contextlib.suppress(TimeoutError):  # left waiting, told nothing
                    assert stranger.recv(100) == b""
        before = window.steps()
        window.until(lambda: window.steps() > before + 5)
        assert window.client.state == "running"


def test_client_and_protocol_import_no_torch():
    code = ("import sys, genmojo_studio.worker.client, genmojo_studio.worker.first_cloud, genmojo_studio.worker.host;"
            "sys.exit('torch was imported' if 'torch' in sys.modules else 0)")  # fmt: skip
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
