"""The middle of the workspace: the scene, alone, beside the input, or joined with it on the clip's own pixel grid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSlider, QSplitter, QVBoxLayout, QWidget

from genmojo_core.clip.clip import Clip
from genmojo_studio.actions import ActionTable
from genmojo_studio.state import AppState
from genmojo_studio.translate import decimal, tr
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch import differences, reference
from genmojo_studio.watch.actions import COMPARES, MODES
from genmojo_studio.watch.latest import Latest
from genmojo_studio.watch.picture import Picture
from genmojo_studio.watch.session import Session

_JOINED = ("wipe", "onion", "difference")
_MEASURE_MS = 400  # at most so often while a run goes on


@dataclass(frozen=True)
class Compared:
    """A frame of the scene on the clip's pixels (None where the scene is not known there), and its PSNR."""

    clip: Clip | None
    frame: int
    render: np.ndarray | None
    figures: dict[int, float]


class Comparison(QObject):
    """Input and render of the frame on show on the same pixels. Emits `measured(id -> dB)` and `ready`."""

    measured = Signal(object)
    ready = Signal()

    def __init__(self, state: AppState, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._session = session
        self._latest = Latest(self)
        self.render: np.ndarray | None = None
        self.wanted = False
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(_MEASURE_MS)
        self._timer.timeout.connect(self._ask)
        self._latest.done.connect(self._drawn)
        session.snapshot_changed.connect(self.later)
        state.subscribe(self.now, "frame", "clip")

    @property
    def input(self) -> np.ndarray | None:
        """The clip's frame on show, (H, W, 3) uint8, or None."""
        clip, frame = self._state.clip, self._state.frame
        return clip.frames[frame] if clip is not None and frame < len(clip.frames) else None

    def now(self) -> None:
        """Another frame: the render of it is wanted at once."""
        if self.wanted:
            self._ask()

    def later(self) -> None:
        """Another snapshot of the same: soon is good enough."""
        if self.wanted and not self._timer.isActive():
            self._timer.start()

    def close(self) -> None:
        """No more results."""
        self._timer.stop()
        self._latest.close()

    def _ask(self) -> None:
        shown, snapshot = self.input, self._session.snapshot
        if shown is not None and snapshot is not None:
            frame, size = self._state.frame, (shown.shape[1], shown.shape[0])
            clip = self._state.clip
            self._latest.ask(lambda: _compared(snapshot, clip, frame, size))

    def _drawn(self, result: Compared) -> None:
        if result.frame == self._state.frame and result.clip is self._state.clip:
            self.render = result.render
            self.ready.emit()
            self.measured.emit(result.figures)


def _compared(snapshot: SceneSnapshot, clip: Clip | None, frame: int, size: tuple[int, int]) -> Compared:
    render = reference.draw(snapshot, frame, size)
    if clip is None or render is None:
        return Compared(clip, frame, None, {})
    return Compared(clip, frame, render, figures(clip, frame, clip.frames[frame], render))


def figures(clip: Clip, frame: int, shown: np.ndarray, render: np.ndarray) -> dict[int, float]:
    """PSNR by object id in dB, and of the whole frame under -1."""
    whole = {-1: differences.whole_psnr(shown, render)}
    if clip.masks is None:
        return whole
    labels = {int(object_id): k + 1 for k, object_id in enumerate(clip.object_ids)}
    return whole | differences.psnr_by_object(shown, render, clip.masks.value[frame], {0: 0, **labels})


class Center(QWidget):
    """A strip of choices above the pictures. `view` is the live scene view, `beside` the pane of another scene."""

    def __init__(self, state: AppState, actions: ActionTable, session: Session, view: QWidget, beside: QWidget) -> None:
        super().__init__()
        self._state = state
        self.mode = COMPARES[1]
        self._beside = False
        self.comparison = Comparison(state, session, self)
        self.view = view
        self.input_picture = Picture(state)
        self.joined_picture = Picture(state)
        self.share = QSlider(Qt.Orientation.Horizontal)
        self.share.setRange(0, 100)
        self.share.setValue(50)
        self.share.setMaximumWidth(180)
        self.share_text = QLabel()
        self.figures = QLabel()
        self.figures.setProperty("role", "dim")
        self.compare_choice = _choice(actions, [f"compare.{name}" for name in COMPARES])
        self.mode_choice = _choice(actions, list(MODES))
        top = QHBoxLayout()
        top.setContentsMargins(8, 4, 8, 0)
        for widget in (self.compare_choice, self.mode_choice, self.share_text, self.share):
            top.addWidget(widget)
        top.addStretch()
        top.addWidget(self.figures)
        self.splitter = QSplitter()
        for pane in (self.input_picture, self.view, self.joined_picture, beside):
            self.splitter.addWidget(pane)
        self.splitter.setChildrenCollapsible(False)
        self.splitter.setSizes([1000] * 4)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(top)
        layout.addWidget(self.splitter, 1)
        self.share.valueChanged.connect(self._join)
        self.joined_picture.swept.connect(self._swept)
        self.comparison.ready.connect(self._join)
        self.comparison.measured.connect(self._tell)
        state.subscribe(self._show_input, "frame", "clip")
        self.set_mode(self.mode)

    def set_mode(self, mode: str) -> None:
        """One of `actions.COMPARES`."""
        self.mode = mode
        joined = mode in _JOINED
        self.input_picture.setVisible(mode == "side" and not self._beside)
        self.view.setVisible(not joined)
        self.joined_picture.setVisible(joined)
        self.share.setVisible(joined)
        self.share_text.setVisible(joined)
        texts = {"wipe": tr("Edge"), "onion": tr("Share of the scene"), "difference": tr("Gain")}
        self.share_text.setText(texts.get(mode, ""))
        self.comparison.wanted = mode != "scene"
        self.comparison.now()
        self.figures.setVisible(mode != "scene")
        _mark(self.compare_choice, f"compare.{mode}")
        self._show_input()

    def set_beside(self, shown: bool) -> None:
        """While another scene stands beside this one, the input makes room for it; all panes are equally wide."""
        if shown != self._beside:
            self._beside = shown
            self.set_mode(self.mode)
            self.splitter.setSizes([1000] * self.splitter.count())

    def show_render_mode(self, mode: str) -> None:
        """Marks the render mode that the view shows."""
        _mark(self.mode_choice, f"mode.{mode}")

    def _show_input(self) -> None:
        frame = self.comparison.input
        self.input_picture.show_pixels(frame, tr("Input") if frame is not None else tr("No clip is open"))
        if frame is None:
            self.comparison.render = None
        self._join()

    def _join(self) -> None:
        if self.mode not in _JOINED:
            return
        shown, render = self.comparison.input, self.comparison.render
        if shown is None or render is None or shown.shape != render.shape:
            self.joined_picture.show_pixels(shown, tr("Waiting for the scene at the input camera …"))
            return
        share = self.share.value() / 100
        if self.mode == "wipe":
            self.joined_picture.show_pixels(differences.wipe(shown, render, share), tr("Input  |  scene"))
        elif self.mode == "onion":
            self.joined_picture.show_pixels(differences.onion(shown, render, share), tr("Input and scene"))
        else:
            gain = 2.0 ** (share * 6 - 1)  # half to thirty-two times; four in the middle
            caption = tr("Difference × {gain:.1f}").format(gain=gain)
            self.joined_picture.show_pixels(differences.absolute(shown, render, gain), caption)

    def _swept(self, share: float) -> None:
        if self.mode == "wipe":
            self.share.setValue(round(share * 100))

    def _tell(self, by_object: dict[int, float]) -> None:
        whole = by_object.get(-1, math.nan)
        self.figures.setText(f"PSNR {decimal(whole, '.2f')} dB" if math.isfinite(whole) else "")


def _choice(actions: ActionTable, ids: list[str]) -> QComboBox:
    """A box that does the actions of some ids."""
    box = QComboBox()
    for action_id in ids:
        box.addItem(tr(actions[action_id].text), action_id)
    box.activated.connect(lambda: actions.trigger(str(box.currentData())))
    box.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    return box


def _mark(box: QComboBox, action_id: str) -> None:
    box.setCurrentIndex(max(box.findData(action_id), 0))
