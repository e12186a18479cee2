"""A whole job in the real window, with Qt on GLX and on EGL: demo clip, run, views, exports. Looks are for people:
set GENMOJO_SCREENSHOTS to a folder to keep the pictures."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]
_SCRIPT = Path(__file__).with_name("watching.py")


@pytest.mark.slow
@pytest.mark.timeout(900)
@pytest.mark.parametrize("integration", ["xcb_glx", "xcb_egl"])
def test_a_person_gets_from_the_demo_to_a_turntable(tmp_path, integration):
    if shutil.which("xvfb-run") is None:
        pytest.skip("no xvfb-run (packaging/debian-packages.txt)")
    folder = Path(os.environ.get("GENMOJO_SCREENSHOTS", tmp_path)) / integration
    environment = {
        **os.environ,
        "PYTHONPATH": str(_ROOT),
        "QT_XCB_GL_INTEGRATION": integration,
        **{name: str(tmp_path / name) for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "GENMOJO_RUNS")},
    }
    command = ["xvfb-run", "-a", "-s", "-screen 0 1920x1080x24", sys.executable, str(_SCRIPT), str(folder), "job"]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=880)
    assert run.returncode == 0, run.stderr[-3000:]
    figures = json.loads(run.stdout.strip().splitlines()[-1])
    assert not figures["torch"]
    assert figures["first_cloud"] < 30  # 3 s on an idle machine
    assert figures["picked"] > 0 and figures["steps"] > 10
    assert figures["gaussians"] > 1000 and figures["film"] > 2000 and figures["psnr"] > 15
