"""How the scene is shown, shared by the picture and the panels, with undo."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QColor

from genmojo_studio.undo import UndoStack
from genmojo_studio.view3d.look import RGB, Look, Mode, ObjectLook


class Appearance(QObject):
    """Holds the `Look`; every change goes through here and can be undone. Emits `changed`.

    The backdrop belongs to the window, not to the scene: it is no step to undo.
    """

    changed = Signal()

    def __init__(self, undo: UndoStack, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._undo = undo
        self.look = Look()

    def set(self, look: Look, text: str, key: str = "") -> None:
        """Takes a look; `text` names the change in the menu Edit, `key` merges quick changes of one thing."""
        if look == self.look:
            return
        self._undo.record(text, self.restore, self.look, look, key)
        self.restore(look)

    def restore(self, look: Look) -> None:
        """Takes a look without a new entry to undo."""
        self.look = replace(look, backdrop=self.look.backdrop)
        self.changed.emit()

    def set_backdrop(self, colour: QColor) -> None:
        """Another colour behind everything."""
        self.look = replace(self.look, backdrop=(colour.redF(), colour.greenF(), colour.blueF()))
        self.changed.emit()

    def set_mode(self, mode: str, text: str) -> None:
        """Another render mode."""
        self.set(replace(self.look, mode=Mode(mode)), text)

    def set_object(self, object_id: int, text: str, look: ObjectLook) -> None:
        """Another look of one object."""
        self.set(self.look.with_object(object_id, look), text, f"object {object_id}")

    def toggle_solo(self, object_id: int, text: str) -> None:
        """Shows one object alone, or everything again."""
        solo = frozenset() if self.look.solo == frozenset({object_id}) else frozenset({object_id})
        self.set(replace(self.look, solo=solo), text)

    def tint(self, object_id: int, colour: RGB | None, text: str) -> None:
        """Tints an object, or no more."""
        self.set_object(object_id, text, replace(self.look.of(object_id), tint=colour))

    def show_all(self, text: str) -> None:
        """No solo, nothing hidden, no tints, nothing moved apart."""
        self.set(replace(self.look, solo=frozenset(), objects={}, explode=0.0), text)
