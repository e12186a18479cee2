"""What a person can do in the workspace Watch."""

from __future__ import annotations

from genmojo_studio.actions import Action

# Names are those of `view3d.orbit.PRESETS`.
VIEWS = (
    ("input", "Input camera", "0"),
    ("right_30", "30° to the right", "6"),
    ("left_30", "30° to the left", "4"),
    ("above_30", "30° from above", "8"),
    ("below_30", "30° from below", "2"),
    ("right_90", "90° to the right", "3"),
    ("left_90", "90° to the left", "1"),
    ("back", "From behind", "7"),
    ("top", "From the top", "9"),
)

_MODES = (
    ("rgb", "Colour"),
    ("instance", "Objects"),
    ("instance_soft", "Objects, mixed"),
    ("depth", "Depth"),
    ("depth_median", "Depth, median"),
    ("flow", "Motion to the next frame"),
    ("normal", "Surface direction"),
    ("opacity", "Coverage"),
    ("residual", "Error against the input"),
    ("ellipsoids", "Ellipsoids"),
    ("centres", "Centres"),
)
MODES = {f"mode.{name}": name for name, _ in _MODES}

PANELS = (
    ("view", "View"),
    ("objects", "Objects"),
    ("run", "Run"),
    ("curves", "Curves"),
    ("picking", "Picked Gaussian"),
    ("tracks", "Point tracks"),
    ("compare", "Compare scenes"),
)

COMPARES = ("scene", "side", "wipe", "onion", "difference")
_COMPARE_TEXTS = ("Scene alone", "Input beside it", "Wipe", "Onion skin", "Difference")


def _watch(action_id: str, text: str, menu: str, *keys: str, **more: object) -> Action:
    return Action(action_id, text, menu, keys, workspace="watch", **more)  # type: ignore[arg-type]


ACTIONS = (
    _watch("edit.undo", "Undo", "Edit", "Ctrl+Z", help="Takes the last change of the view or the scene back."),
    _watch("edit.redo", "Redo", "Edit", "Ctrl+Shift+Z", "Ctrl+Y", help="Does it again."),
    *(_watch(f"view.{name}", text, "View/Direction", key) for name, text, key in VIEWS),
    *(_watch(f"mode.{name}", text, "View/Show", checkable=True) for name, text in _MODES),
    *(
        _watch(f"compare.{name}", text, "View/Compare with the input", f"Alt+{i + 1}", checkable=True)
        for i, (name, text) in enumerate(zip(COMPARES, _COMPARE_TEXTS, strict=True))
    ),
    _watch("view.background", "Background", "View", "B", checkable=True, separator=True,
           help="Shows or leaves out the background."),
    _watch("view.canonical", "Without motion", "View", "C", checkable=True,
           help="Every object in the shape it was reconstructed in."),
    _watch("view.tracks", "Point tracks", "View", "T", checkable=True, help="Draws tracks over both pictures."),
    _watch("view.all", "Show all objects", "View", "Shift+A", help="Ends solo, hiding, tints and explosion."),
    _watch("view.solo", "Solo the selected object", "View", "S", checkable=True, help="Hides everything else."),
    _watch("view.edit_mask", "Edit this mask…", "View", "E", separator=True,
           help="Goes to the annotator's step Objects."),
    *(_watch(f"panel.{name}", text, "Window/Panels", checkable=True) for name, text in PANELS),
    _watch("time.play", "Play or pause", "Time", "Space", help="Lets time run."),
    _watch("time.next", "Next frame", "Time", "Right", ".", repeats=True),
    _watch("time.previous", "Previous frame", "Time", "Left", ",", repeats=True),
    _watch("time.first", "First frame", "Time", "Home"),
    _watch("time.last", "Last frame", "Time", "End"),
    _watch("time.faster", "Faster", "Time", "]"),
    _watch("time.slower", "Slower", "Time", "["),
    _watch("run.start", "Start a run", "Run", "F5", help="Optimises a scene of the open clip."),
    _watch("run.pause", "Pause or go on", "Run", "F6"),
    _watch("run.step", "One step", "Run", "F7", help="While paused."),
    _watch("run.next_stage", "Run to the next stage", "Run", "F8"),
    _watch("run.checkpoint", "Write a checkpoint", "Run", "F9"),
    _watch("run.stop_keep", "Stop and keep the scene", "Run", "Shift+F5", separator=True),
    _watch("run.stop_discard", "Stop and throw it away…", "Run"),
    _watch("run.csv", "Save the curves as CSV…", "Run", separator=True),
    _watch("run.attach", "Go on with a run folder…", "Run", help="Shows a run that lives, or resumes its checkpoint."),
    _watch("save.hdf5", "Scene as HDF5…", "Take away", "Ctrl+S"),
    _watch("save.ply", "This frame as PLY…", "Take away"),
    _watch("save.ply_sequence", "All frames as PLY…", "Take away"),
    _watch("save.screenshot", "Picture of this view…", "Take away", "Ctrl+P", separator=True),
    _watch("save.turntable", "Turntable video…", "Take away", "Ctrl+T"),
    _watch("save.path", "Camera path…", "Take away", help="Keys with pose, lens and scene time; renders a video."),
)  # fmt: skip
