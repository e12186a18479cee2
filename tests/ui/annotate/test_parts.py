"""Parts of the annotator by themselves: ring of frames, patches, figures, trackability, colours, merge."""

import cv2
import numpy as np
import pytest

from genmojo_core.clip import synthetic
from genmojo_core.clip.clip import Channel
from genmojo_studio.annotate.candidates import all_figures, camera_path, figures
from genmojo_studio.annotate.colours import object_colour, point_colour
from genmojo_studio.annotate.frame_buffers import FrameBuffers
from genmojo_studio.annotate.mapping import Mapping, fitted
from genmojo_studio.annotate.patches import difference, patch
from genmojo_studio.annotate.snap import snapped
from genmojo_studio.annotate.trackability import measure


def texture(height=80, width=120, seed=0):
    small = np.random.default_rng(seed).integers(0, 255, (height // 4, width // 4), np.uint8)
    grey = cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC)
    return np.dstack([grey, grey, grey, np.full_like(grey, 255)])


# ---- the ring of frames


@pytest.fixture
def cache(qapp, clip_folder):
    from genmojo_studio.annotate.frame_cache import FrameCache

    made = FrameCache(clip_folder, most_bytes=1)  # the smallest ring: eight frames
    yield made
    made.close()


def test_the_ring_holds_what_is_near_and_ahead_and_never_more(cache, qtbot):
    assert cache.capacity == 8
    cache.want(3)
    cache.want(10)
    qtbot.waitUntil(lambda: cache.get(10) is not None and len(cache.held()) == 8, timeout=60_000)
    qtbot.wait(200)
    held = cache.held()
    assert len(held) <= 8 and 10 in held and sum(f > 10 for f in held) > sum(f < 10 for f in held)
    cache.want(4)  # back: now what lies before is wanted
    qtbot.waitUntil(lambda: {2, 3, 4} <= set(cache.held()), timeout=60_000)


def test_only_the_wanted_frame_is_announced(cache, qtbot):
    said = []
    cache.arrived.connect(lambda frame, generation: said.append((frame, generation)))
    for frame in (5, 6, 7, 8):
        generation = cache.want(frame)
    qtbot.waitUntil(lambda: bool(said) and said[-1][0] == 8, timeout=60_000)
    assert said[-1] == (8, generation)


def test_frames_are_the_files_and_masks_carry_ids(cache, clip_folder):
    from genmojo_core.clip.frames import open_source

    expected = open_source(clip_folder).read(7)
    np.testing.assert_array_equal(cache.read(7), expected)
    ids = np.unique(cache.mask(7))
    assert ids[0] == 0 and len(ids) >= 2


def test_pinned_frames_stay(cache, qtbot):
    cache.pin([0])
    cache.want(15)
    qtbot.waitUntil(lambda: 0 in cache.held() and len(cache.held()) == 8, timeout=60_000)
    for frame in range(16, 22):
        cache.want(frame)
        qtbot.wait(30)
    assert 0 in cache.held()


def test_a_frame_that_cannot_be_read_is_told_and_the_others_come(qapp, qtbot, clip_folder, tmp_path):
    import shutil

    from genmojo_studio.annotate.frame_cache import FrameCache

    folder = tmp_path / "c"
    shutil.copytree(clip_folder / "JPEGImages", folder / "JPEGImages")
    sorted((folder / "JPEGImages").rglob("*.jpg"))[4].write_bytes(b"\xff\xd8\xff broken")
    made, told = FrameCache(folder), []
    made.failed.connect(lambda frame, sentence: told.append((frame, sentence)))
    made.want(4)
    qtbot.waitUntil(lambda: bool(told) and made.get(5) is not None, timeout=60_000)
    assert told[0][0] == 4 and "00004" in told[0][1]
    made.close()


def test_memory_of_a_frame_is_used_again_only_when_nobody_holds_a_part_of_it():
    buffers = FrameBuffers((8, 8, 4), most=2)
    first = buffers.take()
    corner = first[:2, :2]
    where = first.ctypes.data
    del first
    second = buffers.take()
    assert second.ctypes.data != where
    del corner
    assert buffers.take().ctypes.data == where
    third, fourth = buffers.take(), buffers.take()
    assert len({second.ctypes.data, third.ctypes.data, fourth.ctypes.data}) == 3, "beyond the most, memory is fresh"


# ---- pictures


@pytest.mark.parametrize(("x", "y"), [(20.5, 30.5), (20.0, 30.25), (1.5, 1.5), (119.5, 79.5)])
def test_a_patch_has_the_place_exactly_in_its_middle(x, y):
    frame = np.zeros((80, 120, 4), np.uint8)
    frame[int(y), int(x)] = 255
    shown = patch(frame, (x, y), (97, 97), 9.0)
    bright = np.argwhere(shown[..., 0] > 128)
    middle = (bright.min(axis=0) + bright.max(axis=0) + 1) / 2
    offset = (np.array([int(y) + 0.5 - y, int(x) + 0.5 - x])) * 9.0
    np.testing.assert_allclose(middle, 48.5 + offset, atol=1.0)


def test_equal_patches_have_no_difference_and_shifted_ones_do():
    one = patch(texture(), (60, 40), (64, 64), 4.0)
    assert difference(one, one)[..., :3].max() == 0
    assert difference(one, patch(texture(), (61, 40), (64, 64), 4.0))[..., :3].mean() > 2


@pytest.mark.parametrize("shift", [(0.0, 0.0), (3.0, -2.0), (5.5, 4.25)])
def test_snapping_finds_the_same_spot_to_a_fraction_of_a_pixel(shift):
    import cv2

    frame = texture()
    moved = cv2.warpAffine(frame, np.array([[1, 0, shift[0]], [0, 1, shift[1]]]), (120, 80), flags=cv2.INTER_CUBIC)
    found = snapped(frame, (60.0, 40.0), moved, (61.0, 41.0))
    np.testing.assert_allclose(found, (60 + shift[0], 40 + shift[1]), atol=0.35)


def test_nothing_is_proposed_where_nothing_is_alike():
    assert [s for s in range(1, 9) if snapped(texture(), (60, 40), texture(seed=s), (60, 40)) is not None] == []
    flat = np.full((80, 120, 4), 90, np.uint8)
    assert snapped(flat, (60, 40), flat, (60, 40)) is None


def test_the_mapping_goes_back_and_keeps_the_place_under_the_mouse():
    mapping = fitted((1920, 1080), (900, 600))
    assert mapping.to_widget(960, 540) == (450, 300)
    zoomed = mapping.zoomed(5.0, 200, 100)
    np.testing.assert_allclose(zoomed.to_image(200, 100), mapping.to_image(200, 100))
    np.testing.assert_allclose(Mapping(2.5, 7, 9).to_image(*Mapping(2.5, 7, 9).to_widget(3.25, 4.5)), (3.25, 4.5))


# ---- figures


def test_candidates_tell_size_motion_and_hiding():
    labels = np.zeros((10, 100, 200), np.uint8)
    for t in range(10):
        labels[t, 40:60, 10 + 4 * t : 30 + 4 * t] = 1
    labels[4:6, 40:60, :] = 0
    labels[6:8, 44:60] = 0
    found = figures(labels, 1)
    assert found.first == 0 and found.advice == ""
    assert found.size == pytest.approx(400 / 20000) and found.seen == pytest.approx(0.8)
    assert found.motion == pytest.approx(4 * 1080 / 100, rel=0.05)
    assert found.covered == pytest.approx(2 / 8)
    still = np.zeros_like(labels)
    still[:, 40:60, 10:30] = 1
    assert figures(still, 1).advice == "static" and figures(still, 2).advice == "hidden"
    assert figures(still[:1], 1).advice == "", "one frame tells nothing of motion"


def test_candidates_that_are_mostly_covered_are_told_from_those_that_come_nearer():
    labels = np.zeros((20, 100, 200), np.uint8)
    for t in range(20):
        labels[t, 40 : 60 if t < 4 else 46, 10 + 2 * t : 30 + 2 * t] = 1
    assert figures(labels, 1).covered == pytest.approx(16 / 20) and figures(labels, 1).advice == "covered"
    nearer = np.zeros_like(labels)
    for t in range(20):
        half = 5 * 1.08**t  # the area grows to eighteen times
        nearer[t, round(50 - half) : round(50 + half), round(50 + 2 * t - half) : round(50 + 2 * t + half)] = 1
    assert figures(nearer, 1).covered < 0.2 and figures(nearer, 1).advice == ""


def test_frames_without_a_mask_do_not_count_as_hidden():
    labels = np.zeros((10, 100, 200), np.uint8)
    labels[3, 40:60, 10:30] = 1
    assert figures(labels, 1).advice == "hidden"
    assert figures(labels, 1, np.arange(10) == 3).seen == 1.0 and figures(labels, 1, np.arange(10) == 3).advice == ""


def test_motion_is_told_against_the_background_of_a_camera_that_pans():
    rng = np.random.default_rng(0)
    wide = cv2.GaussianBlur(rng.integers(0, 256, (120, 400), np.uint8), (0, 0), 1.5)
    clip, _ = synthetic.generate("crossing-shapes")
    frames = np.stack([np.repeat(wide[:, 5 * t : 5 * t + 200, None], 3, axis=2) for t in range(12)])
    labels = np.zeros((2, 12, 120, 200), np.uint8)
    for t in range(12):
        labels[0, t, 40:60, 100 - 5 * t : 120 - 5 * t] = 1  # stands in the world
        labels[1, t, 40:60, 100:120] = 1  # stays in the middle of the picture
    for k, (motion, advice) in enumerate(((0.0, "static"), (5 * 1080 / 120, ""))):
        channel = Channel(labels[k], np.ones(labels[k].shape, bool), "given: test")
        panned = clip.with_channels(frames=frames, masks=channel, object_ids=np.array([1]), object_names=("it",))
        found = all_figures(panned, np.ones(12, bool), camera_path(panned))[1]
        assert found.motion == pytest.approx(motion, abs=1.5) and found.advice == advice


def test_corners_are_trackable_edges_slide_and_flat_places_are_lost():
    frame = np.zeros((120, 160, 4), np.uint8)
    frame[60:, 80:, :3] = 200
    labels = np.ones((120, 160), np.uint8)
    none = np.zeros((0, 2))
    corner = measure(frame, (80.0, 60.0), labels, 1, none)
    edge = measure(frame, (120.0, 60.0), labels, 1, none)
    flat = measure(frame, (30.0, 30.0), labels, 1, none)
    assert corner.score > 0.5 and corner.warnings == ()
    assert edge.warnings == ("edge",) and flat.warnings == ("flat",) and flat.score == 0
    assert "off mask" in measure(frame, (80.0, 60.0), labels, 2, none).warnings
    assert "near" in measure(frame, (80.0, 60.0), labels, 1, np.array([[84.0, 60.0]])).warnings


def test_objects_and_points_have_colours_of_their_own():
    objects = {object_colour(k) for k in range(8)}
    points = {point_colour(0, k) for k in range(5)}
    assert len(objects) == 8 and len(points) == 5


# ---- merge


def test_the_merge_dialog_takes_theirs_where_only_they_changed(workspace, tmp_path):
    from genmojo_core.tracks import edit_tracks, keys
    from genmojo_core.tracks.annotation import Annotation
    from genmojo_studio.annotate.merge_dialog import MergeDialog

    session = workspace.session
    sides = []
    for _ in range(2):
        side = Annotation(session.annotation.frames, session.annotation.size)
        edit_tracks.put_objects(side, list(session.annotation.objects.values())).do(side)
        edit_tracks.add_track(side, next(iter(side.objects)), 1).do(side)
        keys.set_key(side, 1, 0, (10.0, 10.0)).do(side)
        keys.set_state(side, 1, 0, side.frames - 1, 1).do(side)
        sides.append(side)
    base, theirs = sides
    session.do(edit_tracks.add_track(session.annotation, next(iter(session.annotation.objects)), 1))
    session.do(keys.set_key(session.annotation, 1, 0, (10.0, 10.0)))
    session.do(keys.set_state(session.annotation, 1, 0, base.frames - 1, 1))
    keys.set_key(theirs, 1, 5, (40.0, 30.0)).do(theirs)
    dialog = MergeDialog(session, theirs, base, workspace)
    assert dialog.runs and all(run.kind == "theirs" for run in dialog.runs)
    dialog.take.click()
    np.testing.assert_allclose(session.annotation.track(1).xy[5], (40.0, 30.0), atol=1e-4)
    session.undo()
    np.testing.assert_allclose(session.annotation.track(1).xy[5], (10.0, 10.0), atol=1e-4)
