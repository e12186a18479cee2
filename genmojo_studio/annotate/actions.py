"""What a person can do in the annotator, with keys for four habits: Studio, CVAT, labelme, Blender.

Keys that are held (occluded, loupe, hide) act until they are let go; `held.py` sees to that.
"""

from __future__ import annotations

from genmojo_studio.actions import Action
from genmojo_studio.annotate import steps
from genmojo_studio.annotate.sheet_order import ORDERS

WORKSPACE = "annotate"
KEYED = 9  # points of an object, and objects, that have a key of their own; Tab and the tree reach all
MENUS = {"move": "Go", "object": "Objects", "point": "Points", "track": "Tracks", "view": "View", "edit": "Edit",
         "review": "Review", "file": "File", "step": "Go/Step", "panel": "View/Panels"}  # fmt: skip


def _action(name: str, text: str, keys: str = "", help_: str = "", **more: object) -> Action:
    """One row: "group.verb", text, Studio's keys separated by spaces, sentence; `cvat`, `labelme`, `blender` keys."""
    presets = {
        title: tuple(str(more.pop(title.lower())).split())
        for title in ("CVAT", "labelme", "Blender")
        if title.lower() in more
    }
    menu = str(more.pop("menu", MENUS[name.split(".")[0]]))
    return Action(f"annotate.{name}", text, menu, tuple(keys.split()), presets, WORKSPACE, help_, **more)  # type: ignore[arg-type]


_MOVE = (
    _action("move.next", "Next frame", "Right D", "One frame on.", cvat="F Right", labelme="D Right", blender="Right",
            repeats=True),
    _action("move.previous", "Previous frame", "Left A", "One frame back.", cvat="D Left", labelme="A Left",
            blender="Left", repeats=True),
    _action("move.stride_next", "On by the stride", ".", "On by the frames of the stride.", cvat="V .", repeats=True),
    _action("move.stride_previous", "Back by the stride", ",", "Back by the stride.", cvat="C ,", repeats=True),
    _action("move.open_next", "Next open frame of the stride", "Alt+.", "Where not every point is accepted yet."),
    _action("move.open_previous", "Previous open frame of the stride", "Alt+,", "The same, backwards."),
    _action("move.accept", "Accept all points and go on", "Return Enter", "Confirms the points here that nothing "
            "speaks against, and goes on by the stride or to the point that needs a look."),
    _action("move.accept_back", "Accept and go back", "Shift+Return Shift+Enter", "The same, backwards."),
    _action("move.ten_next", "Ten frames on", "Shift+Right", "Ten frames on.", blender="Ctrl+Right", repeats=True),
    _action("move.ten_previous", "Ten frames back", "Shift+Left", "Ten back.", blender="Ctrl+Left", repeats=True),
    _action("move.hundred_next", "A hundred frames on", "Ctrl+Alt+Right", "A hundred frames on."),
    _action("move.hundred_previous", "A hundred frames back", "Ctrl+Alt+Left", "A hundred frames back."),
    _action("move.first", "First frame", "Home", "The clip's first frame.", blender="Shift+Left"),
    _action("move.last", "Last frame", "End", "The clip's last frame.", blender="Shift+Right"),
    _action("move.play", "Play or pause", "Space", "Plays at the speed chosen."),
    _action("move.loop", "Play the segment in a loop", "Shift+Space", "Between the keys around this frame."),
    _action("move.key_next", "Next key of the track", "Down R", "Where a person placed the point next.", blender="Up"),
    _action("move.key_previous", "Previous key of the track", "Up E", "The key before.", blender="Down"),
    _action("move.bisect", "Middle of the gap", "B", "The frame halfway between the keys around this one."),
    _action("move.worst", "Next suspicious spot", "N", "The most suspicious spot that nobody looked at.",
            blender="N Alt+Shift+Right"),
    _action("move.worst_back", "Previous suspicious spot", "Shift+N", "Back through the suspicious spots.",
            blender="Shift+N Alt+Shift+Left"),
    _action("move.back", "Back to where I was", "Alt+Home", "The frame and track before the last jump."),
    _action("move.ahead", "On to where I came from", "Alt+End", "The other way after going back."),
    _action("move.panel", "Next panel", "F6", "Moves the keyboard to the next panel."),
    _action("move.panel_back", "Previous panel", "Shift+F6", "Moves the keyboard to the panel before."),
    _action("move.frame", "Back to the frame", "Esc", "Gives the keyboard to the frame and puts drawing tools away."),
)  # fmt: skip

_OBJECT = (
    _action("object.choose", "Choose the object", "W", "Annotates the selected object."),
    _action("object.reject", "Leave the object out", "Shift+W", "For the reason that stands in the panel."),
    _action("object.earlier", "Earlier in the order", "Ctrl+PgUp", "The object and its colour come before others."),
    _action("object.later", "Later in the order", "Ctrl+PgDown", "The object comes after others."),
    _action("object.box", "Draw a box", "Ctrl+Shift+B", "A rectangle round the object.", separator=True),
    _action("object.stroke", "Draw on the object", "Ctrl+D", "Strokes or clicks on what belongs to it."),
    _action("object.not_this", "Draw beside the object", "Ctrl+Shift+D", "Strokes on what is not part of it."),
    _action("object.cut", "Cut out", "C", "Makes a mask of what was drawn, and follows it through the clip.",
            cvat="Shift+C"),
    _action("object.follow", "Follow the mask through the clip", "", "Into frames for which the clip has no masks."),
)  # fmt: skip

_POINT = (
    *(_action(f"point.choose_{n}", f"Point {n}", str(n), f"Point {n} of the object is active.", menu="Points/Choose")
      for n in range(1, KEYED + 1)),
    *(_action(f"point.object_{n}", f"Object {n}", f"Shift+{n}", f"Makes object {n} active.", menu="Points/Choose")
      for n in range(1, KEYED + 1)),
    _action("point.next", "Next point", "Alt+Down", "The next point; in the frame Tab does it too."),
    _action("point.previous", "Previous point", "Alt+Up", "The point before; in the frame Shift+Tab too."),
    _action("point.occluded", "Occluded", "Q", "Hidden by something; hold and step to paint. Right click too.",
            cvat="Q /", blender="Q Shift+D", held=True),
    _action("point.outside", "Out of view", "O", "Outside the picture; hold and step to paint.", held=True),
    _action("point.visible", "Visible", "V", "Seen; hold and step to paint.", cvat="Shift+V", held=True),
    _action("point.nothing", "Not annotated", "Backspace", "Forgets the place; hold and step to paint a gap.",
            held=True),
    _action("point.uncertain", "Uncertain", "U", "Marks a place as uncertain, or no longer."),
    _action("point.run_start", "Run starts here", "[", "The next state, or fault found, begins in this frame."),
    _action("point.run_end", "Run ends here", "]", "The next state, or fault found, ends in this frame."),
    _action("point.key", "Key on or off", "K", "Makes this place a key, or an ordinary place.", blender="I"),
    _action("point.delete_key", "Delete the key", "Del", "The key becomes an ordinary place.",
            blender="Shift+X Alt+I Del"),
    _action("point.snap", "Snap to the likeness", "S", "Clicks go to the best likeness nearby, on a point's "
            "first key to the nearest corner; shown before.", checkable=True),
    *(_action(f"point.nudge_{side.lower()}", f"Nudge {side.lower()}", f"Ctrl+{side}", "A quarter of a pixel.",
              blender=f"Ctrl+Shift+{side}", repeats=True) for side in ("Left", "Right", "Up", "Down")),
    *(_action(f"point.push_{side.lower()}", f"Push {side.lower()}", f"Ctrl+Shift+{side}", "One pixel.",
              blender=f"Ctrl+Alt+Shift+{side}", repeats=True) for side in ("Left", "Right", "Up", "Down")),
)  # fmt: skip

_TRACK = (
    _action("track.seed", "Seed tracks…", "Ctrl+G", "Lets a tracker propose positions for every point."),
    _action("track.scene", "Solve from scene", "Ctrl+Shift+G", "Optimises a scene that follows what you placed and "
            "takes its tracks; begins at once and tells how long it takes."),
    _action("track.next", "Track one frame on", "Alt+Right", "Takes the point into the next frame."),
    _action("track.previous", "Track one frame back", "Alt+Left", "Takes the point into the frame before."),
    _action("track.on", "Track on to the next key", "T", "Solves from here to the next key.", labelme="Alt+T",
            blender="Ctrl+T", separator=True),
    _action("track.back", "Track back to the key before", "Shift+T", "Solves back to the key before.",
            labelme="Alt+Shift+T", blender="Ctrl+Shift+T"),
    _action("track.solve", "Solve the segment again", "Ctrl+T", "Between the keys around this frame.", blender="T"),
    _action("track.mode", "Segment: tracker, line, hold", "I", "How the segment between two keys is filled.",
            blender="Alt+M"),
    _action("track.clear_after", "Clear after this frame", "Alt+Del", "Forgets the track after here.", blender="Alt+T",
            separator=True),
    _action("track.clear_before", "Clear before this frame", "Alt+Shift+Del", "Forgets it before here.",
            blender="Shift+T"),
    _action("track.swap", "Swap with another point…", "Y", "In the marked frames, or from here on.", separator=True),
    _action("track.split", "Split: from here on another point…", "Shift+J", "The rest becomes a point that is free."),
    _action("track.join", "Join with another point…", "J", "Takes the frames of another track, which goes."),
    _action("track.lock", "Lock the track", "Ctrl+L", "A locked track cannot be changed.", cvat="L Ctrl+L",
            blender="Ctrl+L Alt+L", checkable=True, separator=True),
    _action("track.delete", "Delete the track", "Shift+Del", "Can be undone.", blender="X"),
)  # fmt: skip

_VIEW = (
    _action("view.fit", "Fit the frame", "F", "The whole frame.", cvat="Ctrl+F", labelme="Ctrl+F F", blender="Home F"),
    _action("view.one", "One to one", "0", "One pixel of the clip per pixel of the screen."),
    _action("view.centre", "Bring the point into view", "Shift+F", "The middle of the view, wherever the point is."),
    _action("view.in", "Zoom in", "+ =", "About the middle of the frame."),
    _action("view.out", "Zoom out", "-", "About the middle of the frame."),
    _action(
        "view.time_in",
        "Zoom in on time",
        "Ctrl+= Ctrl++",
        "Fewer frames in dope sheet and graphs; there Ctrl+wheel does it too.",
        separator=True,
    ),
    _action("view.time_out", "Zoom out of time", "Ctrl+-", "More frames in dope sheet and graphs."),
    _action("view.time_fit", "Whole clip in the dope sheet", "Ctrl+0", "All frames; a double click there does it too."),
    *(
        _action(f"view.order_{name}", text, "", help_, menu="View/Order of rows", checkable=True)
        for name, (text, help_) in ORDERS.items()
    ),
    _action("view.legend", "Signs of the dope sheet", "Shift+F1", "What they mean, and what the mouse does there."),
    _action(
        "view.follow", "View follows the point", "L", "Keeps the point in the middle.", checkable=True, cvat="Shift+L"
    ),
    _action(
        "view.loupe", "Loupe while held", "Z", "Now, the key before, the first frame and the difference.", held=True
    ),
    _action("view.loupe_stay", "Loupe", "Shift+Z", "Keeps the loupe open.", checkable=True),
    _action(
        "view.loupe_smooth", "Smooth loupe", "Alt+Z", "Pixels melt into each other, or show as squares.", checkable=True
    ),
    _action(
        "view.hide",
        "Hide what is drawn while held",
        "H",
        "Shows the bare frame.",
        labelme="H T",
        blender="Alt+Shift+Z",
        held=True,
    ),
    _action("view.masks", "Masks: off, outline, filled", "M", "Changes how masks are drawn."),
    _action("view.trails", "Trails: off, short, long", "G", "Changes the length of the trails."),
    _action("view.strip", "Stabilised strip", "P", "Patches of the point in the frames around.", checkable=True),
    _action("view.reticle_larger", "Larger reticle", "Alt+=", "The cross at the mouse."),
    _action("view.reticle_smaller", "Smaller reticle", "Alt+-", "The cross at the mouse."),
)

_REST = (
    _action("edit.undo", "Undo", "Ctrl+Z", "Takes the last change back and shows where it was."),
    _action("edit.redo", "Redo", "Ctrl+Shift+Z Ctrl+Y", "Does it again."),
    _action("edit.checkpoint", "Name this moment…", "Ctrl+S", "Everything is stored already; this gives it a name.",
            separator=True),
    _action("edit.history", "History…", "Ctrl+H", "All deeds, also those undone, named moments and other branches; "
            "goes to any of them."),
    _action("review.fix", "Needs a fix…", "X", "Returns the track to its annotator with a reason.", blender="Ctrl+X"),
    _action("review.fixed", "Fixed", "Ctrl+Shift+Return Ctrl+Shift+Enter", "Says that the spot was worked on."),
    _action("review.approve", "Approve the track", "Ctrl+Return Ctrl+Enter", "The track is right; it is locked."),
    _action("review.reject", "Reject the track", "Ctrl+Shift+X", "The track is given up; it stays in the project."),
    _action("review.merge", "Compare with a second annotator…", "", "Agreement, and a merge with preview."),
    _action("review.log", "Log and statistics…", "", "Who did what when; time per clip and person."),
    _action("review.check_log", "Check the log", "", "Whether anything in it was changed afterwards."),
    _action("review.export_log", "Export the log…", "", "CSV or JSON; names and times only with consent."),
    _action("file.new_clip", "Annotate a clip…", "", "Opens a clip with a project of its own.", separator=True),
    _action("file.import", "Import tracks…", "Ctrl+I", "TAP-Vid, CoTracker, SLEAP, DeepLabCut, CVAT, COCO, ours.",
            separator=True),
    _action("file.export", "Export tracks…", "Ctrl+E", "The same formats."),
    _action("file.copy", "Save a copy of the project…", "", "To hand it over, or to keep it elsewhere.",
            separator=True),
    _action("file.take_over", "Take over writing", "", "Edits a project that another program had open, once that has "
            "left it."),
    _action("file.backup", "Open a backup copy…", "", "As a new project; this one stays as it is."),
    _action("file.folder", "Show the project's folder", "", "Where the project of this clip lies."),
    _action("file.tour", "Tour of the annotator", "", "Ten steps on a clip made on the spot."),
    _action("step.edit_mask", "Correct the selected mask", "", "Step 1; what is drawn puts the object's mask right."),
    _action("panel.buttons", "Buttons", "", "Shows or hides this panel.", checkable=True),
    _action("panel.information", "Information", "", "Shows or hides this panel.", checkable=True),
    _action("panel.play", "Video play", "", "Shows or hides this panel.", checkable=True),
)  # fmt: skip


def step_actions() -> tuple[Action, ...]:
    """Alt+1, Alt+2, ...: one action for each step there is."""
    count = len(steps.STEPS)
    return tuple(
        _action(f"step.{n}", s.title, f"Alt+{n}", f"Step {n} of {count}.") for n, s in enumerate(steps.STEPS, 1)
    )


ACTIONS: tuple[Action, ...] = (*_MOVE, *_OBJECT, *_POINT, *_TRACK, *_VIEW, *_REST, *step_actions())
