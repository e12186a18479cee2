"""Exports in a second process: each kind, progress, cancel that leaves nothing, faults in one sentence."""

from __future__ import annotations

import os
import signal
import time

import cv2
import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication
from scenes import small_scene

from genmojo_core.clip.camera_path import CameraPath, key_of
from genmojo_core.measure.views import render_frame
from genmojo_core.store import camera_paths, ply, scene_hdf5
from genmojo_studio.export.program import export
from genmojo_studio.export.request import ExportRequest
from genmojo_studio.worker.jobs import ExportJob
from tests.worker.driving import application


@pytest.fixture(scope="module")
def scene_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "scene.h5"
    scene_hdf5.write(small_scene(), path)
    return str(path)


def outcome(job, request, meanwhile=None, seconds=120):
    """Start a job and wait for its end: which signal came, with what, and all progress told."""
    application()
    heard, shares = [], []
    job.progress.connect(shares.append)
    job.finished.connect(lambda result: heard.append(("finished", result)))
    job.failed.connect(lambda sentence: heard.append(("failed", sentence)))
    job.cancelled.connect(lambda: heard.append(("cancelled", None)))
    job.start(request)
    end = time.monotonic() + seconds
    while not heard and time.monotonic() < end:
        QCoreApplication.processEvents()
        time.sleep(0.005)
        if meanwhile is not None and meanwhile(job, shares):
            meanwhile = None
    assert len(heard) == 1, heard
    return (*heard[0], shares)


def test_a_turntable_with_progress(scene_path, tmp_path):
    request = ExportRequest("turntable", scene_path, str(tmp_path / "t.mp4"), seconds=1.0, fps=8)
    kind, result, shares = outcome(ExportJob(), request)
    assert kind == "finished" and result["files"] == [str(tmp_path / "t.mp4")] and os.path.getsize(result["path"]) > 500
    assert shares[-1] == 1.0 and shares == sorted(shares)


def test_cancel_leaves_nothing(scene_path, tmp_path):
    request = ExportRequest("turntable", scene_path, str(tmp_path / "t"), seconds=1000, short_side=200)

    def cancel(job, shares):
        if sum(s > 0 for s in shares) > 1:
            job.cancel()
            return True
        return False

    assert outcome(ExportJob(), request, cancel)[0] == "cancelled"
    assert not list((tmp_path / "t").glob("*"))


def test_faults_are_one_sentence_and_death_is_noticed(scene_path, tmp_path):
    kind, sentence, _ = outcome(ExportJob(), ExportRequest("ply", scene_path + "x", str(tmp_path / "a.ply")))
    assert kind == "failed" and sentence.count("\n") == 0 and "scene.h5x" in sentence
    request = ExportRequest("turntable", scene_path, str(tmp_path / "t"), seconds=1000, short_side=200)

    def kill(job, shares):
        if len(shares) > 2:
            os.kill(job._process.processId(), signal.SIGTERM)
            return True
        return False

    kind, sentence, _ = outcome(ExportJob(), request, kill)
    assert kind == "failed" and "could not be finished" in sentence


def test_every_other_kind(scene_path, tmp_path):
    scene, shares = small_scene(), []
    made = export(ExportRequest("ply", scene_path, str(tmp_path / "a.ply"), frame=1, objects=[1]), shares.append)
    assert len(ply.read(made["path"])) == 60
    made = export(ExportRequest("ply-sequence", scene_path, str(tmp_path / "s")), shares.append)
    assert len(made["files"]) == 4
    path = CameraPath("p", (key_of(scene.cameras.view(0), 0.0, 0.0), key_of(scene.cameras.view(0), 3.0, 1.0)))
    made = export(ExportRequest("hdf5", scene_path, str(tmp_path / "b.h5"), paths=[path.to_json()]), shares.append)
    assert camera_paths.read_paths(made["path"])[0].to_json() == path.to_json()
    request = ExportRequest("path", scene_path, str(tmp_path / "p"), path=path.to_json(), fps=3, mode="depth")
    assert len(export(request, shares.append)["files"]) == 4
    request = ExportRequest("frames", scene_path, str(tmp_path / "f"), azimuth=20, transparent=True, short_side=32)
    made = export(request, shares.append)
    assert [os.path.basename(f) for f in made["files"]] == [f"{i:05d}.png" for i in scene.frame_index]
    assert cv2.imread(made["files"][0], cv2.IMREAD_UNCHANGED).shape == (32, 43, 4)


def test_a_picture_is_what_the_view_showed(scene_path, tmp_path):
    """The pose and field of view of the input camera give the input view; at twice the size, twice the pixels."""
    scene = small_scene()
    view = scene.cameras.view(2)
    key = key_of(view, 2.0, 0.0)
    camera = {"world_to_camera": key.world_to_camera.tolist(), "fov": key.fov}
    request = ExportRequest("picture", scene_path, str(tmp_path / "a.png"), frame=2, camera=camera, size=[64, 48])
    made = cv2.imread(export(request, lambda share: None)["path"])[..., ::-1]
    wanted = render_frame(scene, 2, view).on() * 255
    assert np.abs(made - wanted).mean() < 1
    large = ExportRequest("picture", scene_path, str(tmp_path / "b.png"), frame=2, camera=camera, size=[128, 96])
    assert cv2.imread(export(large, lambda share: None)["path"]).shape == (96, 128, 3)
