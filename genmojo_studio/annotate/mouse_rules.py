"""What the mouse does in the annotator, and the keys that act while they are held, as data for the sheet of keys (F1).

`{view.loupe}` in a gesture stands for the key which that action of the annotator has now.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from genmojo_studio.annotate import steps
from genmojo_studio.annotate.steps import Step
from genmojo_studio.translate import mark, tr

_DRAWING, _PLACING = ("objects",), ("points", "refine", "review")
_TOGETHER = {  # groups of actions that are of use in a step besides its buttons
    "objects": ("annotate.move.", "annotate.object."),
    "points": ("annotate.move.", "annotate.point.", "annotate.track."),
    "refine": ("annotate.move.", "annotate.point.", "annotate.track."),
    "review": ("annotate.move.", "annotate.point.", "annotate.review."),
}


@dataclass(frozen=True)
class MouseRule:
    """A gesture, what it does, where, and the steps in which it does so (none named: in all)."""

    gesture: str
    does: str
    where: str
    steps: tuple[str, ...] = ()


_FRAME, _HELD = mark("Mouse in the frame"), mark("Keys that are held")
SHEET, _TIMELINE = mark("Mouse in the dope sheet"), mark("Mouse in the timeline")
_GRAPHS, _STRIP = mark("Mouse in the graphs"), mark("Mouse in the strip")
RULES = (
    MouseRule(mark("Click"), mark("Places the active point here."), _FRAME, _PLACING),
    MouseRule(mark("Click on a point"), mark("Makes that point the active one."), _FRAME, _PLACING),
    MouseRule(mark("Drag"), mark("Moves the nearest point within 12 pixels of the screen."), _FRAME, _PLACING),
    MouseRule(mark("Shift while dragging"), mark("Moves it at an eighth of the speed."), _FRAME, _PLACING),
    MouseRule(mark("Esc while dragging"), mark("Puts it back where it was."), _FRAME, _PLACING),
    MouseRule(mark("Click on an arrow at the rim"), mark("Brings that point into the middle of the view."), _FRAME,
              _PLACING),
    MouseRule(mark("Right click on a point"), mark("Occluded, or visible again."), _FRAME, _PLACING),
    MouseRule(mark("Drag with the tool Box"), mark("A rectangle round the object."), _FRAME, _DRAWING),
    MouseRule(mark("Click or drag with On it, Not this"), mark("Marks what belongs to the object, or does not."),
              _FRAME, _DRAWING),
    MouseRule(mark("Wheel"), mark("Zooms at the mouse; the loupe while it is open."), _FRAME),
    MouseRule(mark("Drag with the middle button, or where no point is"), mark("Moves the picture."), _FRAME),
    MouseRule(mark("Tab, Shift+Tab"), mark("Next point, point before."), _FRAME, _PLACING),
    MouseRule(mark("Hold {view.loupe}"), mark("Opens the loupe beside the mouse."), _HELD),
    MouseRule(mark("Hold {view.hide}"), mark("Hides all that is drawn over the frame."), _HELD),
    MouseRule(mark("Hold {point.occluded} and step"), mark("Paints occluded over the frames gone through."), _HELD,
              _PLACING),
    MouseRule(mark("Hold {point.outside} and step"), mark("Paints out of view."), _HELD, _PLACING),
    MouseRule(mark("Hold {point.visible} and step"), mark("Paints visible."), _HELD, _PLACING),
    MouseRule(mark("Hold {point.nothing} and step"), mark("Forgets the places gone through."), _HELD, _PLACING),
    MouseRule(mark("Click"), mark("Goes to that frame and makes that point the active one."), SHEET),
    MouseRule(mark("Drag over a row"), mark("Paints the state that is chosen above it."), SHEET),
    MouseRule(mark("Drag on the ruler"), mark("Goes through the frames."), SHEET),
    MouseRule(mark("Right click"), mark("Offers states, runs, keys, filling and returning it."), SHEET),
    MouseRule(mark("Ctrl+wheel"), mark("Zooms in time about the mouse."), SHEET),
    MouseRule(mark("Wheel, Shift+wheel"), mark("Scrolls the rows, scrolls in time."), SHEET),
    MouseRule(mark("Middle button, Shift+drag"), mark("Pulls rows and time along."), SHEET),
    MouseRule(mark("Double click"), mark("Shows the whole clip."), SHEET),
    MouseRule(mark("Click or drag in the upper lane"), mark("Goes to that frame."), _TIMELINE),
    MouseRule(mark("Drag the bar, or an end of it"), mark("Scrolls in time, or zooms."), _TIMELINE),
    MouseRule(mark("Click"), mark("Goes to that frame."), _GRAPHS),
    MouseRule(mark("Drag a diamond of x or y"), mark("Moves that key."), _GRAPHS),
    MouseRule(mark("Drag, or wheel"), mark("Moves and zooms the curve; a double click shows all of it."), _GRAPHS),
    MouseRule(mark("Click"), mark("Goes to the frame of that patch."), _STRIP),
)  # fmt: skip


@dataclass(frozen=True)
class Here:
    """What the sheet shows of the step that a person is in: its title, rules as (where, gesture, what it does) and
    whether an action belongs to it."""

    title: str
    rules: list[tuple[str, str, str]]
    has: Callable[[str], bool]


def here(place: int, key_of: Callable[[str], str]) -> Here:
    """Of the step at a place (from 0); `key_of(action id)` is the key that an action has now."""
    step = steps.STEPS[place]
    rules = [(tr(r.where), _filled(tr(r.gesture), key_of), tr(r.does)) for r in RULES
             if not r.steps or step.name in r.steps]  # fmt: skip
    title = tr("In this step: {n} {title}").format(n=place + 1, title=tr(step.title))
    return Here(title, rules, lambda action_id: _belongs(step, action_id))


def _belongs(step: Step, action_id: str) -> bool:
    on_buttons = any(action_id in ids for _title, ids in step.buttons)
    return on_buttons or action_id.startswith((*_TOGETHER[step.name], "annotate.view.", "annotate.edit."))


def _filled(gesture: str, key_of: Callable[[str], str]) -> str:
    return re.sub(r"\{([a-z_.]+)\}", lambda found: key_of(f"annotate.{found[1]}") or tr("(no key)"), gesture)
