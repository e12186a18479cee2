"""Screenshots of the annotator's four steps, for looking at: sizes, themes and scales.

    QT_SCALE_FACTOR=2 python tests/acceptance/annotator_screens.py CLIP OUT 1366x768 1920x1080

Writes OUT/<step>-<size>-<theme>-<scale>.png. Points lie on corners, tracks stay where they were placed.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2]), str(Path(__file__).resolve().parents[1])]

from annotating import choose_all, fill, place_points  # noqa: E402
from PySide6.QtTest import QTest  # noqa: E402

from genmojo_studio import app, theme  # noqa: E402
from genmojo_studio.annotate.session import open_session  # noqa: E402
from genmojo_studio.annotate.steps import STEPS  # noqa: E402
from genmojo_studio.settings import Settings  # noqa: E402


def main(clip: Path, out: Path, sizes: list[tuple[int, int]]) -> None:
    """Open the clip in the app's window, do every step's work, grab it in all sizes and both themes."""
    application = app.make_application()
    window = app.make_window(application, Settings())
    window.resize(*sizes[0])
    window.show()
    window.show_workspace("annotate")
    annotate = window.workspaces["annotate"]
    annotate.open_with(open_session(window.state, clip, "Ada", Path(tempfile.mkdtemp()) / "a.genmojo"))
    while not annotate.objects.figures:
        QTest.qWait(50)
    for number, step in enumerate(STEPS):
        annotate.show_step(number)
        if number == 1:
            choose_all(annotate)
            place_points(annotate, each=5)
        if number == 2:
            fill(annotate)
            annotate.session.go(6)
        for name in ("dark", "light"):
            window.state.set(theme=name)
            theme.apply(application, name)
            for size in sizes:
                window.resize(*size)
                QTest.qWait(200)  # without a window manager a size arrives some time later
                window.settings.forget_layouts()
                annotate.restore_layout()  # as delivered for that size
                QTest.qWait(400)
                while not window.updatesEnabled():  # the theme dresses it in the ticks after it was chosen
                    QTest.qWait(50)
                scale = os.environ.get("QT_SCALE_FACTOR", "1")
                window.grab().save(str(out / f"{number + 1}-{step.name}-{size[0]}x{size[1]}-{name}-{scale}.png"))
                if (window.width(), window.height()) != size:
                    sys.stdout.write(f"wanted {size}, got {window.width()}x{window.height()}\n")
    window.close()


if __name__ == "__main__":
    Path(sys.argv[2]).mkdir(parents=True, exist_ok=True)
    pairs = [size.partition("x") for size in sys.argv[3:]]
    main(Path(sys.argv[1]), Path(sys.argv[2]), [(int(width), int(height)) for width, _, height in pairs])
