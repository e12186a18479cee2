"""Hostile splats before the rasteriser: culled, without length, endless, needles, screens full (rows N01 to N13)."""

from __future__ import annotations

import math
import time
from functools import partial

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_core.hard_cases import clips
from genmojo_core.hard_cases.case import Case, hold
from genmojo_core.hard_cases.runs import memory_mb, started
from genmojo_core.kernels.threads import get_threads
from genmojo_core.render import autograd
from genmojo_core.render.cpu.rasterize import rasterize
from genmojo_core.render.rasterizer import ALPHA_MAX, Rendering, Splats

NAMES = ("means", "quats", "scales", "opacities", "features")
ALPHA_LIMIT = 0.99  # as METHOD.md has it, whatever the kernels were compiled with
FULL = 300_000  # splats that each fill a screen


def view(width: int = 32, height: int = 24) -> View:
    """A camera at the origin that looks along z."""
    return View(np.eye(4), float(width), float(width), width / 2, height / 2, width, height)


def cloud(count: int, seed: int = 0) -> Splats[Tensor]:
    """Ordinary splats two to four units before the camera, two feature channels."""
    generator = torch.Generator().manual_seed(seed)
    means = (torch.rand(count, 3, generator=generator) - 0.5) * torch.tensor([2.0, 1.5, 2.0]) + torch.tensor(
        [0, 0, 3.0]
    )
    quats = torch.randn(count, 4, generator=generator)
    scales = 0.03 + 0.1 * torch.rand(count, 3, generator=generator)
    opacities = 0.2 + 0.7 * torch.rand(count, generator=generator)
    return Splats(means, quats, scales, opacities, torch.rand(count, 2, generator=generator))


def drawn(splats: Splats[Tensor]) -> tuple[Rendering[Tensor], dict[str, Tensor]]:
    """The picture and the gradients of a fixed weighted sum of everything in it."""
    leaves = Splats(*(getattr(splats, name).detach().clone().requires_grad_() for name in NAMES))
    picture = autograd.splat(leaves, view())
    generator = torch.Generator().manual_seed(1)
    total = torch.zeros(())
    for part in (picture.features, picture.depth, picture.alpha):
        total = total + (part * torch.randn(part.shape, generator=generator)).sum()
    total.backward()
    return picture, {name: getattr(leaves, name).grad for name in NAMES}


def hostile(name: str, values: tuple[float, ...]) -> str:
    """Splats with one hostile number each: nothing but finite numbers comes out, and who is fine is not disturbed."""
    good = cloud(40)
    bad = cloud(len(values), seed=5)
    for i, value in enumerate(values):
        if name == "depth":
            bad.means[i, 2] = value
        elif name == "quats":
            bad.quats[i] = bad.quats[i] * 0 + value
        else:
            getattr(bad, name).reshape(len(values), -1)[i, 0] = value
    alone, expected = drawn(good)
    both, gradients = drawn(Splats(*(torch.cat([getattr(s, n) for s in (good, bad)]) for n in NAMES)))
    for part in (both.features, both.depth, both.alpha, *gradients.values()):
        hold(bool(torch.isfinite(part).all()), "a number that is not finite came out")
    hold(torch.equal(both.features, alone.features), "splats that must not be drawn changed the picture")
    for key in NAMES:
        hold(not bool(gradients[key][40:].any()), f"{key} of a splat that is not drawn got a gradient")
        hold(torch.allclose(gradients[key][:40], expected[key], rtol=1e-6, atol=0), f"gradients of {key} changed")
    return f"{len(values)} splats left out, 40 others the same"


def needles() -> str:
    """Needles of any length and angle are finite and as opaque as they say."""
    for aspect in (1.0, 1e2, 1e5):
        for k in range(8):
            turn = math.pi * k / 8
            splats = Splats(
                torch.tensor([[1.5 / 32, 1.5 / 32, 3.0]]),
                torch.tensor([[math.cos(turn / 2), 0, 0, math.sin(turn / 2)]]),
                torch.tensor([[0.002 * aspect, 0.002, 0.002]]), torch.tensor([0.9]), torch.ones(1, 2),
            )  # fmt: skip
            picture, gradients = drawn(splats)
            hold(all(bool(torch.isfinite(g).all()) for g in gradients.values()), f"aspect {aspect:g}: no gradient")
            peak = float(picture.alpha.detach().max())
            hold(peak <= 0.9 * 1.01, f"aspect {aspect:g}: alpha {peak:.3f} of a splat of 0.9")
    return "finite for aspects to 1e5 at 8 angles"


def stacks() -> str:
    """Stacks of any height: finite, coverage at most one and at least that of the first layer, opaque ones too."""
    for count in (1, 23, 150, 2000):
        for opacity in (1 / 254, 0.5, 0.99, 1.0):
            layers = torch.linspace(2, 4, count)[:, None] * torch.tensor([0, 0, 1.0])
            quats = torch.tensor([[1.0, 0, 0, 0]]).repeat(count, 1)
            splats = Splats(layers, quats, torch.full((count, 3), 0.5), torch.full((count,), opacity),
                            torch.ones(count, 2))  # fmt: skip
            picture, gradients = drawn(splats)
            hold(all(bool(torch.isfinite(g).all()) for g in gradients.values()), f"{count} x {opacity}: no gradient")
            most = float(picture.features.detach().max())
            hold(most <= 1 + 1e-6, f"{count} layers of {opacity:.3g} sum to {most}")
            hold(most >= 0.97 * min(opacity, ALPHA_MAX), f"{count} layers of {opacity:.3g} show {most}")
    return "finite, sums at most 1 and shows its first layer, for 16 stacks"


def behind_opaque() -> str:
    """What lies behind a splat of opacity 1 still shows a trace and has a say, or it could never come forward."""
    colours = torch.tensor([[1.0, 0.0], [0.0, 1.0]])
    splats = Splats(torch.tensor([[0.0, 0.0, 2.0], [0.0, 0.0, 3.0]]), torch.tensor([[1.0, 0, 0, 0]]).repeat(2, 1),
                    torch.full((2, 3), 20.0), torch.tensor([1.0, 0.5]), colours)  # fmt: skip
    picture, gradients = drawn(splats)
    front, back = picture.features.detach()[12, 16].tolist()
    hold(abs(front - ALPHA_LIMIT) < 1e-3, f"the splat in front shows {front:.4f} instead of {ALPHA_LIMIT}")
    hold(abs(back - (1 - ALPHA_LIMIT) * 0.5) < 5e-4, f"the splat behind shows {back:.5f}")
    hold(all(bool(torch.isfinite(g).all()) for g in gradients.values()), "no gradient")
    hold(bool(gradients["features"][1].abs().max() > 0), "the splat behind has no gradient")
    return f"{100 * back:.2f} % of it shows, with its gradient"


def nothing() -> str:
    """No splat, and none in view: exact background, gradients 0."""
    picture, gradients = drawn(cloud(0))
    hold(not bool(picture.alpha.any()) and gradients["means"].shape == (0, 3), "something was drawn of nothing")
    behind = cloud(20)
    behind.means[:, 2] *= -1
    picture, gradients = drawn(behind)
    hold(not bool(picture.alpha.any()), "something behind the camera was drawn")
    hold(not any(bool(g.any()) for g in gradients.values()), "something behind the camera got a gradient")
    return "exact background, no gradient"


def screen_filling() -> str:
    """300,000 splats that each fill the screen: refused at once, in little memory."""
    rng = np.random.default_rng(0)
    means = (rng.normal(size=(FULL, 3)) * 0.01 + [0, 0, 3]).astype(np.float32)
    splats = Splats(means, np.tile(np.array([1, 0, 0, 0], np.float32), (FULL, 1)), np.full((FULL, 3), 5.0, np.float32),
                    np.full(FULL, 0.5, np.float32), np.ones((FULL, 1), np.float32))  # fmt: skip
    rasterize(Splats(*(getattr(splats, name)[:4] for name in NAMES)), view())  # compile
    start, before = time.process_time(), memory_mb()
    try:
        rasterize(splats, view(1920, 1080))
    except GenmojoError as error:
        seconds, more = (time.process_time() - start) / get_threads(), memory_mb() - before
        hold(error.code == "budget", f"refused as {error.code}")
        hold(seconds < 1.0, f"the refusal took {seconds:.1f} CPU seconds per thread")
        hold(more < 200, f"the refusal took {more:.0f} MiB")
        return f"refused in {seconds:.2f} CPU s per thread and {more:.0f} MiB"
    hold(False, "it was not refused")
    return ""


def screen_filling_object() -> str:
    """An object that blows up in a scene: the refusal names it."""
    run = started(clips.plain(2), gaussians_per_object=120)
    events = iter(run)
    while not hasattr(run, "guard"):
        next(events)
    ball = run.scene.objects[0].gaussians
    with torch.no_grad():
        ball.log_scales.fill_(6.0)
    limit = run.scene.cameras.size
    run.scene.cameras = run.scene.cameras.resized(limit[0] * 400, limit[1] * 400)
    try:
        run.objective.picture(0, deform=False)
    except GenmojoError as error:
        hold(run.scene.objects[0].name in error.sentence(), f"the refusal does not name the object: {error.sentence()}")
        return error.sentence()
    hold(False, "it was not refused")
    return ""


NAN, INF = math.nan, math.inf
CASES = (
    Case("N01", "depths at and behind the camera", partial(hostile, "depth", (-1.0, 0.0, 1e-9, 0.005, 1e9, -INF, NAN))),
    Case("N02", "quaternions without length", partial(hostile, "quats", (0.0, 1e-20, 1e-40, NAN, INF))),
    Case("N03", "scales without measure", partial(hostile, "scales", (INF, NAN, -INF))),
    Case("N12", "opacities that show nothing", partial(hostile, "opacities", (0.0, 1e-30, 1 / 256, NAN))),
    Case("N05", "needles", needles),
    Case("N13", "stacks of splats", stacks),
    Case("N13", "behind an opaque splat", behind_opaque),
    Case("N20", "no splat in view", nothing),
    Case("N08", "300,000 screen-filling splats", screen_filling),
    Case("N08", "an object that fills the screen", screen_filling_object),
)
