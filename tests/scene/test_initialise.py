"""From pixels to points: cells tile the mask, unprojection inverts projection, holes are found."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.clip.cameras import View
from genmojo_core.scene.initialise import (
    Points,
    points_of_image,
    project,
    quadtree,
    surface_axes,
    uncovered,
    unproject,
)

VIEW = View(np.eye(4), 90.0, 70.0, 30.0, 22.0, 64, 48)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 300))
def test_cells_cover_every_masked_pixel_once(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    mask = rng.random((24, 31)) < 0.4
    image = rng.integers(0, 256, (24, 31, 3), dtype=np.uint8)
    cells = quadtree(image, mask, count)
    assert len(cells) <= count
    if count >= mask.sum():
        covered = (cells[:, 2] * cells[:, 3] * cells[:, 4]).sum()
        assert abs(covered - mask.sum()) < 1e-6


def test_detail_gets_smaller_cells() -> None:
    image = np.full((64, 64, 3), 128, np.uint8)
    image[:, 32:] = np.random.default_rng(0).integers(0, 256, (64, 32, 3))
    cells = quadtree(image, np.ones((64, 64), bool), 200)
    assert (cells[:, 0] > 32).sum() > 3 * (cells[:, 0] < 32).sum()


def test_unproject_inverts_project() -> None:
    rng = np.random.default_rng(1)
    xy = rng.uniform(0, 48, (100, 2))
    depth = rng.uniform(0.5, 9.0, 100)
    back, z = project(unproject(xy, depth, VIEW), VIEW)
    assert np.allclose(back, xy, atol=1e-9)
    assert np.allclose(z, depth)


def test_points_have_the_colours_and_sizes_of_their_cells() -> None:
    image = np.zeros((48, 64, 3), np.uint8)
    image[:, :, 0] = 200
    mask = np.zeros((48, 64), bool)
    mask[10:30, 12:44] = True
    points = points_of_image(image, np.full((48, 64), 3.0), mask, VIEW, 50)
    assert np.allclose(points.rgb, [200 / 255, 0, 0])
    assert np.allclose(project(points.xyz, VIEW)[1], 3.0)
    assert not uncovered(points, VIEW, mask).any()


def test_what_no_point_covers_is_a_hole() -> None:
    image = np.full((48, 64, 3), 90, np.uint8)
    left = np.zeros((48, 64), bool)
    left[10:40, 5:25] = True
    whole = left.copy()
    whole[10:40, 25:60] = True
    points = points_of_image(image, np.full((48, 64), 2.0), left, VIEW, 200)
    holes = uncovered(points, VIEW, whole)
    assert not holes[:, :24].any()
    assert holes[10:40, 32:60].all()


def test_an_empty_mask_gives_no_points() -> None:
    nothing = np.zeros((48, 64), bool)
    assert len(points_of_image(np.zeros((48, 64, 3), np.uint8), np.ones((48, 64)), nothing, VIEW, 10)) == 0


def test_pieces_of_a_slanted_surface_lie_in_it() -> None:
    ys, xs = np.mgrid[0:48, 0:64] + 0.5
    rays = np.stack([(xs - VIEW.cx) / VIEW.fx, (ys - VIEW.cy) / VIEW.fy, np.ones_like(xs)], axis=-1)
    normal = np.array([0.0, -0.9, -0.43589])  # a ground that rises away from the camera
    depth = -2.0 / (rays @ normal)
    seen = (depth > 0) & (depth < 8)
    points = points_of_image(np.full((48, 64, 3), 90, np.uint8), depth, seen, VIEW, 200)
    rotations, sigmas = surface_axes(points.tangents)
    assert np.abs(rotations[:, :, 2] @ normal).min() > 0.98
    assert np.allclose(np.linalg.det(rotations), 1.0)
    assert (sigmas[:, 0] >= sigmas[:, 1]).all()
    assert (sigmas[:, 0] > 1.5 * points.sigma).mean() > 0.5  # longer along the ground than across the view


def test_a_surface_is_not_followed_over_an_edge() -> None:
    depth = np.full((48, 64), 2.0)
    depth[:, 32:] = 9.0
    points = points_of_image(np.full((48, 64, 3), 90, np.uint8), depth, np.ones((48, 64), bool), VIEW, 3000)
    assert np.abs(points.tangents[:, :, 2]).max() < 1e-9


def test_a_moved_cloud_keeps_its_shape() -> None:
    rng = np.random.default_rng(2)
    cloud = Points(rng.normal(size=(5, 3)), rng.random((5, 3)), np.full(5, 0.1), rng.normal(size=(5, 2, 3)))
    pose = np.eye(4)
    pose[:3, :3] = 2.0 * np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    pose[:3, 3] = [1, 2, 3]
    back = cloud.moved(pose).moved(np.linalg.inv(pose))
    assert np.allclose(back.xyz, cloud.xyz)
    assert np.allclose(back.tangents, cloud.tangents)
    assert np.allclose(cloud.moved(pose).sigma, 0.2)
