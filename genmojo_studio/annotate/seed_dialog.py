"""Before seeding: which tracker, which tracks, what it needs, what its licence says. While it runs: progress, cancel.

What a tracker finds is a proposal: places and states that a person gave are never overwritten.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QElapsedTimer, QTimer
from PySide6.QtWidgets import (
    QButtonGroup,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_core.store.npz import write_tracks
from genmojo_core.trackers import seeding
from genmojo_core.trackers.cotracker import window_seconds
from genmojo_core.tracks.supervision import said_by_people
from genmojo_studio.annotate import hand_masks
from genmojo_studio.annotate.scene_job import SUFFIX, Forecast, SceneJob
from genmojo_studio.annotate.seed_forecast import Speeds, foretold, so_far
from genmojo_studio.annotate.seed_options import CoTrackerOptions, PathLine
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.work import Work
from genmojo_studio.settings import Settings
from genmojo_studio.translate import decimal, fault, tr

MINUTES = (1, 2, 5, 10)


@dataclass(frozen=True)
class _Guess:
    """What a run of one kind of tracker ("" for none that is measured) is guessed to take, and for how many points."""

    kind: str
    seconds: float
    points: int


class SeedDialog(QDialog):
    """Asks, starts, shows how far it is; closing it while it runs cancels."""

    def __init__(self, session: Session, work: Work, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._work, self._settings = session, work, Settings()
        self._speeds, self._guessed = Speeds(self._settings), _Guess("", 0.0, 0)
        self.cotracker = CoTrackerOptions(self._settings)
        self.checkout, self.weights, self.consent = (
            self.cotracker.checkout, self.cotracker.weights, self.cotracker.consent)  # fmt: skip
        self.job: SceneJob | None = None
        self._expected = Forecast(0.0, 1.0)
        self.setWindowTitle(tr("Seed tracks"))
        self.setMinimumWidth(500)
        self._column = column = QVBoxLayout(self)
        self._trackers, self._scope = QButtonGroup(self), QButtonGroup(self)
        self.options: dict[str, QWidget] = {}
        for n, (title, about, make) in enumerate(self._choices()):
            self._add(column, n, (title, about), make())
        column.addSpacing(6)
        scope = QHBoxLayout()
        for n, title in enumerate((tr("all objects"), tr("the active object only"))):
            button = QRadioButton(title)
            button.setChecked(n == 0)
            self._scope.addButton(button, n)
            scope.addWidget(button)
        self.active_only = self._scope.button(1)
        scope.addStretch()
        column.addLayout(scope)
        self.forecast = QLabel(wordWrap=True)
        self.forecast.setProperty("role", "dim")
        column.addWidget(self.forecast)
        self.note = QLabel(tr("Your keys, accepted places and painted states stay as they are."), wordWrap=True)
        column.addWidget(self.note)
        self.progress = QProgressBar()
        self.progress.setMaximum(100)
        self.progress.hide()
        column.addWidget(self.progress)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.start = self.buttons.addButton(tr("Seed"), QDialogButtonBox.ButtonRole.ActionRole)
        self.start.setDefault(True)
        column.addWidget(self.buttons)
        self._connect(work)
        self._show_options(0)

    def _connect(self, work: Work) -> None:
        """What is chosen, done and told leads to what is shown."""
        self.start.clicked.connect(self._start)
        self.buttons.rejected.connect(self.reject)
        self._clock, self._tick, self._share = QElapsedTimer(), QTimer(self, interval=500), 0.0
        self._tick.timeout.connect(self._tell_time)
        self._trackers.idClicked.connect(self._show_options)
        for signal in (self._scope.idClicked, self.scene.changed, self.minutes.currentIndexChanged, self.file.changed,
                       self.cotracker.changed):  # fmt: skip
            signal.connect(self._foretell)
        work.clip_ready.connect(self._foretell)
        work.tracker.progressed.connect(self._progressed)
        work.tracker.seeded.connect(self._seeded)
        self._session.said.connect(self.note.setText)  # a window-modal dialog hides what the status line says

    def choice(self) -> str:
        """Name of the tracker chosen, one of `seeding.NAMES`."""
        return seeding.NAMES[self._trackers.checkedId()]

    def choose(self, name: str) -> None:
        """Tick a tracker."""
        self._trackers.button(seeding.NAMES.index(name)).setChecked(True)
        self._show_options(seeding.NAMES.index(name))

    def objects(self) -> list[int]:
        """Ids of the objects to seed."""
        return [o.id for o in self._session.objects()] if self._scope.checkedId() == 0 else [self._session.active[0]]

    def solve_from_scene(self) -> None:
        """Begin at once: optimise a scene for the time chosen last, and take its tracks."""
        self.choose("scene")
        self._start()

    def reject(self) -> None:
        """Close; what runs is cancelled."""
        self._work.tracker.cancel()
        if self.job is not None:
            self.job.cancel()
        super().reject()

    # ---- what is asked

    def _choices(self) -> list[tuple[str, str, Callable[[], QWidget]]]:
        """Title, explanation and options of every tracker, in the order of `seeding.NAMES`."""
        return [
            (tr("Optical (built in)"), tr("Follows the points inside their masks by flow and matching, from both ends "
             "between your keys."), QWidget),
            (tr("Solve from scene"), tr("Optimises a 4D scene that follows what you placed so far and takes its "
             "tracks, which go on behind what hides them."), self._scene_options),
            (tr("CoTracker (yours)"), tr("A checkout and weights that you have. CC BY-NC 4.0: no commercial use. It "
             "runs in a process of its own."), lambda: self.cotracker),
            (tr("From a file"), tr("Tracks of this clip that somebody made before: TAP-Vid, CoTracker or ours (npz)."),
             self._file_options),
        ]  # fmt: skip

    def _add(self, column: QVBoxLayout, n: int, texts: tuple[str, str], options: QWidget) -> None:
        button = QRadioButton(texts[0])
        button.setChecked(n == 0)
        self._trackers.addButton(button, n)
        column.addWidget(button)
        label = QLabel(texts[1], wordWrap=True)
        label.setProperty("role", "dim")
        label.setContentsMargins(24, 0, 0, 2)
        column.addWidget(label)
        options.setContentsMargins(24, 0, 0, 4)
        self.options[seeding.NAMES[n]] = options
        column.addWidget(options)

    def _scene_options(self) -> QWidget:
        inside = QWidget()
        form = QFormLayout(inside)
        self.minutes = QComboBox()
        for minutes in MINUTES:
            ready = decimal(self._forecast(60.0 * minutes).whole / 60, ".1f")
            self.minutes.addItem(
                tr("{n} min of optimising, ready in about {m} min").format(n=minutes, m=ready), minutes
            )
        for title, path in self._scenes_there():
            self.minutes.addItem(title, str(path))
        last = self.minutes.findData(int(self._settings.text("seed/minutes", "1")))
        self.minutes.setCurrentIndex(max(last, 0))
        self.scene = PathLine(tr("or a scene of this clip that exists"), "scene.h5 (*.h5)")
        form.addRow(tr("Time"), self.minutes)
        form.addRow(tr("Scene"), self.scene)
        return inside

    def _forecast(self, seconds: float) -> Forecast:
        return Forecast.of(seconds, self._session.annotation)

    def _scene_path(self) -> str:
        """The scene that is there already and was chosen, "" where one is to be optimised."""
        path = self.scene.text() or str(self.minutes.currentData())
        return path if path.endswith(".h5") else ""

    def _scenes_there(self) -> list[tuple[str, Path]]:
        """Scenes of this clip that can be taken at once: this project's last one, the one on show in Watch."""
        last, shown = self._session.project.path.with_suffix(SUFFIX), self._session.state.scene_path
        there = [(tr("the last scene of this project, at once"), last)]
        if shown is not None and shown.suffix == ".h5" and self._session.state.clip_path == self._clip_path:
            there.append((tr("the scene on show in Watch, at once"), shown))
        return [(title, path) for title, path in there if path.is_file()]

    @property
    def _clip_path(self) -> Path:
        return Path(self._session.project.info.path)

    def _file_options(self) -> QWidget:
        inside = QWidget()
        form = QFormLayout(inside)
        self.file = PathLine(tr("npz file"), "npz (*.npz)")
        form.addRow(tr("File"), self.file)
        return inside

    def _show_options(self, chosen: int) -> None:
        for n, name in enumerate(seeding.NAMES):
            self.options[name].setVisible(n == chosen and name != "optical")
        self._foretell()

    # ---- how long it will take

    def _guess(self) -> _Guess | None:
        """What a run would take as things stand, as the trackers guess it; None where there is nothing to run yet."""
        session, name, clip = self._session, self.choice(), self._session.clip
        asked = [i.id for o in self.objects() for i in session.annotation.tracks_of(o)]
        ids, queries = seeding.Queries.of(session.annotation, asked)
        scene, file = self._scene_path(), self.file.text()
        if clip is None or not ids or (name == "scene" and not scene) or (name == "file" and not Path(file).is_file()):
            return None
        if name == "cotracker":
            return _Guess(self.cotracker.kind(),
                          window_seconds(len(clip), self.cotracker.at_once.value(), queries.t), len(ids))  # fmt: skip
        if name == "optical":
            return _Guess(name, self._work.tracker.optical_seconds(clip, queries), len(ids))
        return _Guess(name, seeding.make(name, scene or file).forecast(clip, queries), len(ids))

    def _foretell(self) -> None:
        """Say how long it will take; where a scene is to be optimised first its own line says so."""
        guess = self._guess()
        self.forecast.setVisible(guess is not None)
        if guess is not None:
            seconds, measured = self._speeds.seconds(guess.kind, guess.seconds)
            frames = self._session.annotation.frames
            self.forecast.setText(foretold(seconds, measured, guess.points, frames))
        self._fit()

    def _tell_time(self) -> None:
        """The time so far and the time to go, on the progress bar."""
        if self.job is None:
            expected = self._speeds.seconds(self._guessed.kind, self._guessed.seconds)[0]
        else:
            expected = self._expected.whole
        self.progress.setFormat(so_far(self._share, self._clock.elapsed() / 1000, expected))

    # ---- what is done

    def _start(self) -> None:
        try:
            self._guessed = self._guess() or _Guess("", 0.0, 0)
            started = self._begin(self.choice())
        except GenmojoError as error:
            self.note.setText(fault(error))
            return
        if started:
            self._show_running(True)

    def _show_running(self, on: bool) -> None:
        """While it runs nothing can be chosen; when it failed, everything can again."""
        if on:
            self._clock.start()
            self._tick.start()
            self._show_share(0.0)
        else:
            self._tick.stop()
        self.progress.setVisible(on)
        for widget in (self.start, *self._trackers.buttons(), *self._scope.buttons(), *self.options.values()):
            widget.setEnabled(not on)
        self._fit()

    def _fit(self) -> None:
        """As high as what is on show needs: lines that wrap need more than a layout asks for by itself."""
        self._column.activate()
        self.resize(self.width(), max(self._column.totalHeightForWidth(self.width()), self.sizeHint().height()))

    def _begin(self, name: str) -> bool:
        """Start what was chosen; False (with a sentence) where something is missing. Raises GenmojoError."""
        tracker = self._work.tracker
        if name == "optical":
            return tracker.seed(self.objects())
        if name == "scene":
            path = self._scene_path()
            made = seeding.make("scene", path) if path else None
            return tracker.seed_by(made, self.objects()) if made is not None else self._optimise()
        if name == "file":
            return tracker.seed_by(seeding.make("file", self.file.text() or None), self.objects())
        if not self.cotracker.consent.isChecked():
            self.note.setText(tr("CoTracker's licence has to be agreed to first."))
            return False
        return tracker.seed_by(self.cotracker.seeder(), self.objects())

    def _optimise(self) -> bool:
        """Optimise a scene from what people said: points placed and accepted, masks cut out by hand."""
        session = self._session
        if session.clip is None or not any(len(i) for i in map(session.annotation.keys, session.annotation.tracks)):
            self.note.setText(
                tr("The clip is still being read.") if session.clip is None else tr("Place points first.")
            )
            return False
        output = session.project.path.with_suffix(SUFFIX)
        said, given = said_by_people(session.annotation), {}
        if said is not None:
            given["--tracks"] = output.with_suffix(".tracks.npz")
            write_tracks(said, given["--tracks"])
        if session.hand_masks and session.clip is not None:
            given["--masks"] = hand_masks.publish(session.clip, session.project.path)
        minutes = float(self.minutes.currentData())
        self._settings.put("seed/minutes", f"{minutes:.0f}")
        self._expected = self._forecast(60.0 * minutes)
        self.job = SceneJob(self._clip_path, output, 60.0 * minutes, self._expected.optimise, given, self)
        self.job.progressed.connect(self._optimised)
        self.job.finished.connect(self._scene_ready)
        self.job.failed.connect(self._failed)
        self.job.start()
        ready = decimal(self._expected.whole / 60, ".1f")
        self.note.setText(tr("Optimising; ready in about {m} min. You can close this to cancel.").format(m=ready))
        return True

    def _scene_ready(self, path: str) -> None:
        self.note.setText(tr("Following the points through the scene …"))
        if not self._work.tracker.seed_by(seeding.make("scene", path), self.objects()):
            self._show_running(False)

    def _failed(self, sentence: str) -> None:
        self._show_running(False)
        self.note.setText(sentence)

    def _optimised(self, share: float) -> None:
        """Share of the optimisation, which is the first part of the whole."""
        self._show_share(share * self._expected.optimise / self._expected.whole)

    def _progressed(self, share: float) -> None:
        """Share of the tracking, which is the whole or its last part."""
        before = 0.0 if self.job is None else self._expected.optimise / self._expected.whole
        self._show_share(before + (1.0 - before) * share)

    def _show_share(self, share: float) -> None:
        self._share = share
        self.progress.setValue(round(100 * share))
        self._tell_time()

    def _seeded(self, tracks: int) -> None:
        if not self.progress.isVisible():
            return
        if tracks:
            if self._guessed.kind and self.job is None:
                self._speeds.learn(self._guessed.kind, self._guessed.seconds, self._clock.elapsed() / 1000)
            self.accept()
        else:
            self._show_running(False)  # why has been said
