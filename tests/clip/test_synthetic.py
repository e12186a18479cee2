"""The procedural clips' truth is exact: flow, depth, cameras, tracks, masks and novel views agree with one another.

The oracles here use the clip's own channels against each other, not the generator's matrices.
"""

from __future__ import annotations

import hashlib

import numpy as np
import pytest

from genmojo_core.clip import folders, synthetic, synthetic_files
from genmojo_core.clip.points import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.clip.shapes import Shape
from genmojo_core.clip.synthetic_specs import SPECS, SyntheticSpec, spec
from genmojo_core.conventions import orbit_camera
from genmojo_core.errors import GenmojoError

MADE: dict[str, tuple] = {}


def made(name: str) -> tuple:
    """Clip and truth of a named spec, made once."""
    if name not in MADE:
        MADE[name] = synthetic.generate(name)
    return MADE[name]


def unprojected(truth: synthetic.Truth, t: int) -> np.ndarray:
    """(H, W, 3) world points of a frame from depth, K and pose alone."""
    height, width = truth.depth.shape[1:]
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    z = truth.depth[t].astype(np.float64)
    k = truth.K
    local = np.stack([(x - k[0, 2]) / k[0, 0] * z, (y - k[1, 2]) / k[1, 1] * z, z, np.ones_like(z)], axis=-1)
    return (local @ np.linalg.inv(truth.world_to_camera[t]).T)[..., :3]


def projected(truth: synthetic.Truth, pose: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(..., 2) pixels of world points."""
    local = points @ pose[:3, :3].T + pose[:3, 3]
    return local[..., :2] / local[..., 2:] * [truth.K[0, 0], truth.K[1, 1]] + truth.K[:2, 2]


@pytest.mark.parametrize("name", sorted(SPECS))
def test_named_clips_are_whole(name):
    clip, truth = made(name)
    what = spec(name)
    assert (len(clip), clip.size, clip.objects) == (what.frames, what.size, len(what.shapes))
    assert clip.depth.valid.all() and clip.masks.valid.all() and clip.cameras.valid.all() and clip.flow is None
    assert np.array_equal(clip.masks.value, truth.labels) and clip.world_up.tolist() == [0, 0, 1]
    assert 20 < clip.frames.mean() < 200 and clip.frames.std() > 20


def test_the_demo_shows_what_it_should():
    """Three objects that pass and hide one another, each always in sight, motion of several pixels a frame."""
    clip, truth = made("crossing-shapes")
    sizes = np.array([[(clip.masks.value[t] == k).sum() for k in (1, 2, 3)] for t in range(len(clip))])
    assert sizes.min() > 150 and (sizes.min(0) / sizes.max(0))[1:].max() < 0.6
    states = [(truth.state == s).mean() for s in (VISIBLE, OCCLUDED)]
    assert states[0] > 0.5 and states[1] > 0.1
    assert 4 < np.abs(truth.flow).max() < 12


def test_the_same_spec_gives_the_same_bytes():
    one, two = synthetic.generate("pixel"), synthetic.generate("pixel")
    assert one[0].frames.tobytes() == two[0].frames.tobytes() and one[1].tracks.tobytes() == two[1].tracks.tobytes()


def test_flow_of_the_background_is_reprojection_of_its_depth():
    """Ground and wall stand still, so depth and cameras alone must give their flow."""
    clip, truth = made("moving-camera")
    for t in (0, 11, 22):
        points = unprojected(truth, t)
        still = truth.labels[t] == 0
        height, width = still.shape
        grid = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1)
        expected = projected(truth, truth.world_to_camera[t + 1], points) - grid
        np.testing.assert_allclose(truth.flow[t][still], expected[still], atol=2e-4)
    assert np.abs(truth.flow[0][truth.labels[0] == 0]).max() > 0.5


def patch(plane: np.ndarray, x: float, y: float) -> np.ndarray:
    """The 3 x 3 pixels around a point, cut at the border: a point is never exactly at a pixel's centre."""
    i, j = int(y), int(x)
    return plane[max(0, i - 1) : i + 2, max(0, j - 1) : j + 2]


@pytest.mark.parametrize("name", ["crossing-shapes", "moving-camera"])
def test_flow_leads_to_the_same_object_or_behind_a_nearer_one(name):
    """A solid's points project into its silhouette in every frame; only a nearer object can be in front of it."""
    _, truth = made(name)
    height, width = truth.labels.shape[1:]
    met = 0
    for t in range(0, 22, 7):
        for i, j in np.argwhere(truth.labels[t]):
            x, y = truth.flow[t, i, j] + [j + 0.5, i + 0.5]
            if 0 <= x < width and 0 <= y < height:
                same = (patch(truth.labels[t + 1], x, y) == truth.labels[t, i, j]).any()
                assert same or patch(truth.depth[t + 1], x, y).min() < truth.depth[t, i, j]
                met += same
    assert met > 5000 and not truth.flow_valid[-1].any() and truth.flow_valid[:-1].all()


@pytest.mark.parametrize("name", ["crossing-shapes", "moving-camera", "leaves-and-returns"])
def test_tracks_lie_on_their_objects(name):
    """Visible points: on their label, at the depth there; hidden ones: behind it; the others outside the picture."""
    _, truth = made(name)
    height, width = truth.labels.shape[1:]
    seen = hidden = 0
    for p, t in np.ndindex(truth.state.shape):
        x, y = truth.tracks[p, t]
        place = truth.track_xyz[p, t].astype(float)
        np.testing.assert_allclose(projected(truth, truth.world_to_camera[t], place), (x, y), atol=1e-3)
        inside = 0 <= x < width and 0 <= y < height
        assert (truth.state[p, t] == OUT_OF_VIEW) == (not inside)
        if not inside:
            continue
        z = truth.world_to_camera[t][2] @ np.append(place, 1)
        labels, depths = patch(truth.labels[t], x, y), patch(truth.depth[t], x, y)
        if truth.state[p, t] == VISIBLE:
            assert (labels == truth.track_object[p]).any()
            if (labels == truth.track_object[p]).all():
                assert depths.min() - 0.03 < z < depths.max() + 0.03
                seen += 1
        else:
            assert z > depths.min()
            hidden += 1
    assert seen > 100 and hidden > 20
    assert np.array_equal(truth.visible, truth.state == VISIBLE) and truth.visible.any(axis=1).all()


def test_track_steps_are_the_flow():
    """Between neighbouring frames a visible point moves as the flow under it says (bilinear, away from edges)."""
    _, truth = made("crossing-shapes")
    errors = []
    for p, t in np.ndindex(truth.state.shape[0], truth.state.shape[1] - 1):
        x, y = truth.tracks[p, t] - 0.5
        i, j = int(np.floor(y)), int(np.floor(x))
        if truth.state[p, t] != VISIBLE or not (patch(truth.labels[t], x, y) == truth.track_object[p]).all():
            continue
        f = truth.flow[t, i : i + 2, j : j + 2].astype(float)
        if np.abs(f[0, 0] + f[1, 1] - f[0, 1] - f[1, 0]).max() > 0.05:
            continue  # an edge of the cube or a silhouette is between the four pixels
        across = f[:, 0] * (1 - x + j) + f[:, 1] * (x - j)
        under = across[0] * (1 - y + i) + across[1] * (y - i)
        errors.append(np.linalg.norm(truth.tracks[p, t + 1] - truth.tracks[p, t] - under))
    assert len(errors) > 300 and np.median(errors) < 0.01 and np.percentile(errors, 95) < 0.1


def test_colours_stick_to_material_points():
    """A visible point keeps its colour but for the light that changes as it turns."""
    clip, truth = made("crossing-shapes")
    spread = []
    for p in range(len(truth.tracks)):
        seen = [t for t in range(len(clip)) if truth.visible[p, t]]
        at = [tuple(truth.tracks[p, t].astype(int)) for t in seen]
        inner = [
            clip.frames[t, y, x].astype(float)
            for t, (x, y) in zip(seen, at, strict=True)
            if (truth.labels[t, max(0, y - 1) : y + 2, max(0, x - 1) : x + 2] == truth.track_object[p]).all()
        ]
        if len(inner) > 5:
            hues = np.array([c / c.sum() for c in inner])
            spread.append(np.median(np.abs(hues - np.median(hues, axis=0)).max(1)))
    assert len(spread) > 15 and np.median(spread) < 0.04


def test_novel_views_are_the_same_world():
    """Visible points, projected into a novel camera, fall on its silhouette; cameras follow the conventions."""
    clip, truth = made("moving-camera")
    height, width = clip.frames.shape[1:3]
    for a, (elevation, azimuth) in enumerate(truth.novel_angles):
        for f, t in enumerate(truth.novel_frames):
            pose = truth.novel_world_to_camera[a, t]
            expected = orbit_camera(truth.world_to_camera[t], truth.orbit_centre, clip.world_up, elevation, azimuth)
            np.testing.assert_allclose(pose, expected, atol=1e-12)
            xy = projected(truth, pose, truth.track_xyz[:, t].astype(float))
            inside = ((xy > 1) & (xy < [width - 1, height - 1])).all(axis=1)
            alpha = truth.novel[a, f, ..., 3]
            columns, rows = xy[inside].astype(int).T
            near = np.max([alpha[rows + i, columns + j] for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)
            assert (near > 0).all()
            assert 0.01 < (alpha > 0).mean() < 0.5


def test_novel_view_from_the_input_camera_is_the_input():
    """(0, 0) shows the objects where the masks are, in the frame's colours."""
    clip, truth = made("crossing-shapes")
    view = synthetic.novel_view(spec("crossing-shapes"), 5, 0, 0)
    inside = (view[..., 3] == 255) & (truth.labels[5] > 0)
    assert np.abs(view[..., :3].astype(int) - clip.frames[5])[inside].max() <= 1
    assert ((view[..., 3] > 0) != (truth.labels[5] > 0)).mean() < 0.02
    above, right = synthetic.novel_view(spec("still"), 0, 80, 0), synthetic.novel_view(spec("still"), 0, 0, 90)
    assert (above[..., 3] > 0).sum() > 500 and not np.array_equal(above, right)


def test_one_pixel_object():
    _, truth = made("pixel")
    places = [np.argwhere(truth.labels[t] == 1).tolist() for t in range(8)]
    assert places == [[[30, 40 + t]] for t in range(8)]


def test_object_that_leaves_and_returns():
    _, truth = made("leaves-and-returns")
    seen = (truth.labels == 1).any(axis=(1, 2))
    gone = np.flatnonzero(~seen)
    assert seen[0] and seen[-1] and len(gone) >= 6 and np.all(np.diff(gone) == 1)
    mine = truth.track_object == 1
    assert (truth.state[mine][:, gone] == OUT_OF_VIEW).all()


def test_pulsating_and_bare_specs():
    """Shapes that pulsate are exact too; a spec may leave out novel views and carry flow."""
    ball = Shape("ball", (0.5, 0.5, 0.5), ((0.0, 0.0, 0.8),), ((1.0, 0, 0), (0, 0, 1.0)), pulse=0.4)
    what = SyntheticSpec("pulse", (ball,), frames=9, size=(64, 48), given=("flow",), novel_every=0)
    clip, truth = synthetic.generate(what)
    heights = [np.ptp(np.nonzero(m)[0]) for m in truth.labels]
    assert heights[2] > heights[0] > heights[6]
    assert clip.flow.valid[:-1].all() and clip.depth is None and clip.cameras is None
    assert truth.novel.shape[1] == 0 and clip.world_up.tolist() == [0, -1, 0]
    for fault in ({"frames": 0}, {"shapes": ()}):
        with pytest.raises(GenmojoError):
            synthetic.generate(SyntheticSpec(**{"name": "x", "shapes": (ball,), **fault}))
    with pytest.raises(GenmojoError, match="no procedural clip 'nothing'"):
        synthetic.generate("nothing")


@pytest.mark.parametrize("name", ["still", "pixel"])
def test_written_clips_are_read_back(tmp_path, name):
    clip, truth = made(name)
    synthetic_files.write(clip, truth, tmp_path / "out")
    back = folders.read(tmp_path / "out")
    assert back.name == name and np.abs(back.frames.astype(int) - clip.frames).mean() < 1.5
    np.testing.assert_array_equal(back.masks.value, clip.masks.value)
    np.testing.assert_array_equal(back.depth.value, clip.depth.value)
    np.testing.assert_allclose(back.cameras.value.K, clip.cameras.value.K)
    np.testing.assert_array_equal(back.cameras.value.world_to_camera, clip.cameras.value.world_to_camera)
    assert back.world_up.tolist() == [0, 0, 1]
    stored = np.load(tmp_path / "out" / "truth.npz")
    for key in ("tracks", "visible", "track_object", "track_xyz", "novel_angles", "novel_world_to_camera",
                "novel_frames", "orbit_centre"):  # fmt: skip
        np.testing.assert_array_equal(stored[key], getattr(truth, key))
    import cv2

    picture = cv2.imread(str(tmp_path / "out" / "novel" / "0_-30" / "00000.png"), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(picture[..., [2, 1, 0, 3]], truth.novel[0, 0])


def test_writing_again_is_safe_and_mixing_is_refused(tmp_path):
    clip, truth = made("still")
    digests = []
    for _ in range(2):
        synthetic_files.write(clip, truth, tmp_path)
        files = sorted(p for p in tmp_path.rglob("*") if p.is_file())
        digests.append(hashlib.sha256(b"".join(p.read_bytes() for p in files)).hexdigest())
    assert digests[0] == digests[1]
    with pytest.raises(GenmojoError, match="holds another clip"):
        synthetic_files.write(*made("pixel"), tmp_path)
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(GenmojoError, match="cannot be written"):
        synthetic_files.write(clip, truth, tmp_path / "file")
