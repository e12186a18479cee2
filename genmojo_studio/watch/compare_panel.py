"""Two scenes at once: another file, or the run as it was a moment ago; same camera, same time; figures side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QMenu,
    QPushButton,
    QSlider,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.clip.clip import Clip
from genmojo_core.store.scene_file import BakedScene
from genmojo_studio import notify
from genmojo_studio.background import Tasks
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.view3d.frames import FrameRequest
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch import differences, painting, reference
from genmojo_studio.watch.controls import line, row
from genmojo_studio.watch.latest import Latest
from genmojo_studio.watch.picture import Picture
from genmojo_studio.worker import runs

MODES = ("off", "side", "wipe", "blink", "difference")
_BLINK_MS = 450
_KEPT = 6  # checkpoints of a run: its first and the newest
_OFFERED = 8  # other runs
_WIDTH = 800  # pixels at most of the pictures that are compared


@dataclass(frozen=True)
class Side:
    """One of the two: what is drawn and what is known about it."""

    name: str
    snapshot: SceneSnapshot
    scene: BakedScene | None = None

    def figures(self) -> dict[str, float]:
        """Numbers by name."""
        found = {"Gaussians": float(len(self.snapshot)), tr("step"): float(self.snapshot.step)}
        if self.scene is not None:
            found |= {str(name): float(value) for name, value in self.scene.metrics.items()}
            if self.scene.curve:
                found[tr("held-out PSNR (dB)")] = float(self.scene.curve[-1]["psnr_held_out"])
        return {name: value for name, value in found.items() if value}


@dataclass(frozen=True)
class Pair:
    """Both scenes from the camera of the view, and their PSNR at the input camera in dB."""

    first: np.ndarray
    second: np.ndarray
    psnr: tuple[float, float]


class ComparePanel(QWidget):
    """Choices and figures; `pane` is the picture that the workspace puts beside the view.

    `request_wanted`: the workspace answers by `show_request` with what the view shows. `active_changed`: the pane came
    or went.
    """

    request_wanted = Signal()
    active_changed = Signal(bool)

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._tasks = Tasks()
        self._latest = Latest(self)
        self._first: Side | None = None
        self.second: Side | None = None
        self._pair: Pair | None = None
        self._blink_second = True
        self.pane = Picture(state)
        self.pane.hide()
        self._kept: list[Side] = []
        self.choose, self.freeze = QPushButton(tr("Choose a scene")), QPushButton(tr("Freeze what is on show"))
        self.offers = QMenu(self.choose)
        self.choose.setMenu(self.offers)
        self.mode = QComboBox()
        texts = (tr("Off"), tr("Side by side"), tr("Wipe"), tr("Blink"), tr("Difference"))
        for mode, text in zip(MODES, texts, strict=True):
            self.mode.addItem(text, mode)
        self.share = QSlider(Qt.Orientation.Horizontal)
        self.share.setRange(0, 100)
        self.share.setValue(50)
        self.share.setMaximumWidth(160)
        self.share.hide()
        self.said = line(tr("Choose another scene, or freeze this one, and compare as it goes on."))
        self.table = QTreeWidget()
        self.table.setHeaderLabels([tr("Figure"), tr("On show"), tr("Other"), tr("Difference")])
        self.table.setRootIsDecorated(False)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addLayout(row(self.choose, self.freeze, self.mode, self.share))
        layout.addWidget(self.said)
        layout.addWidget(self.table, 1)
        self._blink = QTimer(self)
        self._blink.setInterval(_BLINK_MS)
        self._blink.timeout.connect(self._blinked)
        self.offers.aboutToShow.connect(self._offer)
        self.freeze.clicked.connect(self._freeze)
        self.mode.activated.connect(self._take_mode)
        self.share.valueChanged.connect(self._join)
        self.pane.swept.connect(lambda share: self.share.setValue(round(share * 100)))
        self._latest.done.connect(self._drawn)

    @property
    def active(self) -> bool:
        """True while the pane is on show."""
        return self.second is not None and self.mode.currentData() != "off"

    def show_first(self, name: str, snapshot: SceneSnapshot | None, scene: BakedScene | None) -> None:
        """What is on show."""
        self._first = Side(name, snapshot, scene) if snapshot is not None else None
        if self.active:
            self._tell()
            self.request_wanted.emit()

    def show_request(self, request: FrameRequest | None, size: tuple[int, int]) -> None:
        """Draws both scenes from the camera and at the time of the view, in a picture shaped like it."""
        second = self.second
        if request is None or second is None or not self.active or request.moving:
            return
        width = min(_WIDTH, max(size[0], 16))
        height = max(16, round(width * size[1] / max(size[0], 1)))
        clip = self._state.clip
        self._latest.ask(lambda: _draw_both(request, second.snapshot, (width, height), clip))

    def keep_checkpoint(self, step: int) -> None:
        """The run wrote a checkpoint: what is on show now can be compared with what comes after."""
        if self._first is not None and self._first.scene is None:
            name = tr("Checkpoint at step {step}").format(step=step)
            self._kept = [*self._kept[:1], *self._kept[1:][-(_KEPT - 2) :], Side(name, self._first.snapshot)]

    def forget_checkpoints(self) -> None:
        """Another run begins."""
        self._kept = []

    def open_second(self, path: Path) -> None:
        """Reads the other scene."""
        self._tasks.run(lambda: _read(path), self._take_second, notify.tell)

    def close_tasks(self) -> None:
        """No more results."""
        self._blink.stop()
        self._tasks.close()
        self._latest.close()

    def _offer(self) -> None:
        """Checkpoints of the run on show, scenes of other runs, any file."""
        self.offers.clear()
        for side in reversed(self._kept):
            self.offers.addAction(side.name, partial(self._take_second, side))
        self.offers.addSeparator()
        for path in runs.newest_scenes(_OFFERED):
            self.offers.addAction(path.parent.name, partial(self.open_second, path))
        self.offers.addSeparator()
        self.offers.addAction(tr("A file…"), self._ask)

    def _ask(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, tr("Choose a scene"), "", "HDF5 (*.h5 *.hdf5)")
        if path:
            self.open_second(Path(path))

    def _freeze(self) -> None:
        if self._first is not None:
            name, step = self._first.name, self._first.snapshot.step
            name = tr("{name}, frozen at step {step}").format(name=name, step=step) if step else name
            self._take_second(Side(name, self._first.snapshot, self._first.scene))

    def _take_second(self, side: Side) -> None:
        self.second = side
        if self.mode.currentData() == "off":
            self.mode.setCurrentIndex(MODES.index("side"))
        self._take_mode()

    def _take_mode(self) -> None:
        self.pane.setVisible(self.active)
        self.active_changed.emit(self.active)
        blinking = self.active and self.mode.currentData() == "blink"
        self._blink.start() if blinking else self._blink.stop()
        self.share.setVisible(self.mode.currentData() in ("wipe", "difference"))
        self._tell()
        self._join()
        self.request_wanted.emit()

    def _drawn(self, pair: Pair) -> None:
        self._pair = pair
        self._join()
        self._tell()

    def _blinked(self) -> None:
        self._blink_second = not self._blink_second
        self._join()

    def _join(self) -> None:
        if self._pair is None or self.second is None or self._first is None:
            return
        first, second = self._pair.first, self._pair.second
        mode, share = self.mode.currentData(), self.share.value() / 100
        if mode == "wipe":
            caption = f"{self._first.name}  |  {self.second.name}"
            self.pane.show_pixels(differences.wipe(first, second, share), caption)
        elif mode == "difference":
            gain = 2.0 ** (share * 6 - 1)
            self.pane.show_pixels(
                differences.absolute(first, second, gain), tr("Difference × {gain:.1f}").format(gain=gain)
            )
        else:
            other = mode == "side" or self._blink_second
            self.pane.show_pixels(second if other else first, (self.second if other else self._first).name)

    def _tell(self) -> None:
        self.table.clear()
        if self._first is None or self.second is None:
            return
        self.said.setText(self.second.name)
        a, b = self._first.figures(), self.second.figures()
        if self._pair is not None:
            name = tr("PSNR of this frame (dB)")
            a, b = a | {name: self._pair.psnr[0]}, b | {name: self._pair.psnr[1]}
        for name in dict.fromkeys((*a, *b)):
            one, two = a.get(name, math.nan), b.get(name, math.nan)
            apart = two - one
            texts = [_figure(value, "") for value in (one, two)]
            self.table.addTopLevelItem(QTreeWidgetItem([name[:1].upper() + name[1:], *texts, _figure(apart, "+")]))
        self.table.resizeColumnToContents(0)


def _figure(value: float, sign: str) -> str:
    """A number for the table: counts whole, everything else to three places; nothing for NaN."""
    if math.isnan(value):
        return ""
    return f"{value:{sign}.0f}" if value == round(value) else f"{value:{sign}.3f}"


def _draw_both(request: FrameRequest, other: SceneSnapshot, size: tuple[int, int], clip: Clip | None) -> Pair:
    view, frame = request.view(*size), round(request.t)
    return Pair(
        painting.paint(request.snapshot, view, request.look, request.t),
        painting.paint(other, view, request.look, min(request.t, other.T - 1)),
        (_psnr(request.snapshot, clip, frame), _psnr(other, clip, frame)),
    )


def _psnr(snapshot: SceneSnapshot, clip: Clip | None, frame: int) -> float:
    """PSNR in dB of a frame at the input camera, NaN where there is nothing to compare with."""
    if clip is None or frame >= len(clip.frames):
        return math.nan
    shown = clip.frames[frame]
    render = reference.draw(snapshot, frame, (shown.shape[1], shown.shape[0]))
    return math.nan if render is None else differences.whole_psnr(shown, render)


def _read(path: Path) -> Side:
    from genmojo_core.store import scene_hdf5

    scene = scene_hdf5.read(path)
    return Side(path.name if path.name != "scene.h5" else f"{path.parent.name}/scene.h5",
                SceneSnapshot.from_baked(scene), scene)  # fmt: skip
