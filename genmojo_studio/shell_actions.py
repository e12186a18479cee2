"""What a person can do everywhere in the app."""

from __future__ import annotations

from genmojo_studio.actions import Action

ACTIONS = (
    Action("file.open_clip", "Open clip folder…", "File", ("Ctrl+O",), help="Opens a folder of images or a clip."),
    Action("file.open", "Open file…", "File", ("Ctrl+Shift+O",), help="Opens a video, a scene, a project or a PLY."),
    Action("file.demo", "Open the demo clip", "File", help="Makes a small clip on the spot and opens it."),
    Action("file.close", "Back to the start page", "File", ("Ctrl+W",), separator=True, help="Keeps everything open."),
    Action("file.settings", "Shortcuts and settings…", "File", ("Ctrl+,",), {"CVAT": ("F2", "Ctrl+,")}, separator=True,
           help="Keys, language."),
    Action("file.quit", "Quit", "File", ("Ctrl+Q",), separator=True, help="Closes the window; nothing is lost."),
    Action("window.annotate", "Annotate", "Window", ("Ctrl+1",), help="Points and masks by hand."),
    Action("window.watch", "Watch", "Window", ("Ctrl+2",), help="Optimise, look at and compare scenes."),
    Action("window.theme", "Light theme", "Window", ("Ctrl+Shift+L",), checkable=True, separator=True,
           help="Switches between the dark and the light theme."),
    Action("window.panels", "Pictures only", "Window", ("Ctrl+B",), checkable=True,
           help="Hides all panels, so that the pictures fill the window; again brings them back."),
    Action("window.full_screen", "Full screen", "Window", ("F11",), checkable=True, help="Fills the screen."),
    Action("window.reset", "Reset the panels", "Window", help="Puts every panel where it was delivered."),
    Action("help.palette", "Find a command…", "Help", ("Ctrl+K", "Ctrl+Shift+P"),
           {"Blender": ("F3", "Ctrl+K", "Ctrl+Shift+P")}, help="Type what you want to do."),
    Action("help.keys", "All shortcuts", "Help", ("F1",), help="Shows the keys that work here."),
    Action("help.selftest", "Try hard cases on this machine…", "Help", separator=True,
           help="Hostile splats, masks, depths and numbers that go bad, with a verdict each; some minutes."),
    Action("help.crash", "Reports of earlier crashes", "Help", help="What faults left behind."),
    Action("help.about", "About and licences", "Help", help="Version, licences of what is inside."),
)  # fmt: skip
