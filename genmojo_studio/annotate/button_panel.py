"""The button panel: the actions of a step, with their keys, in groups; and the step bar above everything."""

from __future__ import annotations

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QKeySequence, QPaintEvent, QPalette
from PySide6.QtWidgets import (
    QButtonGroup,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QSizePolicy,
    QSpinBox,
    QStyle,
    QStyleOptionToolButton,
    QStylePainter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_studio.actions import ActionTable
from genmojo_studio.annotate import steps
from genmojo_studio.annotate.session import STRIDES
from genmojo_studio.annotate.steps import SHORT, Step
from genmojo_studio.translate import mark, tr


class ButtonPanel(QScrollArea):
    """Buttons of the step on show; every one of them also has a key and a menu entry."""

    def __init__(self, actions: ActionTable, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._actions = actions
        self._buttons: dict[str, KeyButton] = {}
        self._step: Step | None = None
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setMinimumWidth(120)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # its buttons take the keyboard, and it follows them
        self.setAccessibleName(tr("Buttons of this step"))
        self.destroyed.connect(actions.subscribe(self.refresh))

    def sizeHint(self) -> QSize:
        """Narrow."""
        return QSize(176, 500)

    def show_step(self, step: Step) -> None:
        """Put a step's buttons on show."""
        self._step, self._buttons = step, {}
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(8, 6, 8, 8)
        column.setSpacing(4)
        for title, names in step.buttons:
            label = QLabel(tr(title))
            label.setProperty("role", "dim")
            column.addWidget(label)
            for name in names:
                button = self._button(name)
                self._buttons[name] = button
                column.addWidget(button)
            column.addSpacing(5)
        column.addStretch()
        self.setWidget(inside)
        self.refresh()

    def button(self, action_id: str) -> QToolButton:
        """The button of an action, for tests and tours."""
        return self._buttons[action_id]

    def refresh(self) -> None:
        """Keys, ticks and what is possible."""
        for name, button in self._buttons.items():
            action = self._actions[name]
            key = next(iter(self._actions.keys(name)), "")
            short = tr(SHORT.get(name.removeprefix("annotate."), action.text))
            button.setText(short)
            button.setKey(short_key(key))
            button.setToolTip(f"{tr(action.text)}. {tr(action.help)}" + (f"  ({_native(key)})" if key else ""))
            button.setEnabled(self._actions.is_enabled(name))
            button.setChecked(self._actions.is_checked(name))
        inside = self.widget()
        if inside is not None:
            self.setMinimumWidth(inside.minimumSizeHint().width() + self.verticalScrollBar().sizeHint().width())

    def _button(self, name: str) -> KeyButton:
        button = KeyButton()
        button.setCheckable(self._actions[name].checkable)
        button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        button.setObjectName(name)
        button.setAccessibleName(tr(self._actions[name].text))
        button.clicked.connect(self._clicked)
        return button

    def _clicked(self) -> None:
        sender = self.sender()
        if isinstance(sender, QToolButton):
            self._actions.trigger(sender.objectName())
            self.refresh()


class KeyButton(QToolButton):
    """A button with its text at the left and, where there is room, its key, dimmed, at the right."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._key = ""

    def setKey(self, key: str) -> None:
        """The key that does the same."""
        self._key = key
        self.update()

    def sizeHint(self) -> QSize:
        """Room for text and key."""
        wide = self.fontMetrics().horizontalAdvance(self.text() + self._key) + 34
        return QSize(wide, super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """The text is never cut short; the key stands in the tool tip too."""
        return QSize(self.fontMetrics().horizontalAdvance(self.text()) + 20, self.sizeHint().height())

    def shows_key(self) -> bool:
        """Whether there is room for the key beside the text."""
        return self.sizeHint().width() - 8 <= self.width()

    def paintEvent(self, event: QPaintEvent) -> None:
        """The frame of a tool button, then the two texts."""
        painter = QStylePainter(self)
        option = QStyleOptionToolButton()
        self.initStyleOption(option)
        option.text = ""
        painter.drawComplexControl(QStyle.ComplexControl.CC_ToolButton, option)
        area = QRect(self.rect()).adjusted(9, 0, -9, 0)
        role = QPalette.ColorRole.HighlightedText if self.isChecked() else QPalette.ColorRole.ButtonText
        group = QPalette.ColorGroup.Normal if self.isEnabled() else QPalette.ColorGroup.Disabled
        painter.setPen(self.palette().color(group, role))
        painter.drawText(area, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, self.text())
        if self.shows_key():
            painter.setOpacity(0.6)
            painter.drawText(area, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, self._key)
        painter.end()


_SIGNS = {"Shift": "⇧", "Return": "⏎", "Enter": "⏎", "Left": "←", "Right": "→", "Up": "↑", "Down": "↓"}
_PAGES = {"PgUp": mark("Pg↑"), "PgDown": mark("Pg↓")}  # arrows with two heads look alike where they are small


def short_key(keys: str) -> str:
    """A key sequence in the person's language, with signs for the long names."""
    if not keys:
        return ""
    held, key = ([*keys[:-2].split("+")], "+") if keys.endswith("+") else (keys.split("+")[:-1], keys.split("+")[-1])
    shown = [_SIGNS.get(word) or _native(f"{word}+A").removesuffix("+A") for word in held if word]
    return "+".join([*shown, tr(_PAGES[key]) if key in _PAGES else _SIGNS.get(key) or _native(key)])


def _native(keys: str) -> str:
    return QKeySequence(keys).toString(QKeySequence.SequenceFormat.NativeText)


class StepBar(QWidget):
    """Clip, the four steps with what each still lacks, stride, and whether everything is on the disk."""

    chosen = Signal(int)
    stride_changed = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 3, 8, 3)
        row.setSpacing(6)
        self._group = QButtonGroup(self)
        self.buttons: list[QToolButton] = []
        for n, step in enumerate(steps.STEPS):
            button = QToolButton()
            button.setText(f"{n + 1}  {tr(step.title)}")
            button.setCheckable(True)
            button.setToolTip(f"{tr(step.task)}  (Alt+{n + 1})")
            button.setObjectName(f"annotate.step.{n + 1}")  # the action of the same key
            self._group.addButton(button, n)
            self.buttons.append(button)
            row.addWidget(button)
            if n < len(steps.STEPS) - 1:
                row.addWidget(QLabel("›"))
        self._group.idClicked.connect(self.chosen)
        self.task = QLabel()
        self.task.setProperty("role", "dim")
        self.task.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        row.addSpacing(8)
        row.addWidget(self.task, 1)
        self.position = QLabel()
        self.position.setMinimumWidth(90)
        row.addWidget(self.position)
        row.addWidget(QLabel(tr("stride")))
        self.stride = QSpinBox(minimum=STRIDES[0], maximum=STRIDES[1], value=2)
        self.stride.setAccessibleName(tr("Stride in frames"))
        self.stride.valueChanged.connect(self.stride_changed)
        row.addWidget(self.stride)
        self.saved = QLabel()
        self.saved.setProperty("role", "dim")
        self.saved.setMinimumWidth(90)
        self.saved.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row.addWidget(self.saved)
        self.take_over = QToolButton()
        self.take_over.setText(tr("Take over writing"))
        self.take_over.setObjectName("annotate.file.take_over")  # the action that does it
        self.take_over.setVisible(False)
        row.addWidget(self.take_over)

    def show_trouble(self, why: str) -> None:
        """Edits wait for the disk, and why; "" when they are on it."""
        self.saved.setText(tr("NOT SAVED") if why else tr("saved"))
        self.saved.setToolTip(why)
        self.saved.setProperty("role", "bad" if why else "dim")
        for polish in (self.saved.style().unpolish, self.saved.style().polish):  # the theme looks at roles once
            polish(self.saved)

    def show_reader(self, sentence: str, whole: str = "", *, free: bool) -> None:
        """Somebody else writes, or nobody does any more and this program may (`free`); `whole`: with all names."""
        self.saved.setText(sentence)
        self.saved.setToolTip(
            (whole or sentence) + "\n" + tr("What they do is shown here within a second; nothing can be changed here.")
        )
        self.take_over.setVisible(free)

    def show_step(self, place: int, missing: list[str]) -> None:
        """Mark a step as the current one; `missing` says per step what it still lacks."""
        for n, (button, text) in enumerate(zip(self.buttons, missing, strict=True)):
            button.setChecked(n == place)
            button.setText(f"{n + 1}  {tr(steps.STEPS[n].title)}{'' if text else '  ✓'}")
            button.setToolTip(f"{tr(steps.STEPS[n].task)}\n{text or tr('Done.')}  (Alt+{n + 1})")
        self.task.setText(missing[place] or tr("This step is done."))
        self.task.setToolTip(tr(steps.STEPS[place].task))


def grid_of(pairs: list[tuple[str, QWidget]], parent: QWidget | None = None) -> QWidget:
    """A form of labels and widgets without wasted room."""
    inside = QWidget(parent)
    grid = QGridLayout(inside)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(8)
    grid.setVerticalSpacing(3)
    for row, (title, widget) in enumerate(pairs):
        label = QLabel(title)
        label.setProperty("role", "dim")
        label.setBuddy(widget)
        top = Qt.AlignmentFlag.AlignTop if isinstance(widget, QLabel) else Qt.AlignmentFlag.AlignVCenter
        grid.addWidget(label, row, 0, top)
        grid.addWidget(widget, row, 1)
    grid.setColumnStretch(1, 1)
    return inside
