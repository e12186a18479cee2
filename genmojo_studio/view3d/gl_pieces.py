"""Small pieces of GL code: uniforms, samplers, targets, and numbers in the form shaders want."""

from __future__ import annotations

from typing import Any

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.render.rasterizer import FRUSTUM_CLAMP

SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software", "gdi generic")  # parts of such renderers' names


def is_software(renderer: str) -> bool:
    """Is this GL_RENDERER a program on the processor?"""
    return any(part in renderer.lower() for part in SOFTWARE)


def jacobian_limits(view: View) -> tuple[float, float, float, float]:
    """Lowest and highest u, lowest and highest v at which the projection's Jacobian is taken (render/rasterizer.py)."""
    x, y = ((FRUSTUM_CLAMP - 1) / 2 * s for s in (view.width, view.height))
    return (-(view.cx + x) / view.fx, (view.width - view.cx + x) / view.fx,
            -(view.cy + y) / view.fy, (view.height - view.cy + y) / view.fy)  # fmt: skip


def matrix(world_to_camera: np.ndarray) -> tuple[float, ...]:
    """Sixteen numbers, column by column as GLSL wants them."""
    return tuple(float(v) for v in np.asarray(world_to_camera).T.ravel())


def set_uniform(program: Any, name: str, value: Any) -> None:
    """Set a uniform unless the driver has optimised it away."""
    if name in program:
        program[name].value = value


def bind(program: Any, textures: dict[str, Any]) -> None:
    """Give textures to a program's samplers."""
    for unit, (name, texture) in enumerate(textures.items()):
        texture.use(unit)
        set_uniform(program, name, unit)


def release_target(target: Any) -> None:
    """Free a framebuffer and its textures."""
    for texture in target.color_attachments:
        texture.release()
    target.release()


def straight(premultiplied: np.ndarray) -> np.ndarray:  # (H, W, 4) uint8
    """Colours divided by coverage, as PNG wants them."""
    alpha = premultiplied[..., 3:].astype(np.float32)
    rgb = premultiplied[..., :3] * (255.0 / np.maximum(alpha, 1.0))
    return np.concatenate([np.minimum(rgb + 0.5, 255).astype(np.uint8), premultiplied[..., 3:]], axis=-1)
