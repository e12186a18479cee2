"""Scores against truth: a scene compared with pictures and tracks of itself is perfect, and each fault shows alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import small_scene

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.conventions import SH_C0
from genmojo_core.errors import GenmojoError
from genmojo_core.measure import truth
from genmojo_core.measure.reconstruction import matching_frames, reconstruction
from genmojo_core.measure.sheet import encode_png
from genmojo_core.measure.views import Look, orbit_target, orbit_view, render_frame
from genmojo_core.store.atomic import write_bytes
from genmojo_core.trackers import scene as scene_tracker
from genmojo_core.tracks.model import VISIBLE

ANGLES = [(0, 30), (30, 0), (0, 180)]


@pytest.fixture(scope="module")
def scene():
    return small_scene(size=(96, 72), per_object=400, turn=5.0)


@pytest.fixture(scope="module")
def clip(scene):
    """The clip that shows the scene, with its cameras and a depth."""
    pictures = [render_frame(scene, t, scene.cameras.view(t)) for t in range(4)]
    frames = np.stack([np.round(p.on() * 255).astype(np.uint8) for p in pictures])
    masks = np.stack([np.maximum(p.instance(), 0) for p in pictures]).astype(np.uint8)
    depth = np.stack([p.depth for p in pictures])
    return Clip(
        "discs", "procedural", frames, scene.frame_index, scene.seconds, scene.source_names, (96, 72),
        object_ids=np.array([1, 2]), object_names=("a", "b"),
        masks=Channel(masks, np.ones(masks.shape, bool), "given: test"),
        depth=Channel(depth, depth > 0, "given: test"),
        cameras=Channel(scene.cameras, np.ones(4, bool), "given: test"),
    )  # fmt: skip


@pytest.fixture(scope="module")
def truth_path(scene, tmp_path_factory):
    """truth.npz and novel/ in the layout of BLENDER.md, made from the scene itself."""
    folder, target = tmp_path_factory.mktemp("truth"), orbit_target(scene)
    poses = np.zeros((3, 4, 4, 4))
    for a, (elevation, azimuth) in enumerate(ANGLES):
        for t in range(4):
            view = orbit_view(scene, t, elevation, azimuth, target)
            poses[a, t] = view.world_to_camera
            rgba = render_frame(scene, t, view, Look(objects_only=True)).straight_rgba()
            write_bytes(folder / "novel" / f"{elevation}_{azimuth}" / f"{2 * t + 3:05d}.png", encode_png(rgba))
    tracks = scene_tracker.track(scene, np.zeros(3, int), np.array([[30.0, 36.0], [62.0, 38.0], [35.0, 30.0]]))
    visible = tracks.state == VISIBLE
    visible[2, 0] = False  # a point that is not asked for
    np.savez(folder / "truth.npz", tracks=tracks.xy, visible=visible, track_object=tracks.object,
             track_xyz=tracks.xyz, novel_angles=ANGLES, novel_world_to_camera=poses,
             novel_frames=[3, 5, 7, 9], orbit_centre=target)  # fmt: skip
    return folder / "truth.npz"


def test_a_scene_gives_its_own_clip_back(scene, clip):
    found = reconstruction(scene, clip)
    assert found["psnr"] > 45 and found["psnr_full"] > 45 and found["ssim"] > 0.99 and found["instance_iou"] == 1
    assert found["color_share_db"] == 0


def test_each_fault_of_a_scene_shows(scene, clip):
    """Wrong colour: PSNR only. Swapped objects: instance maps. Colour that explains the fit: color_share_db."""
    dark = reconstruction(replace(scene, dc=scene.dc - 0.5), clip)
    assert dark["psnr"] < 22 and dark["instance_iou"] == 1
    one, two = scene.objects[1:]
    swapped = replace(scene, objects=(scene.objects[0], replace(one, id=2), replace(two, id=1)))
    assert reconstruction(swapped, clip)["instance_iou"] == 0
    change = np.random.default_rng(0).choice([-0.5, 0.5], size=scene.dc.shape).astype(np.float32)
    painted = replace(scene, dc=scene.dc - change, d_dc=np.tile(change, (4, 1, 1)))
    found = reconstruction(painted, clip)
    assert found["psnr"] > 45 and found["color_share_db"] > 20


def test_a_change_of_light_is_not_a_change_of_colour(scene, clip):
    """Half the colour everywhere, made good by one gain: light_share_db, not color_share_db."""
    dark = ((0.5 * (0.5 + SH_C0 * scene.dc)) - 0.5) / SH_C0
    lit = replace(scene, dc=dark.astype(np.float32), d_dc=np.tile((scene.dc - dark).astype(np.float32), (4, 1, 1)))
    found = reconstruction(lit, clip)
    assert found["psnr"] > 45 and abs(found["color_share_db"]) < 0.01 and found["light_share_db"] > 5


def test_foreground_is_the_masks(scene, clip):
    """A wrong background costs the full frame, not the foreground."""
    frames = clip.frames.copy()
    frames[clip.masks.value == 0] //= 2
    found = reconstruction(scene, replace(clip, frames=frames))
    assert found["psnr"] > 45 and found["psnr_full"] < 25


def test_void_pixels_do_not_count(scene, clip):
    masks = np.where(clip.masks.value == 1, 2, clip.masks.value).astype(np.uint8)
    valid = clip.masks.value != 1
    found = reconstruction(scene, replace(clip, masks=Channel(masks, valid, "given: test")))
    assert found["instance_iou"] == 1


def test_frames_are_matched_by_number(scene, clip):
    """A scene of some frames finds them in the whole clip; another clip is refused."""
    part = replace(clip, frame_index=np.array([5, 3, 9, 7]))
    assert matching_frames(scene, part).tolist() == [1, 0, 3, 2]
    with pytest.raises(GenmojoError, match="no frame 9"):
        matching_frames(scene, replace(clip, frame_index=np.array([3, 5, 7, 8])))
    with pytest.raises(GenmojoError, match="was made from 96 x 72"):
        matching_frames(scene, replace(clip, source_size=(960, 720)))


def test_unseen_views_of_itself(scene, clip, truth_path):
    found = truth.novel_scores(scene, clip, truth_path)
    assert found["novel_cameras"] == "given" and set(found["novel"]) == {"0_30", "30_0", "0_180"}
    assert found["novel_iou"] > 0.99 and found["novel_psnr_inside"] > 38
    assert all(row["psnr_white"] > 38 and row["ssim_white"] > 0.98 for row in found["novel"].values())


def test_estimated_cameras_use_the_scenes_own_orbit(scene, clip, truth_path):
    """Without given cameras the world is another: views are taken by angle, space errors after a fit."""
    estimated = replace(clip, cameras=Channel(scene.cameras, np.ones(4, bool), "estimated: test"))
    moved = replace(scene, object_to_world=_scaled(scene.object_to_world, 2.0),
                    cameras=_scaled_cameras(scene, 2.0))  # fmt: skip
    found = truth.novel_scores(moved, estimated, truth_path)
    assert found["novel_cameras"] == "orbit" and found["novel_iou"] > 0.95
    scores = truth.track_scores(moved, estimated, truth_path)
    assert scores["ate"] < 0.1 and scores["ate_3d_raw"] > 1 and scores["ate_3d"] < 0.05
    assert scores["fit_scale"] == pytest.approx(0.5, rel=0.02)


def test_shape_and_colour_are_scored_apart(scene, clip, truth_path):
    """Grey objects keep their silhouettes; a missing object keeps its colours."""
    grey = truth.novel_scores(replace(scene, dc=scene.dc * 0), clip, truth_path)
    assert grey["novel_iou"] > 0.99 and grey["novel_psnr_inside"] < 15
    opacity = scene.opacity.copy()
    opacity[scene.objects[2].first :] = 0
    half = truth.novel_scores(replace(scene, opacity=opacity), clip, truth_path)
    assert half["novel_iou"] < 0.75 and half["novel_psnr_inside"] > grey["novel_psnr_inside"] + 10


def test_another_light_is_told_from_other_colours(scene, clip, truth_path):
    """Every colour 20 % darker: one factor of brightness makes up for it; grey in place of colours stays wrong."""
    darker = truth.novel_scores(replace(scene, dc=0.8 * scene.dc - 0.1 / SH_C0), clip, truth_path)
    for row in darker["novel"].values():
        assert row["psnr_inside"] < 30 and row["psnr_levelled"] > 38
    grey = truth.novel_scores(replace(scene, dc=scene.dc * 0), clip, truth_path)
    assert all(row["psnr_levelled"] < 18 for row in grey["novel"].values())


def test_tracks_of_itself(scene, clip, truth_path):
    """Only points visible in frame 0 are asked; all figures of the contract are there."""
    found = truth.track_scores(scene, clip, truth_path)
    assert found["tracks"] == 2 and found["ate"] < 1e-3 and found["aj"] == 100 and found["ate_3d"] < 1e-4
    assert {"ate", "mte", "a_epe", "m_epe", "aj", "delta", "oa", "ate_3d"} <= set(found)
    by_object = found["track_objects"]
    assert sum(one["tracks"] for one in by_object.values()) == 2
    assert all(one["ate"] < 1e-3 and one["oa"] == 100 for one in by_object.values())


def test_truth_of_another_length_is_refused(scene, clip, truth_path):
    long = replace(clip, frames=np.concatenate([clip.frames] * 2), frame_index=np.arange(8) + 3)
    with pytest.raises(GenmojoError, match="tracks over 4 frames"):
        truth.track_scores(scene, long, truth_path)


def test_ignored_channels_share_no_world(scene, clip):
    assert truth.shares_world(scene, clip)
    assert not truth.shares_world(replace(scene, config={"ignore": ["depth"]}), clip)
    assert not truth.shares_world(scene, replace(clip, depth=None))


def _scaled(placement: np.ndarray, factor: float) -> np.ndarray:
    return placement * np.float32(factor)


def _scaled_cameras(scene, factor: float):
    poses = scene.cameras.world_to_camera.copy()
    poses[:, :3, 3] *= factor
    return replace(scene.cameras, world_to_camera=poses)
