"""What a person's corrections teach about the signals of suspicion, kept with the project."""

from __future__ import annotations

import time

from genmojo_core.store.project import Project
from genmojo_core.store.safe import json_text, parse_json
from genmojo_core.tracks.suspicion import Calibration, Suspicion

_NAME = "calibration"  # blob
_SECONDS = 30.0  # between two times of storing: all places that were judged are written each time


class Learnt:
    """The calibration of one project."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._new = False  # since it was stored
        self._stored = time.monotonic()
        self.calibration = Calibration()
        blob = project.blob(_NAME)
        if blob is not None:
            self.calibration.put_rows(parse_json(blob, _NAME))

    def learn(self, track: int, frame: int, suspicion: Suspicion, *, corrected: bool) -> None:
        """A person judged a place."""
        self.calibration.learn(track, frame, suspicion, corrected)
        self._new = True

    def keep(self, *, now: bool = False) -> None:
        """Into the project, if there is anything new; at once or every half minute."""
        due = now or time.monotonic() - self._stored >= _SECONDS
        if self._new and due and not self._project.read_only:
            self._new, self._stored = False, time.monotonic()
            self._project.put_blob(_NAME, json_text(self.calibration.rows()).encode())
