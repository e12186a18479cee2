"""A small procedural clip with masks and exact truth, and a workspace that has it open."""

import pytest

from genmojo_core.clip import synthetic, synthetic_files


@pytest.fixture(scope="session")
def clip_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("clip") / "crossing-shapes"
    clip, truth = synthetic.generate("crossing-shapes")
    synthetic_files.write(clip, truth, folder)
    return folder


@pytest.fixture
def workspace(qapp, qtbot, clip_folder, tmp_path):
    from genmojo_studio import shell_actions
    from genmojo_studio.actions import ActionTable
    from genmojo_studio.annotate.actions import ACTIONS
    from genmojo_studio.annotate.session import open_session
    from genmojo_studio.annotate.workspace import AnnotateWorkspace
    from genmojo_studio.menus import Menus
    from genmojo_studio.settings import Settings
    from genmojo_studio.state import AppState

    state = AppState()
    table = ActionTable([*shell_actions.ACTIONS, *ACTIONS])
    made = AnnotateWorkspace(state, table)
    Settings().forget_layouts()
    menus = Menus(made, table)  # so that keys work as in the app
    qtbot.addWidget(made)
    made.resize(1400, 860)
    made.show()
    made.activateWindow()  # keys reach only the active window
    qtbot.waitActive(made)
    made.open_with(open_session(state, clip_folder, "Ada", tmp_path / "a.genmojo"))
    menus.set_workspace("annotate")
    qtbot.waitUntil(lambda: bool(made.objects.figures), timeout=60_000)
    qtbot.waitUntil(lambda: made.screen_link.painted == 0, timeout=60_000)
    yield made
    made.close()
