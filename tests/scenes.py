"""Small scenes made in numpy, for tests of files, tracks, views and commands."""

from __future__ import annotations

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.conventions import matrix_to_quaternion, normalise_quaternions, rgb_to_dc
from genmojo_core.store.scene_file import BakedScene, SceneObject


def small_scene(
    frames: int = 4,
    size: tuple[int, int] = (64, 48),
    per_object: int = 60,
    background: bool = True,
    shift: float = 0.1,
    turn: float = 0.0,
    seed: int = 0,
) -> BakedScene:
    """Two flat discs of opaque Gaussians before a wall; disc k moves `shift` scene units a frame to the right (disc 0)
    or left (disc 1) and turns `turn` degrees a frame about the camera axis. Disc 0 is nearer (z = 4) than disc 1 (5).
    """
    rng = np.random.default_rng(seed)
    width, height = size
    discs = [(1, (1.0, 0.0, 0.0), (-0.6, 0.0, 4.0)), (2, (0.0, 1.0, 0.0), (0.7, 0.1, 5.0))]
    objects, xyz, rgb, scale, ids = [], [], [], [], []
    if background:
        grid = np.stack(np.meshgrid(np.linspace(-6, 6, 13), np.linspace(-5, 5, 11)), axis=-1).reshape(-1, 2)
        objects.append(SceneObject(0, "background", (0.5, 0.5, 0.5), True, 0, len(grid)))
        xyz.append(np.concatenate([grid, np.full((len(grid), 1), 8.0)], axis=1))
        rgb.append(np.tile([0.2, 0.3, 0.8], (len(grid), 1)))
        scale.append(np.full((len(grid), 3), [0.7, 0.7, 0.05]))
        ids.append(np.zeros(len(grid), int))
    for number, color, _ in discs:
        radius, angle = 0.5 * np.sqrt(rng.random(per_object)), rng.random(per_object) * 2 * np.pi
        points = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros(per_object)], axis=-1)
        objects.append(SceneObject(number, f"disc {number}", color, False, sum(map(len, xyz)), per_object))
        xyz.append(points)
        rgb.append(np.clip(np.array(color) + rng.normal(0, 0.05, (per_object, 3)), 0, 1))
        scale.append(np.full((per_object, 3), [0.12, 0.12, 0.02]))
        ids.append(np.full(per_object, number))
    count, objects_count = sum(map(len, xyz)), len(objects)
    placement = np.tile(np.eye(4)[:3], (frames, objects_count, 1, 1))
    for t in range(frames):
        a = np.deg2rad(turn * t)
        rotation = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
        for k, (_, _, centre) in enumerate(discs):
            row = k + int(background)
            placement[t, row, :, :3] = rotation
            placement[t, row, :, 3] = np.array(centre) + [shift * t * (1 if k == 0 else -1), 0, 0]
    lens = np.array([[1.2 * width, 0, width / 2], [0, 1.2 * width, height / 2], [0, 0, 1]])
    quats = np.tile([1.0, 0, 0, 0], (count, 1)).astype(np.float32)
    return BakedScene(
        frame_index=np.arange(frames) * 2 + 3,
        seconds=np.arange(frames) / 24.0,
        source_names=tuple(f"{2 * t + 3:05d}.jpg" for t in range(frames)),
        objects=tuple(objects),
        xyz=np.concatenate(xyz).astype(np.float32),
        rot=quats,
        scale=np.concatenate(scale).astype(np.float32),
        opacity=np.full(count, 0.9, np.float32),
        dc=rgb_to_dc(np.concatenate(rgb)).astype(np.float32),
        uid=np.arange(count, dtype=np.uint64) + 7,
        d_xyz=np.zeros((frames, count, 3), np.float32),
        rot_t=np.tile(quats, (frames, 1, 1)),
        log_scale_t=np.zeros((frames, count, 3), np.float32),
        object_to_world=placement.astype(np.float32),
        depth_scale=np.ones((frames, objects_count), np.float32),
        cameras=Cameras(np.tile(lens, (frames, 1, 1)), np.tile(np.eye(4), (frames, 1, 1)), size),
        ref_frame=np.zeros(objects_count, np.int64),
        world_up=np.array([0.0, -1.0, 0.0]),
        supervised=np.array([[0, 0, t] for t in range(frames)], np.float32),
        config={"preset": "draft", "seed": 0},
        effects=[{"name": "background", "on": background}],
        curve=[{"seconds": 1.0, "psnr": 20.0}],
        metrics={"psnr": 20.0},
        created_utc="2026-01-01T00:00:00Z",
        run_uuid="test",
        generator="test",
    )


def messy_scene(seed: int = 1) -> BakedScene:
    """A scene with every array full of random values: turned, scaled, deforming, changing colour."""
    from dataclasses import replace

    scene = small_scene(frames=3, seed=seed)
    rng = np.random.default_rng(seed)
    frames, count, k = 3, len(scene.xyz), len(scene.objects)
    placement = np.empty((frames, k, 3, 4), np.float32)
    for t in range(frames):
        for row in range(k):
            q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
            q *= np.sign(np.linalg.det(q))
            placement[t, row] = np.concatenate([q * rng.uniform(0.5, 2), rng.normal(size=(3, 1))], axis=1)
    return replace(
        scene,
        rot=normalise_quaternions(rng.normal(size=(count, 4))).astype(np.float32),
        d_xyz=rng.normal(0, 0.1, (frames, count, 3)).astype(np.float32),
        rot_t=normalise_quaternions(rng.normal(size=(frames, count, 4))).astype(np.float32),
        log_scale_t=rng.normal(0, 0.1, (frames, count, 3)).astype(np.float32),
        d_dc=rng.normal(0, 0.1, (frames, count, 3)).astype(np.float32),
        object_to_world=placement,
        depth_scale=rng.uniform(0.5, 2, (frames, k)).astype(np.float32),
    )


__all__ = ["matrix_to_quaternion", "messy_scene", "small_scene"]
