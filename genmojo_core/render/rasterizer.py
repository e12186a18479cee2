"""The one interface of all rasterisers: what goes in, what comes out, which constants hold.

Semantics (METHOD.md section 5, RASTER.md section 1), equal in every backend: EWA projection, dilated by the
view's `dilation` px^2 (0.3 at the size a scene was optimised at and scaled with the area at others, so that a scene
looks the same at every size), with a frustum clamp of the Jacobian at 1.3 x the field of view measured from the
principal point; pixel centres at +0.5; alpha = min(0.99, opacity exp(-q/2)), contributions below 1/255 are cut, and
blending stops before transmittance would fall to 1e-4; splats sorted by camera z once per view, ties by index. Outputs
are premultiplied sums over w = alpha T.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

ALPHA_MIN = 1.0 / 255.0
ALPHA_MAX = 0.99
TRANSMITTANCE_MIN = 1e-4
FRUSTUM_CLAMP = 1.3

Array = TypeVar("Array")


@dataclass(frozen=True)
class Splats(Generic[Array]):
    """N Gaussians in world space, activated. Arrays are numpy (CPU kernels) or torch (autograd).

    Args:
        means: (N, 3) world, scene units.
        quats: (N, 4) wxyz; any length > 0, normalised inside (gradient goes through the normalisation).
        scales: (N, 3) linear standard deviations, scene units.
        opacities: (N,) in 0..1.
        features: (N, C) any channels: colour, labels, flow ...; blended, not clamped.
    """

    means: Array
    quats: Array
    scales: Array
    opacities: Array
    features: Array


@dataclass(frozen=True)
class Rendering(Generic[Array]):
    """What one view of splats looks like.

    Args:
        features: (H, W, C) premultiplied sums of w f.
        depth: (H, W) premultiplied sum of w z; divide by alpha for a depth, and only where alpha >= 1e-4.
        alpha: (H, W) coverage, 1 - final transmittance.
    """

    features: Array
    depth: Array
    alpha: Array
