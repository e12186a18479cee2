"""What an effect costs before it has run: a plain model, milliseconds per step on two CPU cores and megabytes.

Splatting costs a share per Gaussian and a share per pixel and channel; a deformation field costs a share per Gaussian.
The constants come from the measurements of the CPU kernels at 10 000 splats and 256 x 256 pixels (RASTER.md section 3)
and are within a factor of two; measured costs replace them once runs report them.
"""

from __future__ import annotations

from dataclasses import dataclass

from genmojo_core.config import RunConfig

SPLAT_MS = 2.2e-4  # per Gaussian and view, forward and backward
PIXEL_MS = 1.0e-4  # per pixel and view, whatever the channels
CHANNEL_MS = 1.5e-5  # per pixel, view and channel, with its loss
FIELD_MS = 1.2e-3  # per Gaussian and view: K-planes, bases and heads, forward and backward
TRACK_MS = 1e-3  # per supervised point and view
BYTES_PER_VALUE = 16  # float32 with its gradient and two moments of the optimiser
GAUSSIAN_VALUES = 14  # mean 3, scale 3, quaternion 4, opacity 1, colour 3
TRACKS_PER_OBJECT = 200


@dataclass(frozen=True)
class Sizes:
    """What a run is made of.

    Args:
        frames: of the clip. views: frames splatted per step. pixels: of a frame as optimised. objects: K.
        gaussians: per object. background: Gaussians of the background. background_share: of the pixels.
    """

    frames: int
    views: int
    pixels: int
    objects: int
    gaussians: int
    background: int
    background_share: float


def run_sizes(size: tuple[int, int], frames: int, objects: int, background_share: float, config: RunConfig) -> Sizes:
    """Sizes of a run on a clip of (width, height) pixels, which is reduced to the preset's short side if larger."""
    scale = min(1.0, config.short_side / min(size))
    pixels = round(size[0] * scale) * round(size[1] * scale)
    return Sizes(frames, min(config.frames_per_step, frames), pixels, max(objects, 1), config.gaussians_per_object,
                 config.background_gaussians, background_share)  # fmt: skip


def predict(name: str, sizes: Sizes, config: RunConfig) -> tuple[float, float]:
    """(ms per step, MB) that an effect adds while it is on; KeyError for a name that is no effect."""
    s = sizes
    moving = s.gaussians * s.objects
    channel = s.views * s.pixels * CHANNEL_MS
    table = {
        "joint_occlusion": (s.views * (s.objects - 1) / s.objects * moving * SPLAT_MS, 0.0),
        "background": (s.views * (s.background * SPLAT_MS + s.pixels * s.background_share * PIXEL_MS),
                       _megabytes(s.background * GAUSSIAN_VALUES)),
        "camera_motion": (s.views * (moving + s.background) * SPLAT_MS * 0.1, s.frames * 25 * 8 / 1e6),
        "non_rigid_motion": (s.views * moving * FIELD_MS, s.objects * _field_megabytes(s, config)),
        "appearance_change": (s.views * moving * FIELD_MS * 0.1 + 3 * channel / s.views,
                              _megabytes(s.frames * 3 + s.objects * config.field_width * (config.field_width + 3))),
        "shading": (s.views * moving * SPLAT_MS, _megabytes(8)),
        "unseen_views": (s.objects * (40.0 + 128 * 128 * PIXEL_MS + s.gaussians * SPLAT_MS), 150.0),
        "instance_labels": (s.objects * channel, s.views * s.pixels * s.objects * 4 / 1e6),
        "depth_order": (channel, s.frames * s.pixels * 4 / 1e6),
        "flow": (2 * channel + s.views * moving * SPLAT_MS, s.frames * s.pixels * 9 / 1e6),
        "track_supervision": (s.views * s.objects * TRACKS_PER_OBJECT * TRACK_MS,
                              s.frames * s.objects * TRACKS_PER_OBJECT * 12 / 1e6),
        "reappearance": (0.0, s.frames * s.objects * 4 / 1e6),
    }  # fmt: skip
    return table[name]


def _field_megabytes(sizes: Sizes, config: RunConfig) -> float:
    """One object's K-planes (METHOD.md section 4: three space planes, three with time) and heads."""
    times = max(4, int(0.8 * sizes.frames))
    cells = sum(3 * (config.plane_resolution * level) ** 2 + 3 * config.plane_resolution * level * times
                for level in config.plane_levels)  # fmt: skip
    return _megabytes(cells * config.plane_channels + config.motion_bases * 3 * sizes.frames)


def _megabytes(values: float) -> float:
    """Memory of so many optimised numbers."""
    return values * BYTES_PER_VALUE / 1e6
