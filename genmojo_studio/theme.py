"""Colours and sizes of the app: one table per theme, turned into a palette and a style sheet.

Text has at least 4.5:1 contrast on every surface it stands on, marks at least 3:1 (WCAG 2.1); a test holds the table
to that.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QEvent, QTimer
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget
from shiboken6 import isValid

ICONS = Path(__file__).resolve().parent.parent / "resources" / "icons"
_AT_ONCE = 40  # widgets that are dressed anew in one tick


@dataclass(frozen=True)
class Colours:
    """One theme. Surfaces: window (behind panels), panel, field (inputs, lists), canvas (behind pictures).

    Text: text, dim (secondary). Marks: line (borders), accent (selection, progress), good, warn, bad.
    """

    window: str
    panel: str
    field: str
    canvas: str
    raised: str
    line: str
    text: str
    dim: str
    accent: str
    on_accent: str
    good: str
    warn: str
    bad: str


THEMES = {
    "dark": Colours(
        window="#1b1d21",
        panel="#23262b",
        field="#191b1f",
        canvas="#101113",
        raised="#30343b",
        line="#444a54",
        text="#e6e8eb",
        dim="#a4abb6",
        accent="#3578c8",
        on_accent="#ffffff",
        good="#5bbf7b",
        warn="#e0a63c",
        bad="#ef7d78",
    ),
    "light": Colours(
        window="#e9ebee",
        panel="#f6f7f8",
        field="#ffffff",
        canvas="#d5d8dc",
        raised="#dfe3e8",
        line="#b3bac4",
        text="#1c1f24",
        dim="#525a66",
        accent="#1f66b8",
        on_accent="#ffffff",
        good="#17693a",
        warn="#8a5a00",
        bad="#b3261e",
    ),
}

# Colours for things that must be told apart (curves, objects), readable on both canvases and to colour-blind eyes
# (Okabe and Ito, "Color Universal Design", 2008; the yellow darkened for light surfaces).
SERIES = ("#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#0072b2", "#d55e00", "#b8a800", "#8c8c8c")


def colours(theme: str) -> Colours:
    """The table of a theme; dark for a name that is none."""
    return THEMES.get(theme, THEMES["dark"])


def contrast(first: str, second: str) -> float:
    """Contrast ratio 1..21 of two "#rrggbb" colours (WCAG 2.1, relative luminance)."""
    high, low = sorted((_luminance(first), _luminance(second)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def apply(application: QApplication, theme: str) -> None:
    """Dresses the whole application in a theme: its windows at once, what is in them in the ticks after it.

    The style sheet is the same for all themes and takes its colours from the palette, so it is set once. Widgets keep
    what it told them until they are polished anew; to set another sheet would do that to all of them in one go, which
    held the window up for a fifth of a second.
    """
    application.setPalette(_palette(colours(theme)))
    if not application.styleSheet():
        application.setStyle("Fusion")
        application.setStyleSheet(_style_sheet())
        return
    windows = [widget for widget in application.topLevelWidgets() if widget.isVisible()]
    _polish(windows)
    _go_on(_dress(application, windows))


def _dress(application: QApplication, windows: list[QWidget]) -> Iterator[None]:
    """Polish all widgets, a few in each tick, those on show first; the windows are drawn once these are done."""
    for window in windows:
        window.setUpdatesEnabled(False)
    yield
    shown: list[QWidget] = []
    hidden: list[QWidget] = []
    for widget in application.allWidgets():
        (shown if widget.isVisible() else hidden).append(widget)
    for first in range(0, len(shown), _AT_ONCE):
        yield
        _polish(shown[first : first + _AT_ONCE])
    yield
    for window in windows:
        if isValid(window):
            window.setUpdatesEnabled(True)
            # One that was asked for meanwhile got lost; Qt would wait for it and never draw again.
            QCoreApplication.sendEvent(window, QEvent(QEvent.Type.UpdateRequest))
    for first in range(0, len(hidden), _AT_ONCE):
        yield
        _polish(hidden[first : first + _AT_ONCE])


def _polish(widgets: list[QWidget]) -> None:
    for widget in widgets:
        if isValid(widget):  # not deleted meanwhile
            style = widget.style()
            style.unpolish(widget)
            style.polish(widget)
            widget.update()


def _go_on(work: Iterator[None]) -> None:
    """A tick of the work, and another one while there is more."""
    for _ in work:
        QTimer.singleShot(0, lambda: _go_on(work))
        break


def _roles(table: Colours) -> dict[QPalette.ColorRole, str]:
    """Every colour of the table, and three mixed ones, under the role by which palette and style sheet call it."""
    role = QPalette.ColorRole
    return {
        role.Window: table.panel,
        role.WindowText: table.text,
        role.Base: table.field,
        role.AlternateBase: table.panel,
        role.Text: table.text,
        role.Button: table.raised,
        role.ButtonText: table.text,
        role.PlaceholderText: table.dim,
        role.Highlight: table.accent,
        role.HighlightedText: table.on_accent,
        role.Link: table.accent,
        role.Mid: table.line,
        role.Dark: table.window,
        role.BrightText: table.bad,
        role.LinkVisited: table.good,
        role.ToolTipBase: table.warn,  # tool tips have colours of their own in the sheet
        role.ToolTipText: table.text,
        role.Midlight: _mix(table.raised, table.text, 0.08),
        role.Shadow: _mix(table.dim, table.panel, 0.45),
        role.Light: _mix(table.accent, table.field, 0.45),
    }


def _palette(table: Colours) -> QPalette:
    palette, roles = QPalette(), _roles(table)
    for role, colour in roles.items():
        palette.setColor(role, QColor(colour))
    for role in (QPalette.ColorRole.Text, QPalette.ColorRole.ButtonText, QPalette.ColorRole.WindowText):
        palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(roles[QPalette.ColorRole.Shadow]))
    return palette


# How the style sheet calls the colours.
_WORDS = {
    "window": "dark",
    "panel": "window",
    "field": "base",
    "raised": "button",
    "line": "mid",
    "text": "window-text",
    "dim": "placeholder-text",
    "accent": "highlight",
    "on_accent": "highlighted-text",
    "good": "link-visited",
    "warn": "tooltip-base",
    "bad": "bright-text",
    "hover": "midlight",
    "off": "shadow",
    "chunk": "light",
}


def _style_sheet() -> str:
    """The rules that a palette cannot say. Sizes are in device-independent pixels."""
    sheet = _RULES.replace("@icons@", ICONS.as_posix())
    for name, word in _WORDS.items():
        sheet = sheet.replace(f"@{name}@", f"palette({word})")
    return sheet


_RULES = """
QMainWindow, QStackedWidget { background: @window@; }
QMainWindow::separator { background: @window@; width: 5px; height: 5px; }
QMainWindow::separator:hover { background: @accent@; }
QDockWidget { color: @text@; font-weight: 600; }
QDockWidget::title { background: @raised@; padding: 5px 8px; border: none; }
QDockWidget > QWidget { background: @panel@; }
QToolTip { background: @raised@; color: @text@; border: 1px solid @line@; padding: 4px; }
QMenuBar { background: @window@; } QMenuBar::item { padding: 5px 9px; }
QMenuBar::item:selected { background: @raised@; }
QMenu { background: @panel@; border: 1px solid @line@; padding: 4px; }
QMenu::item { padding: 5px 26px 5px 22px; border-radius: 3px; }
QMenu::item:selected { background: @accent@; color: @on_accent@; }
QMenu::item:disabled { color: @off@; background: transparent; }
QMenu::separator { height: 1px; background: @line@; margin: 4px 6px; }
QStatusBar { background: @window@; color: @dim@; } QStatusBar::item { border: none; }
QToolBar { background: @window@; border: none; spacing: 4px; padding: 3px; }
QToolButton, QPushButton { background: @raised@; border: 1px solid transparent; border-radius: 4px; padding: 4px 9px; }
QToolButton:hover, QPushButton:hover { background: @hover@; }
QToolButton:focus, QPushButton:focus { border: 1px solid @accent@; }
QToolButton:checked, QPushButton:checked, QPushButton:default { background: @accent@; color: @on_accent@; }
QToolButton:checked:focus, QPushButton:checked:focus, QPushButton:default:focus { border: 1px solid @text@; }
QToolButton:disabled, QPushButton:disabled { color: @off@; background: @panel@; border: 1px solid @raised@; }
QToolButton[popupMode="1"] { padding-right: 18px; } QToolButton::menu-button { width: 16px; border: none; }
QToolButton[popupMode="2"] { padding-right: 18px; }
QToolButton::menu-indicator { subcontrol-position: right center; right: 5px; }
QLineEdit, QPlainTextEdit, QTextEdit, QTextBrowser {
  background: @field@; border: 1px solid @line@; border-radius: 4px; padding: 3px 5px; }
QLineEdit:focus, QPlainTextEdit:focus, QTextEdit:focus, QTextBrowser:focus { border: 1px solid @accent@; }
QAbstractSpinBox QLineEdit { border: none; padding: 0; background: transparent; }
QComboBox QAbstractItemView { background: @panel@; border: 1px solid @line@; }
QCheckBox::indicator, QAbstractItemView::indicator { width: 13px; height: 13px; border: 1px solid @dim@;
  border-radius: 3px; background: @field@; }
QCheckBox::indicator:checked, QAbstractItemView::indicator:checked { background: @accent@; border: 1px solid @accent@;
  image: url("@icons@/check.svg"); }
QRadioButton::indicator { width: 11px; height: 11px; border: 1px solid @dim@; border-radius: 6px; background: @field@; }
QRadioButton::indicator:checked { width: 5px; height: 5px; border: 4px solid @accent@; background: @on_accent@; }
QRadioButton::indicator:focus, QRadioButton::indicator:checked:focus { border-color: @text@; }
QCheckBox::indicator:focus { border: 1px solid @accent@; }
QCheckBox::indicator:checked:focus { border: 1px solid @text@; }
QAbstractItemView { background: @field@; border: 1px solid @line@; selection-background-color: @accent@;
  selection-color: @on_accent@; alternate-background-color: @panel@; }
QAbstractItemView:focus { border: 1px solid @accent@; }
QTreeView::item, QListView::item { padding: 2px 0; }
QHeaderView::section { background: @raised@; border: none; padding: 4px 6px; color: @text@; }
QTabBar { qproperty-drawBase: 0; }
QTabBar::tab { background: @window@; color: @dim@; padding: 6px 12px; border: none; }
QTabBar::tab:selected { background: @panel@; color: @text@; border-bottom: 2px solid @accent@; }
QTabBar::tab:selected:focus { background: @raised@; }
QTabBar::tab:hover { color: @text@; } QTabWidget::pane { border: none; }
QGroupBox { border: 1px solid @line@; border-radius: 5px; margin-top: 9px; padding-top: 8px; }
QGroupBox::title { subcontrol-origin: margin; left: 9px; padding: 0 4px; color: @dim@; }
QProgressBar { background: @field@; border: 1px solid @line@; border-radius: 4px; text-align: center; }
QProgressBar::chunk { background: @chunk@; border-radius: 3px; }
QScrollArea, QScrollArea > QWidget > QWidget { background: transparent; border: none; }
QScrollBar { background: @panel@; border: none; margin: 0; }
QScrollBar:vertical { width: 11px; } QScrollBar:horizontal { height: 11px; }
QScrollBar::handle { background: @line@; border-radius: 4px; margin: 2px; min-height: 24px; min-width: 24px; }
QScrollBar::handle:hover { background: @dim@; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QLabel[role="dim"] { color: @dim@; } QLabel[role="good"] { color: @good@; }
QLabel[role="warn"] { color: @warn@; } QLabel[role="bad"] { color: @bad@; }
QLabel[role="title"] { font-size: 20pt; font-weight: 600; } QLabel[role="heading"] { font-weight: 600; }
QFrame[role="card"] { background: @panel@; border: 1px solid @line@; border-radius: 8px; }
QFrame[role="card"]:hover { border: 1px solid @accent@; }
QFrame[role="banner"] { background: @raised@; border-left: 4px solid @warn@; }
QFrame[role="banner"] QPushButton { background: @panel@; border: 1px solid @line@; }
QFrame[role="banner"] QPushButton:hover { background: @hover@; }
QFrame[role="banner"] QPushButton:focus { border: 1px solid @accent@; }
QPushButton[role="workspace"] { background: transparent; padding: 6px 16px; font-weight: 600; border-radius: 0; }
QPushButton[role="workspace"]:checked { color: @text@; border-bottom: 2px solid @accent@; }
"""


def _mix(first: str, second: str, share: float) -> str:
    """A colour between two, `share` of the second."""
    pairs = zip(_channels(first), _channels(second), strict=True)
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in pairs)


def _channels(colour: str) -> tuple[int, int, int]:
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def _luminance(colour: str) -> float:
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (v / 255 for v in _channels(colour))]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
