"""The first thing to see, long before the first optimised scene: one frame lifted to points by its depth.

Imports no torch, so that it stands while torch still loads.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from genmojo_core.clip import folders
from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_studio.view3d.snapshot import SnapshotObject
from genmojo_studio.worker.preview_codec import Cloud, Setting
from genmojo_studio.worker.protocol import RunRequest

SHORT_SIDE = 160  # pixels: enough to see where things are, lifted in a fraction of a second
POINTS = 20_000
_SIGMA = 0.6  # of the distance between neighbouring points
_COLORS = ((0.90, 0.30, 0.25), (0.25, 0.60, 0.90), (0.35, 0.75, 0.35), (0.95, 0.70, 0.20), (0.65, 0.40, 0.80))


@dataclass(frozen=True)
class FirstCloud:
    """Points of frame `t` of a clip of `setting.frames` frames."""

    cloud: Cloud
    t: int
    setting: Setting


def first_cloud(request: RunRequest) -> FirstCloud | None:
    """The frame on show (else the middle one) as points; None where one frame alone does not tell depth or objects.

    Raises GenmojoError for a clip that cannot be read.
    """
    clip = folders.read(request.clip, frames=request.frames, short_side=SHORT_SIDE, ignore=request.ignore,
                        pixel_aspect=request.pixel_aspect)  # fmt: skip
    t = len(clip) // 2 if request.look_at is None else min(max(request.look_at, 0), len(clip) - 1)
    first = request.frames[0] if request.frames else 0
    one = folders.read(request.clip, frames=(first + t, first + t + 1), short_side=SHORT_SIDE, ignore=request.ignore,
                       pixel_aspect=request.pixel_aspect)  # fmt: skip
    try:
        one = complete(one)
    except GenmojoError:
        return None
    if one.depth is None or one.masks is None or one.cameras is None:
        return None
    given: Cameras = one.cameras.value
    cloud = _lifted(one, given)
    tiled = [np.repeat(part[:1], len(clip), 0) for part in (given.K, given.world_to_camera)]
    cameras = Cameras(tiled[0], tiled[1], given.size, given.near, given.far)
    objects = [SnapshotObject(int(i), name, _COLORS[k % len(_COLORS)])
               for k, (i, name) in enumerate(zip(one.object_ids, one.object_names, strict=True))]  # fmt: skip
    objects.append(SnapshotObject(0, "background", (0.5, 0.5, 0.5), True))
    setting = Setting(len(clip), tuple(objects), cameras.resized(*one.source_size), np.asarray(one.world_up, float))
    return FirstCloud(cloud, t, setting)


def _lifted(clip: Clip, cameras: Cameras) -> Cloud:
    """Every pixel of a one-frame clip as a small round Gaussian, thinned to POINTS; objects first."""
    depth, valid, labels = clip.depth.value[0], clip.depth.valid[0], clip.masks.value[0]  # type: ignore[union-attr]
    view = cameras.resized(*clip.size).view(0)
    height, width = depth.shape
    step = max(1, math.ceil(math.sqrt(depth.size / POINTS)))
    rows, columns = np.mgrid[step // 2 : height : step, step // 2 : width : step].reshape(2, -1)
    keep = valid[rows, columns] & (depth[rows, columns] > 0)
    rows, columns = rows[keep], columns[keep]
    order = np.argsort(labels[rows, columns] == 0, kind="stable")
    rows, columns = rows[order], columns[order]
    z = depth[rows, columns].astype(np.float64)
    local = np.stack([(columns + 0.5 - view.cx) / view.fx * z, (rows + 0.5 - view.cy) / view.fy * z, z], axis=1)
    to_world = np.linalg.inv(view.world_to_camera)
    count = len(z)
    sigma = np.repeat((_SIGMA * step * z / view.fx)[:, None], 3, axis=1)
    return Cloud(
        local @ to_world[:3, :3].T + to_world[:3, 3], np.tile([1.0, 0, 0, 0], (count, 1)), sigma, np.full(count, 0.9),
        clip.frames[0][rows, columns] / 255.0, labels[rows, columns].astype(np.uint16),
        np.arange(count, dtype=np.uint64),
    )  # fmt: skip
