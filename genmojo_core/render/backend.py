"""Which rasteriser a run uses. All have the signature and semantics of `autograd.splat`."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_core.kernels.probe import kernels_work
from genmojo_core.render.rasterizer import Rendering, Splats
from genmojo_core.sentences import say


class Splat(Protocol):
    """A differentiable rasteriser."""

    def __call__(
        self, splats: Splats[Tensor], view: View, *, detached_channels: int = 0, pose: Tensor | None = None
    ) -> Rendering[Tensor]:
        """Draw splats: see render/autograd.py."""
        ...


def choose(device: str) -> Splat:
    """The rasteriser for "cpu", "cuda" or "auto" (CUDA where there is a device and gsplat, else the CPU).

    On the CPU: the compiled kernels, or plain torch tiles with one warning where they do not compile. Raises
    GenmojoError("argument") for another name, GenmojoError("missing_package") for "cuda" without a device or gsplat.
    """
    kind = torch.device("cpu").type if device == "auto" else device.split(":")[0]
    if kind not in ("cpu", "cuda"):
        raise GenmojoError("argument", f"there is no rasteriser for device '{device}'", "--device", "use cpu or cuda")
    # Imported where chosen: gsplat and numba are each absent on some machine.
    if kind == "cuda" or (device == "auto" and torch.cuda.is_available()):
        try:
            from genmojo_core.render import cuda
        except ImportError as error:
            if device != "auto":
                raise GenmojoError("missing_package", "gsplat is not installed", "--device cuda",
                                   "install genmojo-studio[cuda] or use --device cpu") from error  # fmt: skip
        else:
            if torch.cuda.is_available():
                return cuda.splat
            raise GenmojoError("missing_package", "torch sees no CUDA device", "--device cuda", "use --device cpu")
    if kernels_work():
        from genmojo_core.render import autograd

        return autograd.splat
    from genmojo_core.render import torch_tiles

    return torch_tiles.splat


def splat_frames(
    splat: Splat, splats: Sequence[Splats[Tensor]], views: Sequence[View], *, detached_channels: int = 0
) -> list[Rendering[Tensor]]:
    """The pictures of several frames by a rasteriser of `choose`: at once where it can, else one by one."""
    if kernels_work():
        from genmojo_core.render import autograd

        if splat is autograd.splat:
            return autograd.splat_frames(splats, views, detached_channels=detached_channels)
    return [splat(s, v, detached_channels=detached_channels) for s, v in zip(splats, views, strict=True)]


def warm_up(report: Callable[[str], None] | None = None) -> threading.Thread:
    """Compile every CPU kernel on a thread of its own, e.g. while a clip is read; returns the started thread.

    `report` gets one sentence if this machine has nothing compiled yet. A render meanwhile waits for what it needs.
    """
    thread = threading.Thread(target=_compile, args=(report,), name="genmojo-warm-up", daemon=True)
    thread.start()
    return thread


def _compile(report: Callable[[str], None] | None) -> None:
    """Run every kernel once on almost nothing."""
    if not kernels_work():
        return
    from genmojo_core.kernels.cache import is_cold
    from genmojo_core.render import autograd
    from genmojo_core.render.cpu import joint_loss
    from genmojo_core.render.ssim import ssim_map
    from genmojo_core.scene.motion_cpu.rigidity import Edges, Pair, rigid_terms
    from genmojo_core.scene.plane_sampling import sample_planes, sample_time_planes

    if report is not None and is_cold():
        report(say("compiling"))
    places = torch.tensor([[0.0, 0.0, 2.0]], requires_grad=True)
    one = Splats(places, torch.tensor([[1.0, 0, 0, 0]]), torch.ones(1, 3), torch.full((1,), 0.5), torch.ones(1, 3))
    picture = autograd.splat(one, View(torch.eye(4).numpy(), 8.0, 8.0, 4.0, 4.0, 8, 8)).features
    ssim_map(picture[None], torch.zeros(1, 8, 8, 3)).sum().backward()
    planes = torch.ones(3, 2, 2, 8, requires_grad=True)
    product = sample_planes(planes, places)[None] * sample_time_planes(planes, places, torch.zeros(1))
    product.sum().backward()
    points, turns, index = np.zeros((1, 3), np.float32), np.zeros((1, 4), np.float32), np.zeros((1, 1), np.int64)
    rigid_terms(Pair(points, points, turns, turns), Edges(index, points[:, :1].copy(), index[0]))
    joint_loss.warm_up()
