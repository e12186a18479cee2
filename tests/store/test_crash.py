"""Scene files under kill -9 and full disks: a reader finds the old scene or the new one, nothing else."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from scenes import small_scene

from genmojo_core.errors import GenmojoError
from genmojo_core.store import scene_hdf5

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals and limits of POSIX")

WRITER = """
import sys, resource
from dataclasses import replace
from scenes import small_scene
from genmojo_core.errors import GenmojoError
from genmojo_core.store import scene_hdf5
mode, path = sys.argv[1:]
scene = small_scene(frames=6, per_object=800)
if mode == "loop":
    sys.stdout.write("ready\\n"); sys.stdout.flush()
    for i in range(10**6):
        scene_hdf5.write(replace(scene, metrics={"i": float(i)}), path)
else:
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(mode), int(mode)))
    import signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        scene_hdf5.write(scene, path)
    except GenmojoError as error:
        sys.stdout.write(error.sentence()); sys.exit(2)
"""


def start(mode: str, path: Path) -> subprocess.Popen:
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}{os.pathsep}{ROOT / 'tests'}"}
    return subprocess.Popen(
        [sys.executable, "-c", WRITER, mode, str(path)], stdout=subprocess.PIPE, env=environment, text=True
    )


@pytest.mark.slow
def test_kill_at_any_moment(tmp_path):
    """40 kill -9 at random moments of endless rewriting: the file is always whole."""
    path, dice = tmp_path / "scene.h5", random.Random(0)
    for _ in range(40):
        with start("loop", path) as child:
            child.stdout.readline()
            time.sleep(dice.uniform(0, 0.3))
            child.send_signal(signal.SIGKILL)
        if path.exists():
            assert scene_hdf5.validate(path) == []
    assert path.exists()


@pytest.mark.parametrize("limit", [0, 1000, 20000])
def test_full_disk(tmp_path, limit):
    """A file-size limit stands for a full disk: one sentence, exit 2, the old scene intact, no leftover."""
    path = tmp_path / "scene.h5"
    scene_hdf5.write(small_scene(frames=2), path)
    before = path.read_bytes()
    with start(str(limit), path) as child:
        said, code = child.communicate()[0], child.returncode
    assert code == 2 and "cannot be written" in said
    assert path.read_bytes() == before and os.listdir(tmp_path) == ["scene.h5"]


def test_read_only_folder(tmp_path):
    """Refused before work; root may write anywhere, so this needs a user."""
    folder = tmp_path / "locked"
    folder.mkdir()
    folder.chmod(0o500)
    if os.access(folder, os.W_OK):
        pytest.skip("this user may write everywhere")
    with pytest.raises(GenmojoError):
        scene_hdf5.write(small_scene(), folder / "scene.h5")
