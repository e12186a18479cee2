"""A screen without a monitor, and programs with real windows run on it; each answers with one line of JSON."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@contextmanager
def screen() -> Iterator[str]:
    """The name of an X display of its own; skips where Xvfb is not installed."""
    program = shutil.which("Xvfb")
    if program is None:
        pytest.skip("Xvfb is not installed (Debian package xvfb)")
    read, write = os.pipe()
    server = subprocess.Popen(
        [program, "-displayfd", str(write), "-screen", "0", "1280x900x24", "-nolisten", "tcp"],
        pass_fds=(write,), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(write)
    try:
        with os.fdopen(read) as pipe:
            number = pipe.readline().strip()
        if not number:
            pytest.skip("Xvfb does not start here")
        yield f":{number}"
    finally:
        server.terminate()
        server.wait(timeout=10)


def run_window(display: str, integration: str, *arguments: str, timeout: float = 280, **environment: str) -> dict:
    """Run tests/view3d/window_program.py on a display with one of Qt's ways to OpenGL; its answer.

    `integration` is "xcb_glx", "xcb_egl" or "none". Skips where the program says that there is no driver.
    """
    env = {**os.environ, "DISPLAY": display, "QT_QPA_PLATFORM": "xcb", "QT_XCB_GL_INTEGRATION": integration,
           "PYTHONPATH": os.pathsep.join((str(ROOT), str(ROOT / "tests"))), **environment}  # fmt: skip
    program = [sys.executable, str(Path(__file__).with_name("window_program.py")), *arguments]
    ended = subprocess.run(program, env=env, capture_output=True, text=True, timeout=timeout, check=False, cwd=ROOT)
    if ended.returncode != 0:
        pytest.fail(f"exit code {ended.returncode}\n{ended.stdout[-2000:]}\n{ended.stderr[-4000:]}")
    answer = json.loads(ended.stdout.strip().splitlines()[-1])
    if "skip" in answer:
        pytest.skip(str(answer["skip"]))
    return answer
