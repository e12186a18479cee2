"""The bar under the picture: play, step, scrub, speed, and how the end is treated."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSlider, QSpinBox, QToolButton, QWidget

from genmojo_studio.actions import ActionTable
from genmojo_studio.icons import icon
from genmojo_studio.state import AppState
from genmojo_studio.translate import decimal, tr
from genmojo_studio.watch.player import MODES, SPEEDS, Player

_BUTTONS = (
    ("first", "time.first"),
    ("previous", "time.previous"),
    ("play", "time.play"),
    ("next", "time.next"),
    ("last", "time.last"),
)


class TimeBar(QWidget):
    """Shows and moves the shared frame; every position of the slider is a frame."""

    def __init__(self, state: AppState, actions: ActionTable, player: Player, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._table = actions
        self._player = player
        self._buttons: dict[str, QToolButton] = {}
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 4)
        for name, action_id in _BUTTONS:
            layout.addWidget(self._button(name, action_id))
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setToolTip(tr("Drag to any frame"))
        self.slider.setPageStep(5)
        layout.addWidget(self.slider, 1)
        self.frame = QSpinBox()
        self.frame.setKeyboardTracking(False)
        self.frame.setToolTip(tr("Frame (counted from 1)"))
        self.count = QLabel()
        self.seconds = QLabel()
        self.seconds.setProperty("role", "dim")
        self.seconds.setMinimumWidth(64)
        self.speed = QComboBox()
        for value in SPEEDS:
            self.speed.addItem(f"{value:g}×", value)
        self.speed.setToolTip(tr("Speed"))
        self.mode = QComboBox()
        for mode, text in zip(MODES, (tr("Loop"), tr("There and back"), tr("Once")), strict=True):
            self.mode.addItem(text, mode)
        for widget in (self.frame, self.count, self.seconds, self.speed, self.mode):
            layout.addWidget(widget)
        self.slider.valueChanged.connect(self._slid)
        self.frame.valueChanged.connect(self._typed)
        self.speed.activated.connect(lambda: state.set(speed=float(self.speed.currentData())))
        self.mode.activated.connect(self._take_mode)
        state.subscribe(self.refresh, "frame", "frame_count", "playing", "speed", "clip", "theme")
        self.refresh()

    def refresh(self) -> None:
        """Shows the shared state."""
        state = self._state
        for widget in (self.slider, self.frame):
            widget.blockSignals(True)
        self.slider.setRange(0, state.frame_count - 1)
        self.slider.setValue(state.frame)
        self.frame.setRange(1, state.frame_count)
        self.frame.setValue(state.frame + 1)
        for widget in (self.slider, self.frame):
            widget.blockSignals(False)
        self.count.setText(f"/ {state.frame_count}")
        clip = state.clip
        known = clip is not None and state.frame < len(clip.seconds)
        self.seconds.setText(f"{decimal(clip.seconds[state.frame], '.3f')} s" if clip is not None and known else "")
        self.speed.setCurrentIndex(min(range(len(SPEEDS)), key=lambda i: abs(SPEEDS[i] - state.speed)))
        self.mode.setCurrentIndex(MODES.index(self._player.mode))
        for name, button in self._buttons.items():
            shown = "pause" if name == "play" and state.playing else name
            button.setIcon(icon(shown, state.theme))

    def _button(self, name: str, action_id: str) -> QToolButton:
        button = QToolButton()
        button.setIconSize(QSize(18, 18))
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        action = self._table[action_id]
        keys = self._table.keys(action_id)
        button.setToolTip(f"{tr(action.text)} ({keys[0]})" if keys else tr(action.text))
        button.clicked.connect(lambda: self._table.trigger(action_id))
        self._buttons[name] = button
        return button

    def _slid(self, value: int) -> None:
        self._state.set(playing=False)
        self._state.set(frame=value)

    def _typed(self, value: int) -> None:
        self._slid(value - 1)

    def _take_mode(self) -> None:
        self._player.mode = str(self.mode.currentData())
