"""The effect plan: each effect is called for by what a clip shows, told in numbers, and obeys the user.

Clips are made here from formulas, so what they show is known. The shared clips check the thresholds on real pixels.
Not covered: whether the predicted costs are right (the model is stated to be within a factor of two).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.config import preset
from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.effects.decide import NAMES, parse_overrides, plan
from genmojo_core.effects.evidence import camera_shift, longest_gap
from genmojo_core.effects.light import light_change
from genmojo_core.effects.objects import canonical_frame, describe
from genmojo_core.effects.occlusion import occlusion_graph
from genmojo_core.effects.sample import sample
from genmojo_core.effects.shape import bending, fourth_mode
from genmojo_core.effects.sides import unseen_share
from genmojo_core.errors import GenmojoError

SIDE, FRAMES = 128, 12
DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data"
CONFIG = preset("draft")


def texture(seed: int, side: int = 3 * SIDE) -> np.ndarray:
    """Smooth random picture, RGB, brightness around 120."""
    noise = np.random.default_rng(seed).normal(size=(side, side, 3)).astype(np.float32)
    smooth = cv2.GaussianBlur(noise, (0, 0), 2.0)
    return np.clip(120 + 45 * smooth / smooth.std(), 30, 220).astype(np.float32)


def make_clip(places: np.ndarray, sides: tuple[int, ...], gains: np.ndarray | None = None) -> Clip:
    """Squares of the given sides on a still background; `places` (K, T, 2) are centres in px, later objects in front.

    Masks, flow and depth are exact; the camera stands still.
    """
    count, frames = places.shape[:2]
    gains = np.ones(frames) if gains is None else gains
    y, x = np.mgrid[:SIDE, :SIDE].astype(np.float32)
    rgb = np.tile(texture(0)[:SIDE, :SIDE], (frames, 1, 1, 1))
    labels = np.zeros((frames, SIDE, SIDE), np.uint8)
    flow = np.zeros((frames, SIDE, SIDE, 2), np.float32)
    depth = np.full((frames, SIDE, SIDE), 10.0, np.float32)
    for k in range(count):
        coat = texture(k + 1)
        for t in range(frames):
            dx, dy = x - np.float32(places[k, t, 0]), y - np.float32(places[k, t, 1])
            inside = (np.abs(dx) < sides[k] / 2) & (np.abs(dy) < sides[k] / 2)
            looks = cv2.remap(coat, dx + 1.5 * SIDE, dy + 1.5 * SIDE, cv2.INTER_LINEAR)
            rgb[t][inside], labels[t][inside], depth[t][inside] = looks[inside], k + 1, 5.0 - k
            flow[t][inside] = places[k, min(t + 1, frames - 1)] - places[k, t]
    rgb *= gains[:, None, None, None]
    everywhere = np.ones(labels.shape, bool)
    valid = everywhere.copy()
    valid[-1] = False
    pose = np.tile(np.eye(4), (frames, 1, 1))
    lens = np.tile(np.array([[150.0, 0, SIDE / 2], [0, 150.0, SIDE / 2], [0, 0, 1]]), (frames, 1, 1))
    return Clip(
        name="made", path="procedural", frames=np.clip(rgb, 0, 255).astype(np.uint8), frame_index=np.arange(frames),
        seconds=np.arange(frames) / 24, source_names=tuple(map(str, range(frames))), source_size=(SIDE, SIDE),
        object_ids=np.arange(1, count + 1), object_names=tuple(f"square {k + 1}" for k in range(count)),
        masks=Channel(labels, everywhere, "given: formula"), flow=Channel(flow, valid, "estimated: formula"),
        depth=Channel(depth, everywhere, "estimated: formula"),
        cameras=Channel(Cameras(lens, pose, (SIDE, SIDE)), np.ones(frames, bool), "given: formula"),
    )  # fmt: skip


def line(start: tuple[float, float], end: tuple[float, float], frames: int = FRAMES) -> np.ndarray:
    return np.linspace(start, end, frames)


def two_apart(**kwargs: np.ndarray) -> Clip:
    return make_clip(np.stack([line((30, 30), (60, 40)), line((90, 95), (70, 90))]), (32, 32), **kwargs)


def two_crossing() -> Clip:
    return make_clip(np.stack([line((28, 64), (100, 64)), line((100, 64), (28, 64))]), (32, 40))


def test_rigid_objects_under_still_light_and_camera_call_for_little() -> None:
    decided = plan(two_apart(), CONFIG)
    off = {"joint_occlusion", "camera_motion", "non_rigid_motion", "appearance_change", "shading", "unseen_views",
           "reappearance"}  # fmt: skip
    assert {effect.name for effect in decided.effects if not effect.on} == off
    assert decided.get("non_rigid_motion").settings == {"motion_bases": 0}


def test_plan_has_every_effect_once_with_number_reason_and_cost() -> None:
    decided = plan(two_crossing(), replace(CONFIG, prior="embedded"))
    assert tuple(effect.name for effect in decided.effects) == NAMES
    for effect in decided.effects:
        assert np.isfinite([effect.evidence, effect.threshold, effect.ms_per_step, effect.mb]).all(), effect
        assert effect.ms_per_step >= 0 and effect.mb >= 0 and effect.unit and effect.origin, effect
        assert effect.reason.endswith(".") and effect.reason[0].isupper() or effect.reason[0] == "'" or (
            effect.reason[0].isdigit()), effect  # fmt: skip
        assert effect.on == (effect.evidence >= effect.threshold), effect


def test_crossing_objects_call_for_joint_occlusion() -> None:
    clip = two_crossing()
    effect = plan(clip, CONFIG).get("joint_occlusion")
    touching = sum(abs(28 + 72 * t / 11 - (100 - 72 * t / 11)) <= 36 + 2 for t in range(FRAMES))
    assert effect.on and effect.evidence == pytest.approx(100 * touching / FRAMES, abs=9)


def test_who_covers_whom_is_told_by_depth_and_without_it() -> None:
    """The second square is in front (nearer, drawn over the first); both ways of telling agree on most frames."""
    clip = two_crossing()
    given = replace(clip, depth=replace(clip.depth, source="given: formula"))
    touching = [t for t in range(FRAMES) if abs(28 + 72 * t / 11 - (100 - 72 * t / 11)) <= 36 + 2]
    cover, *others = occlusion_graph(given)
    assert not others and (cover.front, cover.back) == (1, 0) and set(touching) >= set(cover.frames) != set()
    guessed = {c.front: len(c.frames) for c in occlusion_graph(clip)}
    assert guessed.get(1, 0) > guessed.get(0, 0)
    assert "'square 2' covers 'square 1'" in plan(given, CONFIG).get("joint_occlusion").reason
    assert occlusion_graph(two_apart()) == ()


def test_dimming_light_is_measured_and_called_for() -> None:
    gains = np.linspace(1.0, 0.5, FRAMES)
    assert light_change(two_apart(gains=gains)).background == pytest.approx(0.5, abs=0.03)
    assert plan(two_apart(gains=gains), CONFIG).on("appearance_change")


def test_slow_dimming_below_one_grey_level_a_frame_is_seen() -> None:
    """A median of 8-bit ratios would say that nothing changes."""
    frames = 40
    places = np.stack([line((30, 30), (60, 40), frames)])
    clip = make_clip(places, (32,), gains=np.linspace(1.0, 0.85, frames))
    assert light_change(clip).background == pytest.approx(0.15, abs=0.03)


def test_moving_camera_is_measured_in_pixels_of_the_background() -> None:
    clip = two_apart()
    pose = clip.cameras.value.world_to_camera.copy()
    pose[:, 0, 3] = np.linspace(0, 0.4, FRAMES)  # background at depth 10, focal length 150: 6 px
    moved = replace(clip, cameras=replace(clip.cameras, value=replace(clip.cameras.value, world_to_camera=pose)))
    assert camera_shift(moved) == pytest.approx(6.0, rel=0.02)
    assert plan(moved, CONFIG).get("camera_motion").evidence == pytest.approx(12.0, rel=0.02)  # at 256
    assert plan(moved, CONFIG).on("camera_motion")


def bent_tracks(amount: float, points: int = 80, frames: int = 8) -> np.ndarray:
    """A turning body of 100 px seen by a far camera; its ends bend up by `amount` of its size."""
    body = np.random.default_rng(1).uniform(-50, 50, (points, 3))
    result = []
    for t in range(frames):
        angle, bend = 0.05 * t, amount * 100 * np.sin(0.8 * t)
        moved = body + np.stack([np.zeros(points), bend * (body[:, 0] / 50) ** 2, np.zeros(points)], axis=1)
        turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
        result.append((moved @ turn.T)[:, :2] + [3 * t, t])
    return np.stack(result, axis=1)


def test_turning_rigid_body_has_no_fourth_mode() -> None:
    assert fourth_mode(bent_tracks(0.0)) == pytest.approx(0.0, abs=1e-6)


def test_fourth_mode_grows_with_bending() -> None:
    small, large = fourth_mode(bent_tracks(0.02)), fourth_mode(bent_tracks(0.08))
    assert 0.3 < small < 2.0 and large == pytest.approx(4 * small, rel=0.3)


def test_stray_tracks_do_not_make_a_rigid_body_bend() -> None:
    tracks = bent_tracks(0.0)
    tracks[:6] += np.random.default_rng(2).normal(0, 20, tracks[:6].shape)
    assert fourth_mode(tracks) < 0.05


def test_bending_outline_calls_for_non_rigid_motion() -> None:
    """A bar without usable flow that curves: only its outline tells."""
    clip = make_clip(np.stack([line((64, 64), (64, 64))]), (20,))
    y, x = np.mgrid[:SIDE, :SIDE]
    labels = np.stack([(np.abs(x - 64) < 45) & (np.abs(y - 64 - bend * ((x - 64) / 45.0) ** 2) < 12)
                       for bend in np.linspace(0, 30, FRAMES)]).astype(np.uint8)  # fmt: skip
    blind = Channel(clip.flow.value, np.zeros(labels.shape, bool), "estimated: none")
    bent = replace(clip, masks=replace(clip.masks, value=labels), flow=blind)
    effect = plan(bent, CONFIG).get("non_rigid_motion")
    assert effect.on and effect.settings["motion_bases"] >= 4 and "square 1" in effect.reason


def test_only_the_objects_that_bend_are_simulated_as_bending() -> None:
    """Of two bars without usable flow one curves; the other slides along, and costs nothing by it."""
    clip = make_clip(np.stack([line((64, 64), (64, 64)), line((20, 20), (40, 20))]), (20, 10))
    y, x = np.mgrid[:SIDE, :SIDE]
    bends = [(np.abs(x - 64) < 45) & (np.abs(y - 84 - bend * ((x - 64) / 45.0) ** 2) < 8)
             for bend in np.linspace(0, 20, FRAMES)]  # fmt: skip
    slides = [(np.abs(x - 40 - move) < 20) & (np.abs(y - 20) < 10) for move in np.linspace(0, 30, FRAMES)]
    labels = np.where(bends, 1, np.where(slides, 2, 0)).astype(np.uint8)
    blind = Channel(clip.flow.value, np.zeros(labels.shape, bool), "estimated: none")
    two = replace(clip, masks=replace(clip.masks, value=labels), flow=blind)
    decided = plan(two, CONFIG)
    effect, by_hand = decided.get("non_rigid_motion"), plan(two, CONFIG, {"non_rigid_motion": True})
    assert effect.on and effect.spared == (2,) and "Rigid all the same: square 2." in effect.reason
    assert decided.on_object("non_rigid_motion", 1) and not decided.on_object("non_rigid_motion", 2)
    assert by_hand.get("non_rigid_motion").spared == ()  # the user's word is for all
    assert effect.ms_per_step == pytest.approx(0.5 * by_hand.get("non_rigid_motion").ms_per_step)


@settings(max_examples=10, deadline=None, phases=(Phase.explicit, Phase.generate), derandomize=True)
@given(st.floats(-25, 25), st.floats(-0.03, 0.03), st.floats(-4, 4))
@example(6.0, 0.0, 0.0)  # turned by 42 degrees within a window: was taken for bending
def test_similarity_motion_never_bends(degrees: float, growth: float, speed: float) -> None:
    """A square that turns, grows and moves in the image plane is rigid whatever the amounts."""
    y, x = np.mgrid[:SIDE, :SIDE].astype(np.float64)
    frames, labels, flow = 8, [], []
    for t in range(frames):
        c, s = np.cos(np.deg2rad(degrees)) * (1 + growth), np.sin(np.deg2rad(degrees)) * (1 + growth)
        here = np.array([64 + speed * (t - 4), 64.0])
        dx, dy = x - here[0], y - here[1]
        flow.append(np.stack([c * dx - s * dy + here[0] + speed - x, s * dx + c * dy + here[1] - y], axis=-1))
        back = np.linalg.matrix_power(np.array([[c, s], [-s, c]]) / (c * c + s * s), t)
        u, v = back[0, 0] * dx + back[0, 1] * dy, back[1, 0] * dx + back[1, 1] * dy
        labels.append((np.abs(u) < 25) & (np.abs(v) < 18))
    clip = make_clip(np.zeros((1, frames, 2)), (10,))
    clip = replace(clip, masks=replace(clip.masks, value=np.stack(labels).astype(np.uint8)),
                   flow=replace(clip.flow, value=np.stack(flow).astype(np.float32)))  # fmt: skip
    score = bending(clip, 0, describe(clip)[0]).score  # apart, so that a failure does not print the clip
    assert score < 1.0


def test_object_that_vanishes_and_comes_back_is_counted() -> None:
    clip = two_apart()
    labels = clip.masks.value.copy()
    labels[4:7][labels[4:7] == 2] = 0
    effect = plan(replace(clip, masks=replace(clip.masks, value=labels)), CONFIG).get("reappearance")
    assert effect.on and effect.evidence == 3


@pytest.mark.parametrize(
    ("seen", "gap"), [([1, 1, 1], 0), ([1, 0, 0, 1], 2), ([0, 0, 1, 1], 0), ([1, 0], 0), ([0, 0], 0), ([], 0)]
)
def test_longest_gap(seen: list[int], gap: int) -> None:
    assert longest_gap(np.array(seen, float)) == gap


def test_one_object_needs_no_labels() -> None:
    assert not plan(make_clip(np.stack([line((40, 40), (70, 70))]), (30,)), CONFIG).on("instance_labels")


def test_still_image_has_no_motion_of_any_kind() -> None:
    decided = plan(make_clip(np.array([[[50.0, 50.0]], [[80.0, 80.0]]]), (24, 24)), CONFIG)
    moving = ("camera_motion", "non_rigid_motion", "appearance_change", "flow", "track_supervision", "reappearance")
    assert not any(decided.on(name) for name in moving)
    assert decided.on("instance_labels") and decided.on("background")


def test_clip_without_depth_flow_and_cameras_is_planned() -> None:
    bare = replace(two_apart(), depth=None, flow=None, cameras=None)
    decided = plan(bare, CONFIG)
    assert not any(decided.on(name) for name in ("depth_order", "flow", "camera_motion", "track_supervision"))
    with pytest.raises(GenmojoError, match="cannot be switched on: the clip has no depth"):
        plan(bare, CONFIG, {"depth_order": True})


def test_prior_decides_about_unseen_views() -> None:
    assert not plan(two_apart(), CONFIG).on("unseen_views")
    assert plan(two_apart(), replace(CONFIG, prior="embedded")).on("unseen_views")


# ---- the user's word ------------------------------------------------------------------------------------------------


def test_overrides_win_and_are_recorded() -> None:
    decided = plan(two_apart(), CONFIG, parse_overrides("+appearance_change,-instance_labels,+non_rigid_motion"))
    on, off = decided.get("appearance_change"), decided.get("instance_labels")
    assert on.on and on.overridden and on.reason.startswith("Switched on by the user.")
    assert not off.on and off.overridden
    assert decided.get("non_rigid_motion").settings["motion_bases"] >= 1
    assert not decided.get("flow").overridden


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("auto", {}),
        ("all", {"all": True}),
        ("all,-flow", {"all": True, "flow": False}),
        ("", {}),
        (" +flow , -background ", {"flow": True, "background": False}),
        ("+flow,+flow", {"flow": True}),
    ],
)
def test_overrides_are_read(text: str, expected: dict[str, bool]) -> None:
    assert parse_overrides(text) == expected


def test_all_switches_on_what_the_clip_allows_and_nothing_else() -> None:
    decided = plan(two_apart(), CONFIG, parse_overrides("all,-flow"))
    off = {effect.name for effect in decided.effects if not effect.on}
    assert off == {"flow", "unseen_views"}  # by the user; no prior is installed
    assert not decided.get("unseen_views").overridden and decided.get("camera_motion").overridden


def test_views_that_are_never_asked_for_need_no_prior() -> None:
    near, round_about = (replace(CONFIG, prior="embedded", view_range=degrees) for degrees in (5.0, 180.0))
    assert not plan(two_apart(), near).on("unseen_views")
    assert plan(two_apart(), round_about).get("unseen_views").evidence > 90


@pytest.mark.parametrize(("turn", "view_range", "expected"), [(0, 180, 1.0), (0, 0, 0.03), (320, 180, 0.0)])
def test_share_never_seen_of_a_ball(turn: float, view_range: float, expected: float) -> None:
    """The back of a still ball is all unseen; one that turned round has shown all but its poles."""
    sight = np.stack([axis_angle_matrix(np.array([0.0, 1.0, 0.0]), a) for a in np.linspace(0, turn, 9)])
    assert unseen_share(sight, view_range) == pytest.approx(expected, abs=0.08)


@pytest.mark.parametrize(
    ("text", "says"),
    [("+flux", "'flux'"), ("flow", "neither + nor -"), ("+flow,-flow", "both on and off"), ("+", "no effect")],
)
def test_wrong_overrides_are_told_in_one_sentence(text: str, says: str) -> None:
    with pytest.raises(GenmojoError, match=says.replace("+", r"\+")) as caught:
        parse_overrides(text)
    assert caught.value.code == "argument" and caught.value.sentence().endswith(".")


def test_unknown_override_given_as_a_mapping_is_refused() -> None:
    with pytest.raises(GenmojoError, match="'flux'"):
        plan(two_apart(), CONFIG, {"flux": True})


def test_prior_cannot_be_switched_on_when_none_is_installed() -> None:
    with pytest.raises(GenmojoError, match="no prior is installed"):
        plan(two_apart(), CONFIG, {"unseen_views": True})


# ---- objects --------------------------------------------------------------------------------------------------------


def test_object_facts_are_exact() -> None:
    facts = describe(make_clip(np.stack([line((30, 30), (52, 41))]), (21,)))[0]
    assert facts.area[0] == 21 * 21 and tuple(facts.boxes[0]) == (20, 20, 41, 41)
    assert facts.canonical == 0 and facts.visibility.max() == 1.0
    assert facts.depth == pytest.approx(5.0) and facts.depth_ratio == pytest.approx(1.0)
    assert not facts.cut.any() and not facts.touches.any()


@pytest.mark.parametrize(
    ("area", "touches", "cut", "best"),
    [
        ([90, 100, 100], [0, 0, 0], [0, 0, 0], 0),  # frame 0 is within 85 %
        ([80, 100, 100], [0, 0, 0], [0, 0, 0], 1),
        ([100, 60, 70], [1, 0, 0], [0, 0, 0], 2),  # contact in frame 0
        ([100, 95, 10], [1, 1, 0], [0, 0, 0], 0),  # the only free frame shows too little
        ([100, 70, 60], [0, 0, 0], [1, 0, 0], 1),  # the border cuts frame 0
        ([0, 0, 5], [0, 0, 0], [0, 0, 0], 2),
        ([0, 0, 0], [0, 0, 0], [0, 0, 0], 0),
    ],
)
def test_canonical_frame(area: list[int], touches: list[int], cut: list[int], best: int) -> None:
    assert canonical_frame(np.array(area), np.array(touches, bool), np.array(cut, bool)) == best


def test_depth_is_carried_over_where_an_object_is_not_seen() -> None:
    clip = two_apart()
    labels = clip.masks.value.copy()
    labels[:3][labels[:3] == 1] = 0
    facts = describe(replace(clip, masks=replace(clip.masks, value=labels)))[0]
    assert np.isfinite(facts.depth).all() and facts.visibility[:3].max() == 0 and facts.canonical >= 3


def test_sampling_keeps_flow_and_cameras_in_step() -> None:
    clip = two_apart()
    small = sample(clip, SIDE // 2)
    assert small.size == (SIDE // 2, SIDE // 2)
    assert np.allclose(small.flow.value, clip.flow.value[:, 1::2, 1::2] / 2)
    assert small.cameras.value.view(0).fx == pytest.approx(75.0)
    assert sample(clip) is clip


# ---- the shared clips -----------------------------------------------------------------------------------------------


@pytest.mark.clips
@pytest.mark.parametrize(
    ("name", "on", "off"),
    [
        (
            "blender-cross",
            {"joint_occlusion", "instance_labels"},
            {"camera_motion", "non_rigid_motion", "appearance_change"},
        ),
        (
            "blender-trio",
            {"joint_occlusion", "camera_motion", "non_rigid_motion", "appearance_change"},
            {"unseen_views"},
        ),
        ("crossing", {"joint_occlusion", "non_rigid_motion"}, {"camera_motion", "appearance_change"}),
    ],
)
def test_shared_clips_call_for_what_their_makers_say(name: str, on: set[str], off: set[str]) -> None:
    from genmojo_core.clip import folders
    from genmojo_core.estimate.complete import complete

    if not (DATA / name).exists():
        pytest.skip("the shared clips are not beside the checkout")
    decided = plan(complete(folders.read(DATA / name, frames=(0, 24), short_side=128)), CONFIG)
    simulated = {effect.name for effect in decided.effects if effect.on}
    assert on <= simulated and not off & simulated
    if name == "blender-trio":
        assert decided.get("non_rigid_motion").spared == (2, 3)  # the cylinder bends, the ball and the head do not
