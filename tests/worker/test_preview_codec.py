"""Previews there and back: the snapshot is what the worker had; thousands of them leave nothing behind."""

from __future__ import annotations

import gc
import os

import numpy as np
import pytest

from genmojo_core.clip.cameras import Cameras
from genmojo_studio.view3d.snapshot import SnapshotObject
from genmojo_studio.worker.machine import memory
from genmojo_studio.worker.preview_bus import BusReader, BusWriter, size_of
from genmojo_studio.worker.preview_codec import Cloud, Layers, Setting, pack_layers, pack_now, unpack_now, with_layers


def cloud(count=200, moving=80, shift=0.0, seed=0):
    rng = np.random.default_rng(seed)
    means = rng.normal(size=(count, 3))
    means[:moving] += shift
    quats = rng.normal(size=(count, 4))
    quats /= np.linalg.norm(quats, axis=1, keepdims=True)
    owner = np.where(np.arange(count) < moving, 7, 0).astype(np.uint16)
    return Cloud(means, quats, np.exp(rng.normal(-3, 1, (count, 3))), rng.uniform(0, 1, count),
                 rng.uniform(0, 1, (count, 3)), owner, np.arange(count, dtype=np.uint64))  # fmt: skip


def setting(frames=3):
    lens = np.tile(np.array([[90.0, 0, 32], [0, 91, 24], [0, 0, 1]]), (frames, 1, 1))
    cameras = Cameras(lens, np.tile(np.eye(4), (frames, 1, 1)), (64, 48), 0.02, 50.0, 0.4)
    return Setting(frames, (SnapshotObject(7, "Bär", (1.0, 0.5, 0)),), cameras, np.array([0, -1.0, 0]), np.ones(3))


def through(bus_path, packed):
    """Packed arrays written and read back as a message."""
    meta, arrays = packed
    with BusWriter(bus_path, size_of(meta, arrays)) as bus:
        reader = BusReader(bus_path)
        bus.publish(meta, arrays)
        return reader.latest()


def test_a_snapshot_is_what_the_worker_had(tmp_path):
    now, known = cloud(), setting()
    got = unpack_now(through(tmp_path / "a.bus", pack_now(now, 2, "joint", 55, known)))
    assert (got.frame, got.stage, got.step, got.T, got.objects) == (2, "joint", 55, 3, known.objects)
    for ours, theirs in ((got.positions, now.means), (got.rotations, now.quats), (got.scales, now.scales),
                         (got.opacities, now.opacities), (got.colours, now.rgb)):  # fmt: skip
        np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-7)
    np.testing.assert_array_equal(got.uid, now.uid)
    np.testing.assert_array_equal(got.object_id, now.object_id)
    np.testing.assert_array_equal(got.cameras.K, known.cameras.K)
    assert (got.cameras.near, got.cameras.dilation, got.orbit_target.tolist()) == (0.02, 0.4, [1, 1, 1])


@pytest.mark.parametrize("bright", [False, True])
def test_layers_give_every_frame(tmp_path, bright):
    """Positions exactly, rotations and sizes as half floats, colours once unless they change; the background stands."""
    frames = [cloud(shift=0.1 * t) for t in range(3)]
    if bright:
        frames = [Cloud(**{**f.__dict__, "rgb": f.rgb * (1 + 0.2 * t)}) for t, f in enumerate(frames)]
    now = unpack_now(through(tmp_path / "a.bus", pack_now(frames[1], 1, "", 0, setting())))
    layers = Layers(through(tmp_path / "b.bus", pack_layers(frames, 9)))
    shown = with_layers(now, layers, 4)
    assert shown.version == 4 and layers.step == 9
    for t, frame in enumerate(frames):
        at = shown.at(t)
        np.testing.assert_allclose(at.positions, frame.means, rtol=1e-6, atol=1e-7)
        np.testing.assert_allclose(at.scales, frame.scales, rtol=5e-3)
        np.testing.assert_allclose(at.rotations, frame.quats, atol=1e-3)
        np.testing.assert_allclose(at.colours[:80], frame.rgb[:80], atol=2e-3)


def test_layers_of_other_gaussians_are_not_shown(tmp_path):
    layers = Layers(through(tmp_path / "b.bus", pack_layers([cloud(150)] * 3, 1)))
    now = unpack_now(through(tmp_path / "a.bus", pack_now(cloud(200), 0, "", 0, setting())))
    assert with_layers(now, layers, 1).frames is None and with_layers(now, None, 1).frames is None


@pytest.mark.skipif(not os.path.isdir("/proc/self/fd"), reason="counts open files through /proc")
def test_five_thousand_previews_leave_nothing_behind(tmp_path):
    """Memory and open files stay as they were, new and larger buses included."""
    packed = pack_now(cloud(5000, 2000), 0, "joint", 1, setting())

    def many(count):
        for i in range(count):
            if i % 250 == 0:
                writer = BusWriter(tmp_path / f"{i % 500}.bus", 2 * size_of(*packed))
                reader = BusReader(writer.path)
            writer.publish(*packed)
            assert len(unpack_now(reader.latest())) == 5000
            if i % 250 == 249:
                reader.close()
                writer.close()

    many(500)
    gc.collect()
    before, files = memory()["rss_mb"], len(os.listdir("/proc/self/fd"))
    many(5000)
    gc.collect()
    assert memory()["rss_mb"] - before < 30 and len(os.listdir("/proc/self/fd")) <= files + 2
