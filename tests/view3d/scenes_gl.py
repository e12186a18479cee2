"""OpenGL contexts without a window, random snapshots and the float64 picture of them."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.render import reference
from genmojo_core.render.rasterizer import Rendering, Splats
from genmojo_studio.view3d.look import object_table
from genmojo_studio.view3d.snapshot import SceneSnapshot, SnapshotObject


def egl_context() -> moderngl.Context:
    """A context of its own through EGL; skips the test where the machine has no driver."""
    try:
        return moderngl.create_context(standalone=True, backend="egl", require=330)
    except Exception as error:  # noqa: BLE001 - what moderngl raises
        pytest.skip(f"no OpenGL 3.3 through EGL here: {error}")


def random_snapshot(count: int, seed: int = 0, objects: int = 3, size: float = 0.06) -> SceneSnapshot:
    """Splats around (0, 0, 3), long and thin ones too, in `objects` objects of which 0 is the background."""
    rng = np.random.default_rng(seed)
    means = rng.normal(size=(count, 3)) * 0.6
    means[:, 2] += 3.0
    names = tuple(SnapshotObject(k, f"object {k}", tuple(rng.uniform(size=3)), k == 0) for k in range(objects))
    return SceneSnapshot(
        1, 0, "lift", 7, 1, means, rng.normal(size=(count, 4)), size * np.exp(0.6 * rng.normal(size=(count, 3))),
        1 / (1 + np.exp(-(1 + 1.5 * rng.normal(size=count)))), rng.uniform(size=(count, 3)),
        np.arange(count) * objects // max(count, 1), np.arange(count), objects=names,
    )  # fmt: skip


def a_view(width: int = 96, height: int = 72, shift: tuple[float, float] = (0.0, 0.0)) -> View:
    """A camera at the origin looking along z, pixels slightly not square."""
    return View(np.eye(4), 1.0 * width, 1.06 * width, width / 2 + shift[0], height / 2 + shift[1], width, height)


def truth(snapshot: SceneSnapshot, view: View, features: np.ndarray | None = None) -> Rendering[np.ndarray]:
    """The float64 picture of any features (N, C); by default the colours."""
    features = snapshot.colours if features is None else features
    parts = (snapshot.positions, snapshot.rotations, snapshot.scales, snapshot.opacities, features)
    drawn = reference.splat(Splats(*(torch.as_tensor(np.asarray(p)) for p in parts)), view)
    return Rendering(*(part.numpy() for part in (drawn.features, drawn.depth, drawn.alpha)))


def decibels(a: np.ndarray, b: np.ndarray) -> float:
    """Peak signal to noise ratio of pictures in 0..1."""
    return float(-10 * np.log10(max(float(np.mean((np.asarray(a, float) - b) ** 2)), 1e-20)))


__all__ = ["a_view", "decibels", "egl_context", "object_table", "random_snapshot", "truth"]
