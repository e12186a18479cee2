"""Verbs of step 1: which objects are annotated, and drawing their masks."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from genmojo_studio.annotate import steps
from genmojo_studio.annotate.canvas import Tool
from genmojo_studio.annotate.masks import Purpose

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace

_TOOLS = {"box": Tool.BOX, "stroke": Tool.SCRIBBLE, "not_this": Tool.SCRIBBLE_OUT}


class ObjectVerbs:
    """What a person does in step 1, in terms of the workspace's widgets."""

    def __init__(self, workspace: AnnotateWorkspace) -> None:
        if workspace.session is None:
            raise RuntimeError("a session is needed before its actions can be bound")
        self._w, self._s = workspace, workspace.session
        workspace.canvas.clicked.connect(self.pick)

    def table(self) -> dict[str, Callable[[], object]]:
        """Verbs by the names of their actions."""
        page = self._w.objects
        return {
            "object.choose": page.choose,
            "object.reject": page.reject,
            "object.earlier": lambda: page.reorder(-1),
            "object.later": lambda: page.reorder(1),
            **{f"object.{name}": partial(page.use_tool, tool) for name, tool in _TOOLS.items()},
            "object.cut": self._w.work.masks.cut,
            "object.follow": self.follow,
            "edit.undo": self.undo,
            "edit.redo": self.redo,
            "step.edit_mask": self.edit_mask,
        }

    def follow(self) -> None:
        """The selected object's mask goes on into frames without masks."""
        info = self._w.objects.current()
        if info is not None:
            self._w.work.masks.follow(info.id)

    def undo(self) -> None:
        """Take back what was drawn last in step 1, else the newest edit."""
        if not (self._s.sketching and self._w.work.masks.take_back()):
            self._s.undo()

    def redo(self) -> None:
        """The other way."""
        if not (self._s.sketching and self._w.work.masks.put_back()):
            self._s.redo()

    def edit_mask(self) -> None:
        """Step 1, the selected object's mask to be put right."""
        self._w.show_step(steps.place_of("objects"))
        selected = self._s.state.selected_object
        if selected:
            self._s.select(int(selected), 1)
            self._w.objects.set_purpose(Purpose.CORRECT)

    def pick(self, x: float, y: float) -> None:
        """A click without a tool, raster pixels: select the object whose mask lies there in the frame on show."""
        if not self._s.sketching or self._w.canvas.tool != Tool.POINT:
            return
        labels, size = self._s.mask_at(self._s.frame), self._s.annotation.size
        if labels is None or not (0 <= x < size[0] and 0 <= y < size[1]):
            return
        found = int(labels[int(y * labels.shape[0] / size[1]), int(x * labels.shape[1] / size[0])])
        if found in self._s.annotation.objects:
            self._s.select(found, 1)
