"""kill -9 during edits: every acknowledged edit is there afterwards, and every project opens.

Proves that rows are whole and in order. A kill cannot tell a missing fsync (the page cache survives), so that one is
asked of SQLite: the project is written with WAL and synchronous=FULL.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from genmojo_core.store import project_db, project_file
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.annotation import ObjectInfo

HERE = Path(__file__).parent
ROOT = HERE.parents[1]


def killed_once(path: Path, seed: int, delay: float) -> tuple[int, str]:
    """Let the child edit for `delay` seconds after its first acknowledgement, kill it; the last acknowledged row."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "tests")])}
    command = [sys.executable, str(HERE / "editing_child.py"), str(path), str(seed)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=environment) as child:
        first = child.stdout.readline()
        time.sleep(delay)
        child.send_signal(signal.SIGKILL)
        said = first + child.stdout.read()
    whole = [line.split() for line in said.decode().splitlines(keepends=True) if line.endswith("\n")]
    return int(whole[-1][0]), whole[-1][1]


def check_kills(path: Path, kills: int) -> None:
    """Kill again and again on one growing project."""
    project = Project.create(path, info_of(24, (640, 480)))
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    for number in range(3):
        project.do(edit_tracks.add_track(project.annotation, 1, number + 1))
    project.close()
    rng = np.random.default_rng(0)
    for turn in range(kills):
        seq, digest = killed_once(path, turn, float(rng.uniform(0, 0.15)))
        loaded = project_file.load(path)
        assert len(loaded.log) >= seq, "an acknowledged edit is lost"
        if len(loaded.log) == seq and digest != "move":
            assert loaded.annotation.digest() == digest
        assert project_file.verify(path) == []


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
@pytest.mark.timeout(240)
def test_no_acknowledged_edit_is_lost_when_the_program_is_killed(tmp_path: Path) -> None:
    check_kills(tmp_path / "p.genmojo", 8)


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_two_hundred_kills(tmp_path: Path) -> None:
    check_kills(tmp_path / "p.genmojo", 200)


def test_commits_reach_the_disk_not_only_the_page_cache(tmp_path: Path) -> None:
    Project.create(tmp_path / "p.genmojo", info_of(2, (8, 8))).close()
    connection = project_db.connect(tmp_path / "p.genmojo")
    assert connection.execute("PRAGMA synchronous").fetchone()[0] == 2
    assert connection.execute("PRAGMA journal_mode").fetchone()[0] == "wal"
    connection.close()


def test_network_paths_are_told_from_local_ones() -> None:
    assert project_db.is_remote(Path("//server/share/p.genmojo"))
    assert not project_db.is_remote(Path.cwd() / "p.genmojo")
