"""The joint solve of an object's poses: its equations are those of finite differences, and exact matches are met."""

from __future__ import annotations

import numpy as np
import pytest

from genmojo_core.clip.cameras import Cameras
from genmojo_core.optimise.pose_solver import Joined, _add_matches, _ShapeTerms, residual_rows, robust_weights, solve
from genmojo_core.optimise.poses import Path, Problem, Sight, exp_rotation, project, rays, still_path

FRAMES, POINTS = 4, 30
STEP = 1e-6


def cameras(rng: np.random.Generator) -> Cameras:
    """A camera that moves a little and looks along z."""
    k = np.tile(np.array([[120.0, 0, 64], [0, 118.0, 48], [0, 0, 1]]), (FRAMES, 1, 1))
    pose = np.tile(np.eye(4), (FRAMES, 1, 1))
    for t in range(FRAMES):
        pose[t, :3, :3] = exp_rotation(rng.normal(0, 0.02, 3))
        pose[t, :3, 3] = rng.normal(0, 0.05, 3)
    return Cameras(k, pose, (128, 96))


def turned(path: Path, rng: np.random.Generator, amount: float) -> Path:
    """The path with every pose but the reference's changed."""
    for t in range(FRAMES):
        if t != path.ref:
            path = path.moved(t, exp_rotation(rng.normal(0, amount, 3)) @ path.rotation[t],
                              path.position[t] + rng.normal(0, amount, 3))  # fmt: skip
    return path


def matched(measured: bool, seed: int = 0, outlines: bool = True) -> tuple[Path, Problem]:
    """A true path and the exact matches of all pairs of frames."""
    rng = np.random.default_rng(seed)
    cams, centre = cameras(rng), np.array([0.0, 0.0, 4.0])
    path = turned(still_path(FRAMES, centre, 1), rng, 0.15)
    xyz = centre + rng.normal(0, 0.3, (POINTS, 3))
    origin, ray, depth, sights = [], [], [], []
    for s in range(FRAMES):
        here = path.between(1, s, xyz)
        pose = cams.world_to_camera[s]
        ray.append(rays(cams, s, project(cams, s, here)))
        origin.append(np.tile(-pose[:3, :3].T @ pose[:3, 3], (POINTS, 1)))
        depth.append((here @ pose[:3, :3].T + pose[:3, 3])[:, 2])
        for t in set(range(FRAMES)) - {s}:
            there = path.between(1, t, xyz)
            xy, index, weight = project(cams, t, there), s * POINTS + np.arange(POINTS), rng.uniform(0.3, 1, POINTS)
            normal, facing = rng.normal(size=(POINTS, 3)), rng.normal(size=(POINTS, 2))
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            facing /= np.linalg.norm(facing, axis=1, keepdims=True)
            sights.append(Sight(s, t, index, xy, weight, there, normal))
            if outlines:
                few = slice(0, 8 + t)
                sights.append(Sight(s, t, index[few], xy[few], weight[few], there[few], normal[few], facing[few]))
    problem = Problem(cams, np.concatenate(origin), np.concatenate(ray), np.concatenate(depth), 1.0, tuple(sights),
                      surface_sigma=0.02 if measured else 0.05, depth_sigma=0.0 if measured else 0.2)  # fmt: skip
    return path, problem


def stepped(path: Path, frame: int, unknown: int, by: float) -> Path:
    """One of the six numbers of a pose changed: a turn in world axes about the centre, or a move."""
    step = np.zeros(6)
    step[unknown] = by
    return path.moved(frame, exp_rotation(step[:3]) @ path.rotation[frame], path.position[frame] + step[3:])


def errors_of(problem: Problem, sight: Sight, path: Path, depth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Residuals (N, R) of a sight and their noise."""
    points = problem.origin[sight.index] + depth[sight.index, None] * problem.ray[sight.index]
    _, errors, noise = residual_rows(problem, sight, sight.target, path.between(sight.source, sight.target, points))
    return errors, noise


@pytest.mark.parametrize("measured", [True, False])
def test_the_equations_are_those_of_finite_differences(measured: bool) -> None:
    true, problem = matched(measured)
    path = turned(true, np.random.default_rng(5), 0.03)
    depth = problem.depth
    free = np.ones(FRAMES, bool)
    free[path.ref] = False
    slot = np.cumsum(free) - 1
    normal, right = np.zeros((18, 18)), np.zeros(18)
    shape = _ShapeTerms(problem, list(problem.sights), free, slot)
    for kind in (True, False):
        sights = [s for s in problem.sights if (s.facing is None) == kind]
        _add_matches(normal, right, shape, Joined(sights, free, slot), problem, path, depth)
    wanted, pull, along = np.zeros((18, 18)), np.zeros(18), np.zeros(len(depth))
    for sight in problem.sights:
        errors, noise = errors_of(problem, sight, path, depth)
        weights = (robust_weights(errors / noise, sight.shares) / noise**2).ravel()
        slopes = np.zeros((errors.size, 18))
        for frame in {sight.source, sight.target} - {path.ref}:
            for unknown in range(6):
                pair = [errors_of(problem, sight, stepped(path, frame, unknown, by), depth)[0] for by in (STEP, -STEP)]
                slopes[:, 6 * slot[frame] + unknown] = -((pair[0] - pair[1]) / (2 * STEP)).ravel()
        wanted += slopes.T @ (weights[:, None] * slopes)
        pull += slopes.T @ (weights * errors.ravel())
        pair = [errors_of(problem, sight, path, depth + by)[0] for by in (STEP, -STEP)]
        slope = (pair[0] - pair[1]) / (2 * STEP)
        np.add.at(along, sight.index, (weights.reshape(errors.shape) * slope**2).sum(axis=1))
    assert np.abs(normal - wanted).max() < 1e-6 * np.abs(wanted).max()
    assert np.abs(right - pull).max() < 1e-6 * np.abs(pull).max()
    assert shape.on != measured
    if shape.on:
        assert np.abs(shape.diagonal - along).max() < 1e-6 * along.max()


@pytest.mark.parametrize("measured", [True, False])
def test_exact_matches_are_met(measured: bool) -> None:
    true, problem = matched(measured, outlines=measured)
    every = np.ones(FRAMES, bool)
    path, depth = solve(turned(true, np.random.default_rng(5), 0.02), problem, every, np.zeros(FRAMES, bool), rounds=30)
    assert np.abs(path.rotation - true.rotation).max() < 1e-3
    assert np.abs(path.position - true.position).max() < 1e-3
    assert np.abs(depth - problem.depth).max() < 1e-3


def test_frames_that_are_not_free_stay_and_sights_without_points_do_no_harm() -> None:
    true, problem = matched(True)
    start = turned(true, np.random.default_rng(5), 0.03)
    empty = Sight(0, 2, *(np.zeros((0, *shape)) for shape in ((), (2,), (), (3,), (3,))))
    empty = Sight(0, 2, empty.index.astype(np.int64), empty.xy, empty.weight, empty.surface, empty.normal)
    free = np.array([True, True, False, False])
    for sights in (problem.sights, (*problem.sights, empty)):
        problem = Problem(problem.cameras, problem.origin, problem.ray, problem.depth, 1.0, sights, surface_sigma=0.02)
        path, _ = solve(start, problem, free, np.zeros(FRAMES, bool))
        assert np.array_equal(path.position[1:], start.position[1:])
        assert not np.array_equal(path.position[0], start.position[0])
    nothing, depth = solve(start, problem, np.zeros(FRAMES, bool), free)
    assert nothing is start and np.array_equal(depth, problem.depth)
