"""Run configuration: frozen dataclasses, presets, and one check that reports all faults together."""

from __future__ import annotations

import math
import re
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, Literal

from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class LossWeights:
    """Weights of the joint losses, in units where the RGB term's is 1 (METHOD.md section 5, divided by 1e4)."""

    rgb: float = 1.0  # L1 + SSIM over the frame, foreground and background balanced
    ssim: float = 0.2  # 1 - SSIM of colour, foreground and background balanced
    alpha: float = 0.3  # coverage against the union of masks, balanced
    spill: float = 0.3  # coverage beside the masks, in areas of the masks, linear
    gaps: float = 1.0  # mean squared transparency of a picture with background
    labels: float = 0.1  # instance composition against the masks
    depth: float = 0.2  # relative depth error inside the masks
    depth_order: float = 0.05  # hinge between overlapping objects' depths
    flow: float = 0.05  # L1 of splatted flow, in units of the image diagonal x 100
    tracks: float = 0.5  # robust distance of carried points to their tracks
    hull: float = 1.0  # distance of an object's Gaussians to where its masks allow it, in units of 1 % of the diagonal
    rigidity: float = 1.0  # neighbours move rigidly (corrected rotation)
    rotation: float = 0.1  # neighbours turn alike
    local_scale: float = 0.5  # neighbours change size alike
    delta_scale: float = 0.1  # |change of log scale|
    delta_color: float = 0.5  # |change of colour|: motion must not be explained by colour
    smooth: float = 0.2  # second difference of motion in time
    unseen: float = 4.0  # mean squared gap to what the prior expects of unseen views


@dataclass(frozen=True)
class LearningRates:
    """AdamW step sizes; positions are in units of the object's size (METHOD.md section 5, with the corrections)."""

    means: float = 1.6e-3
    rigid_means: float = 1.0  # times means: of objects that do not bend
    log_scales: float = 5e-3
    quats: float = 5e-3
    logit_opacities: float = 5e-2
    dc: float = 1e-2
    planes: float = 6.4e-3
    heads: float = 6.4e-4
    bases: float = 2e-3
    placement: float = 1e-3
    delta_color: float = 1e-3
    shade: float = 5e-3  # eight numbers that every Gaussian has a say in


@dataclass(frozen=True)
class RunConfig:
    """Everything that decides what a run does, besides the clip and its effect plan."""

    preset: str = "standard"
    short_side: int = 256  # pixels of the frame's short side while optimising
    gaussians_per_object: int = 5000  # upper bound
    background_gaussians: int = 12000  # upper bound
    lift_steps: int = 100  # static lift, per run (all objects at once)
    joint_steps: int = 700  # joint steps over all frames
    rigid_steps: int = 0  # joint steps where no object bends and one costs less than half; 0: joint_steps
    settle_steps: int = 150  # of a background that stands still, before all others (optimise/still.py)
    frames_per_step: int = 3  # frames splatted per joint step
    budget_seconds: float = 600.0  # the run ends here at the latest, with what it has
    clock: Literal["wall", "cpu"] = "wall"  # which seconds the budget counts; CPU seconds on a machine that others use
    until: str = ""  # it ends before that once this holds: "psnr>=26" or "gain<0.1dB/min" (`goal_of`)
    motion_bases: int = 10
    plane_resolution: int = 48  # spatial nodes of the coarse K-plane level
    plane_levels: tuple[int, ...] = (1, 2)
    plane_channels: int = 16
    field_width: int = 64
    neighbours: int = 15
    densify_every: int = 75
    weights: LossWeights = field(default_factory=LossWeights)
    rates: LearningRates = field(default_factory=LearningRates)
    held_out_share: float = 0.02  # of the foreground, in 4 x 4 blocks that no loss sees
    held_out_every: int = 0  # every so many-th frame is in no loss and not followed either; 0 = every frame is used
    paced: bool = False  # steps follow the budget: the schedule ends when the time does
    checkpoint_seconds: float = 30.0
    seed: int = 0
    device: str = "auto"
    prior: str = "none"  # embedded, none, zero123:DIR or zeronvs:DIR
    prior_mode: Literal["auto", "sds", "x0", "pseudo"] = "auto"  # priors/sds.py; auto: pseudo if it can, else sds
    prior_scope: Literal["object", "scene"] = "object"  # what the prior is shown: one object, or all as one
    view_range: float = 180.0  # degrees round every frame's camera that the user may want to look from
    prior_views: int = 4  # views per object and step
    prior_objects: int = 1  # objects per step that are shown to the prior; 0 = all
    method: str = "genmojo"
    ignore: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """Plain data, written into scene files and checkpoints."""
        return asdict(self)

    def joint_steps_of(self, bends: bool) -> int:
        """Joint steps of a run whose objects bend or do not."""
        return self.joint_steps if bends or not self.rigid_steps else self.rigid_steps


MEASURED_SIDE = 256  # pixels on the short side at which scenes are measured, whatever size was optimised
MOTION_SHARE = 0.4  # of the budget: most that the search for motion may take
SETTLE_SHARE = 0.1  # of the budget: most that fitting a still background may take
LIFT_SHARE = 0.08  # of a paced run's time after the motion
OUTWARD_SHARE = 0.3  # of the joint stage, by which all frames take part


def outward_reach(frames: int, share: float) -> int:
    """How many frames away from the canonical one take part once a share (0..1) of the joint stage is done."""
    return 2 + math.ceil((frames - 1) * min(1.0, share / OUTWARD_SHARE))


# draft: 224 px, because frames kept at 128 px and enlarged to 256 reach 24.6 dB at best on the clip "crossing".
# Positions of rigid objects learn half as fast: else they take up in few steps what the poses are off by (blender-cross
# 29.3 -> 30.0 dB and 0.71 -> 0.58 px, with 360 steps; the bending people of "crossing" would lose 0.2 dB by it).
PRESETS: dict[str, RunConfig] = {
    "draft": RunConfig(
        preset="draft", short_side=224, gaussians_per_object=2000, background_gaussians=14000, lift_steps=60,
        joint_steps=240, rigid_steps=300, settle_steps=60, frames_per_step=2, budget_seconds=70.0, plane_resolution=24,
        plane_channels=8, densify_every=40, rates=LearningRates(rigid_means=0.5),
    ),
    "standard": RunConfig(prior="embedded"),
    "full": RunConfig(
        preset="full", short_side=480, gaussians_per_object=15000, background_gaussians=60000, lift_steps=1000,
        joint_steps=40 * 32, settle_steps=400, frames_per_step=8, budget_seconds=math.inf, plane_resolution=64,
        plane_levels=(1, 2, 4, 8), plane_channels=32, prior="embedded",
    ),
}  # fmt: skip


def preset(name: str, **changes: Any) -> RunConfig:
    """A preset with some fields replaced, checked. Joint steps that are asked for are those of every run.

    Raises GenmojoError("config") naming every fault at once: unknown preset, unknown field, value out of range.
    """
    if name not in PRESETS:
        raise GenmojoError("config", f"there is no preset '{name}'", "--preset", f"use one of {', '.join(PRESETS)}")
    known = {f.name for f in fields(RunConfig)}
    unknown = sorted(set(changes) - known)
    if unknown:
        raise GenmojoError("config", f"there is no setting {', '.join(unknown)}", "configuration")
    if "joint_steps" in changes:
        changes = {"rigid_steps": 0, **changes}
    config = replace(PRESETS[name], **changes)
    faults = _faults(config)
    if faults:
        raise GenmojoError("config", "; ".join(faults), "configuration", "correct these settings")
    return config


@dataclass(frozen=True)
class Goal:
    """When a run has done enough: held-out PSNR reached, or the next minute's expected gain below.

    Args:
        kind: "psnr" (at least, dB) or "gain" (less than, dB per minute).
        value: the limit.
    """

    kind: str
    value: float


def goal_of(text: str) -> Goal | None:
    """The goal a text names ("psnr>=26", "gain<0.1dB/min"); None for none. Raises GenmojoError("config")."""
    if not text.strip():
        return None
    number = r"([0-9]*\.?[0-9]+)"
    for kind, pattern in (("psnr", rf"psnr>={number}(?:db)?"), ("gain", rf"gain<{number}db/min")):
        match = re.fullmatch(pattern, re.sub(r"\s+", "", text).lower())
        if match:
            return Goal(kind, float(match[1]))
    raise GenmojoError("config", f"'{text}' is no goal", "--until", 'write "psnr>=26" or "gain<0.1dB/min"')


_RANGES: dict[str, tuple[float, float]] = {
    "short_side": (16, 4096),
    "gaussians_per_object": (16, 200_000),
    "background_gaussians": (0, 2_000_000),
    "lift_steps": (0, 100_000),
    "joint_steps": (0, 10_000_000),
    "rigid_steps": (0, 10_000_000),
    "settle_steps": (0, 100_000),
    "frames_per_step": (1, 64),
    "budget_seconds": (1.0, math.inf),
    "motion_bases": (1, 64),
    "plane_resolution": (2, 256),
    "plane_channels": (1, 128),
    "field_width": (4, 1024),
    "neighbours": (1, 64),
    "densify_every": (1, 1_000_000),
    "held_out_share": (0.0, 0.5),
    "held_out_every": (0, 1000),
    "checkpoint_seconds": (0.1, math.inf),
    "view_range": (0.0, 180.0),
    "prior_views": (1, 64),
    "prior_objects": (0, 255),
    "seed": (0, 2**31 - 1),
}
PRIORS = ("none", "embedded", "zero123:DIR", "zeronvs:DIR")
METHODS = ("genmojo", "dreamscene4d", "dreamgaussian4d", "shape-of-motion")  # optimise/methods.py
PRIOR_MODES = ("auto", "sds", "x0", "pseudo")


def _faults(config: RunConfig) -> list[str]:
    """Every value that is out of its range, as sentences without full stops."""
    faults = []
    if config.paced and not math.isfinite(config.budget_seconds):
        faults.append("a paced run needs a budget")
    for name, (low, high) in _RANGES.items():
        value = getattr(config, name)
        if not isinstance(value, int | float) or math.isnan(value) or not low <= value <= high:
            faults.append(f"{name} is {value}, allowed is {low:g} to {high:g}")
    for group in (config.weights, config.rates):
        for f in fields(group):
            value = getattr(group, f.name)
            if not math.isfinite(value) or value < 0:
                faults.append(f"{type(group).__name__}.{f.name} is {value}, allowed is 0 or more")
    kind, colon, folder = config.prior.partition(":")
    if kind not in [name.partition(":")[0] for name in PRIORS] or bool(folder) != (kind in ("zero123", "zeronvs")):
        faults.append(f"there is no prior '{config.prior}', only {', '.join(PRIORS)}")
    if config.clock not in ("wall", "cpu"):
        faults.append(f"there is no clock '{config.clock}', only wall, cpu")
    if config.prior_scope not in ("object", "scene"):
        faults.append(f"there is no prior scope '{config.prior_scope}', only object, scene")
    if config.prior_mode not in PRIOR_MODES:
        faults.append(f"there is no prior mode '{config.prior_mode}', only {', '.join(PRIOR_MODES)}")
    if config.method not in METHODS:
        faults.append(f"there is no method '{config.method}', only {', '.join(METHODS)}")
    try:
        goal_of(config.until)
    except GenmojoError as error:
        faults.append(f"{error.what}: {error.hint}")
    known = ("depth", "cameras", "flow", "background", "tracks")
    faults += [f"cannot ignore '{name}', only {', '.join(known)}" for name in config.ignore if name not in known]
    return faults
