"""Lets time run: frame by frame at the clip's rate times the speed, in a loop, there and back, or once."""

from __future__ import annotations

import time
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, QTimer

from genmojo_studio.state import AppState

MODES = ("loop", "ping-pong", "once")
SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
_TICK_MS = 8


class Player(QObject):
    """Moves the shared frame while `state.playing` and the workspace is on show."""

    def __init__(self, state: AppState, on_show: Callable[[], bool], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.mode = MODES[0]
        self.fps = 24.0
        self._state = state
        self._on_show = on_show
        self._direction = 1
        self._due = 0.0
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(_TICK_MS)
        self._timer.timeout.connect(self._tick)
        state.subscribe(self._follow, "playing", "speed")

    def toggle(self) -> None:
        """Plays or pauses; at the end of a clip that is played once it begins anew."""
        state = self._state
        if not state.playing and self.mode == "once" and state.frame == state.frame_count - 1:
            state.set(frame=0)
        state.set(playing=not state.playing and state.frame_count > 1)

    def step(self, frames: int) -> None:
        """Pauses and goes on by frames, round the end."""
        self._state.set(playing=False)
        self._state.set(frame=(self._state.frame + frames) % self._state.frame_count)

    def change_speed(self, by: int) -> None:
        """One of the usual speeds faster (+1) or slower (-1)."""
        nearest = min(range(len(SPEEDS)), key=lambda i: abs(SPEEDS[i] - self._state.speed))
        self._state.set(speed=SPEEDS[min(max(nearest + by, 0), len(SPEEDS) - 1)])

    def _follow(self) -> None:
        if self._state.playing:
            self._due = time.monotonic() + self._period()
            self._timer.start()
        else:
            self._timer.stop()

    def _tick(self) -> None:
        now = time.monotonic()
        if now < self._due or not self._on_show():
            return
        passed = 1 + int((now - self._due) / self._period())  # frames that a busy machine missed are left out
        self._due += passed * self._period()
        if now - self._due > 1.0:
            self._due = now + self._period()
        frame, self._direction, ended = following(
            self._state.frame, passed, self._state.frame_count, self.mode, self._direction
        )
        self._state.set(frame=frame)
        if ended:
            self._state.set(playing=False)

    def _period(self) -> float:
        return 1.0 / max(self.fps * self._state.speed, 0.01)


def following(frame: int, passed: int, count: int, mode: str, direction: int) -> tuple[int, int, bool]:
    """(frame, direction, ended) after `passed` frames of a clip of `count`, played as `mode` says."""
    if count < 2:
        return 0, direction, True
    if mode == "loop":
        return (frame + passed) % count, 1, False
    if mode == "once":
        return min(frame + passed, count - 1), 1, frame + passed >= count - 1
    period = 2 * (count - 1)  # 0 1 2 3 2 1 | 0 ...
    place = frame if direction > 0 else period - frame
    place = (place + passed) % period
    return (place, 1, False) if place < count - 1 else (period - place, -1, False)
