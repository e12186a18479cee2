"""Real windows: on an X server without a screen where there is no other. Settings and runs of tests lie apart."""

import gc
import os
import shutil
import subprocess
import sys
import tempfile

import pytest

_SERVER = None


def _start_screen():
    """An X server for this session; the tests skip where there is none."""
    global _SERVER
    if not sys.platform.startswith("linux") or os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        return
    if shutil.which("Xvfb") is None:
        pytest.skip("no screen and no Xvfb (packaging/debian-packages.txt)", allow_module_level=True)
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1920x1080x24", "-nolisten", "tcp"]
    _SERVER = subprocess.Popen(command, pass_fds=(write,), stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as stream:
        os.environ["DISPLAY"] = f":{stream.readline().strip()}"


@pytest.fixture(scope="session")
def qapp():
    _start_screen()
    home = tempfile.mkdtemp(prefix="genmojo-ui-")
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"):
        os.environ[name] = f"{home}/{name}"
    from PySide6.QtWidgets import QApplication

    from genmojo_studio import app

    application = QApplication.instance() or app.make_application()
    yield application
    shutil.rmtree(home, ignore_errors=True)


def pytest_sessionfinish():
    if _SERVER is not None:
        _SERVER.terminate()
        _SERVER.wait(5)


@pytest.fixture(autouse=True)
def _windows_die_in_their_own_thread():
    """As in the app (garbage.py): closed windows are cycles, collected by the thread that made them."""
    gc.disable()
    yield
    gc.unfreeze()
    gc.collect()
    gc.enable()


@pytest.fixture(autouse=True)
def told(monkeypatch, tmp_path):
    """Dialogs would wait for a person: what they would say is collected instead, as (title, text)."""
    from genmojo_studio import notify

    said = []
    monkeypatch.setattr(notify, "show_dialog", lambda _parent, title, text, _details: said.append((title, text)))
    monkeypatch.setenv("GENMOJO_RUNS", str(tmp_path / "runs"))
    return said


@pytest.fixture
def window(qapp, qtbot):
    from genmojo_studio import app
    from genmojo_studio.settings import Settings

    settings = Settings()
    made = app.make_window(qapp, settings)
    qtbot.addWidget(made)
    made.resize(1400, 850)
    made.show()
    qtbot.waitExposed(made)
    yield made
    made.close()
