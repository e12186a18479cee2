"""Random scenes and comparisons shared by the rasteriser's tests."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.render import reference
from genmojo_core.render.rasterizer import ALPHA_MIN, Rendering, Splats

NAMES = ("means", "quats", "scales", "opacities", "features")


def camera(width: int, height: int, focal: float | None = None, shift: tuple[float, float] = (0.0, 0.0)) -> View:
    """A camera at the origin looking along z."""
    focal = focal or float(max(width, height))
    return View(np.eye(4), focal, focal, width / 2 + shift[0], height / 2 + shift[1], width, height)


def turned_pose(degrees: float = 10.0) -> np.ndarray:
    """A small rigid motion (4, 4)."""
    pose = np.eye(4)
    pose[:3, :3] = axis_angle_matrix(np.array([0.0, 0.6, 0.8]), degrees)
    pose[:3, 3] = (0.1, 0.2, 0.3)
    return pose


def random_splats(count: int, channels: int, seed: int, size: float = 0.06) -> Splats[torch.Tensor]:
    """`count` float32 splats around (0, 0, 3) with requires_grad off."""
    rng = np.random.default_rng(seed)
    means = rng.normal(size=(count, 3)) * 0.6
    means[:, 2] += 3.0
    arrays = (
        means,
        rng.normal(size=(count, 4)),
        size * np.exp(0.45 * rng.normal(size=(count, 3))),
        1 / (1 + np.exp(-(1 + 1.5 * rng.normal(size=count)))),
        rng.uniform(size=(count, channels)),
    )
    return Splats(*(torch.tensor(a, dtype=torch.float32) for a in arrays))


def with_gradient(splats: Splats[torch.Tensor]) -> Splats[torch.Tensor]:
    """Fresh leaves of the same values."""
    return Splats(*(getattr(splats, name).detach().clone().requires_grad_() for name in NAMES))


def upstream(view: View, channels: int, seed: int = 0) -> Rendering[torch.Tensor]:
    """Random upstream gradients for all planes."""
    generator = torch.Generator().manual_seed(seed)
    size = (view.height, view.width)
    return Rendering(
        torch.randn(*size, channels, generator=generator),
        torch.randn(*size, generator=generator),
        torch.randn(*size, generator=generator),
    )


def run(
    draw: Callable, splats: Splats[torch.Tensor], view: View, weights: Rendering[torch.Tensor], **options: object
) -> tuple[Rendering[torch.Tensor], dict[str, torch.Tensor]]:
    """Draw, take the gradient of sum(weights * picture); detached picture and gradients by name."""
    leaves = with_gradient(splats)
    picture = draw(leaves, view, **options)
    parts = ("features", "depth", "alpha")
    loss = sum((getattr(picture, p) * getattr(weights, p).to(picture.alpha.dtype)).sum() for p in parts)
    loss.backward()
    gradients = {}
    for name in NAMES:
        leaf = getattr(leaves, name)
        gradients[name] = torch.zeros_like(leaf) if leaf.grad is None else leaf.grad
    return Rendering(*(getattr(picture, p).detach() for p in parts)), gradients


def pixels_near_the_cut(splats: Splats[torch.Tensor], view: View, pose: torch.Tensor | None = None) -> torch.Tensor:
    """(H, W) truth: rounding may decide there whether a splat counts (alpha near 1/255, or T near the stop)."""
    flat = Splats(splats.means, splats.quats, splats.scales, splats.opacities, splats.features)
    with torch.no_grad():
        raw = _uncut_alphas(flat, view, pose)
        near = ((raw - ALPHA_MIN).abs() < 2e-5 * ALPHA_MIN * 20).any(dim=0)
        alpha, depth = reference.pixel_alphas(flat, view, pose)
        after = torch.cumprod(1 - alpha[torch.argsort(depth, stable=True)], dim=0)
        return near | ((after - 1e-4).abs() < 1e-8).any(dim=0)


def _uncut_alphas(splats: Splats[torch.Tensor], view: View, pose: torch.Tensor | None) -> torch.Tensor:
    """Alphas without the cut, by drawing with a cut of almost zero."""
    before = reference.ALPHA_MIN
    reference.ALPHA_MIN = 1e-4
    try:
        return reference.pixel_alphas(splats, view, pose)[0]
    finally:
        reference.ALPHA_MIN = before


def relative_error(value: torch.Tensor, oracle: torch.Tensor) -> float:
    """L2 of the difference over the L2 of the oracle."""
    return float((value.double() - oracle.double()).norm() / oracle.double().norm().clamp(min=1e-30))
