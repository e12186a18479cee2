"""Menus and keys made from the action table."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject, QTimer
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

from genmojo_studio.actions import Action, ActionTable
from genmojo_studio.translate import tr

ORDER = ("File", "Edit", "View", "Time", "Scene", "Run", "Take away", "Objects", "Points", "Tracks", "Review")
LAST = ("Window", "Help")


class Menus(QObject):
    """The menu bar and the keys of one window; both follow the table and the workspace on show."""

    def __init__(self, window: QMainWindow, table: ActionTable) -> None:
        super().__init__(window)
        self._window = window
        self._table = table
        self._workspace = ""
        self._actions: dict[str, QAction] = {}
        self._menus: dict[str, QMenu] = {}
        for action in table:
            self._actions[action.id] = self._make(action)
        self._build()
        self._timer = QTimer(self)  # a workspace binds a hundred actions: they are looked at once
        self._timer.setSingleShot(True)
        self._timer.setInterval(0)
        self._timer.timeout.connect(self._refresh_keys)
        table.subscribe(self._timer.start)

    def menu(self, title: str) -> QMenu:
        """A menu by its English title, made if it is not there ("View/Direction" for a submenu)."""
        if title not in self._menus:
            parent, _, name = title.rpartition("/")
            bar_or_menu = self.menu(parent) if parent else self._window.menuBar()
            made = bar_or_menu.addMenu(tr(name))
            made.setToolTipsVisible(True)
            made.aboutToShow.connect(self._refresh_state)
            made.aboutToHide.connect(self._enable_all)
            self._menus[title] = made
        return self._menus[title]

    def set_workspace(self, workspace: str) -> None:
        """Shows what works in a workspace ("annotate", "watch", "" on the start page) and nothing else."""
        self._workspace = workspace
        for action in self._table:
            self._actions[action.id].setVisible(self._works(action))
        self._enable_all()
        self._hide_empty()

    def _hide_empty(self) -> None:
        for title in sorted(self._menus, key=lambda title: -title.count("/")):  # submenus first
            entries = self._menus[title].actions()
            self._menus[title].menuAction().setVisible(any(e.isVisible() and not e.isSeparator() for e in entries))

    def _make(self, action: Action) -> QAction:
        made = QAction(tr(action.text), self._window)
        made.setObjectName(action.id)
        made.setToolTip(tr(action.help) if action.help else tr(action.text))
        made.setStatusTip(tr(action.help))
        made.setCheckable(action.checkable)
        made.setAutoRepeat(action.repeats)
        made.setMenuRole(QAction.MenuRole.NoRole)
        made.triggered.connect(self._triggered)
        self._window.addAction(made)
        return made

    def _triggered(self) -> None:
        sender = self.sender()
        if isinstance(sender, QAction):
            self._table.trigger(sender.objectName())
            sender.setChecked(self._table.is_checked(sender.objectName()))

    def _build(self) -> None:
        for title in _titles(self._table):
            self.menu(title)
        for action in self._table:
            if action.menu:
                menu = self.menu(action.menu)
                if action.separator:
                    menu.addSeparator()
                menu.addAction(self._actions[action.id])
        self._refresh_keys()

    def _works(self, action: Action) -> bool:
        return action.workspace in ("", self._workspace) and self._table.is_bound(action.id)

    def _refresh_keys(self) -> None:
        for action in self._table:
            self._actions[action.id].setShortcuts([QKeySequence(key) for key in self._table.keys(action.id)])
            self._actions[action.id].setEnabled(self._works(action))
            self._actions[action.id].setVisible(self._works(action))
            self._actions[action.id].setChecked(self._table.is_checked(action.id))
        self._hide_empty()

    def _refresh_state(self) -> None:
        """While a menu is open, what cannot be done now is grey."""
        for action in self._table:
            made = self._actions[action.id]
            made.setEnabled(self._works(action) and self._table.is_enabled(action.id))
            if action.checkable:
                made.setChecked(self._table.is_checked(action.id))

    def _enable_all(self) -> None:
        """Keys ask the table when they are pressed: a state that nobody told the menus of must not swallow a key."""
        for action in self._table:
            self._actions[action.id].setEnabled(self._works(action))


def _titles(actions: Iterable[Action]) -> list[str]:
    """The menus' titles, parents before children, in the order they stand in the bar."""
    wanted = list(dict.fromkeys(action.menu for action in actions if action.menu))
    tops = list(dict.fromkeys(title.split("/")[0] for title in wanted))
    middle = [title for title in tops if title not in ORDER + LAST]
    order = [title for title in (*ORDER, *middle, *LAST) if title in tops]
    return order + [title for title in wanted if "/" in title]
