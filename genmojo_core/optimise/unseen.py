"""The prior's part in a run: which frames and objects it speaks for, first Gaussians of unseen sides, its loss.

Each step one object (or all) is shown to the prior alone, in the prior's space, from views around one of its good
frames (METHOD.md sections 2 and 5). No gradient reaches the placement: the prior knows shapes, not places. Where the
prior gave Gaussians of its own, only those (and what grows later) follow it; what frames show is theirs alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.clip.clip import Clip
from genmojo_core.config import RunConfig
from genmojo_core.conventions import matrix_to_quaternion
from genmojo_core.optimise.first_poses import Moves
from genmojo_core.optimise.lift import Lifted
from genmojo_core.optimise.objective import Outcome
from genmojo_core.priors.completion import in_world, selected, surface_points, unseen_only
from genmojo_core.priors.embedded import EmbeddedPrior, view_cameras
from genmojo_core.priors.prior import ViewOffsets, ViewPrior
from genmojo_core.priors.references import LEAST_VISIBLE, PlacedReference, reference_of
from genmojo_core.priors.sds import Mode, distil
from genmojo_core.priors.solids import HALF_EXTENT
from genmojo_core.priors.zero123 import Zero123Prior
from genmojo_core.render.backend import Splat
from genmojo_core.render.rasterizer import Splats
from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.initialise import Points, surface_axes
from genmojo_core.scene.scene4d import ObjectModel

ELEVATION = 30.0  # degrees around the reference's
TRUSTED = 0.3  # confidence of a frame's pose from which it may contradict the prior
FRAMES = 12  # references per object at most, spread over the clip
POINT_SHARE = 0.25  # of the allowed Gaussians, spent on unseen sides at first
LAST_WEIGHT = 0.1  # of the loss, reached at the end of the run's last third
WORSE = 1.0  # dB on held-out pixels below its best at which the prior is switched off
ALL_FRAMES = 0.5  # share of the run from which held-out pixels are watched
SIZES = ((0.3, 2), (0.6, 3), (1.0, 4))  # until this share of the run: render side in units of the prior's side


@dataclass
class Subject:
    """What the prior sees at once: one object, or all of them.

    models: of the objects. clip_indices: theirs in the clip. name: for messages. home: the frame it is best seen in.
    references: by frame; conditions: made on demand; off: why the other frames are none.
    """

    models: list[ObjectModel]
    clip_indices: tuple[int, ...]
    name: str
    home: int
    references: dict[int, PlacedReference]
    off: dict[int, str]
    conditions: dict[int, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Moment:
    """When a step takes place: share 0..1 of the run done, whether objects deform, the step's number."""

    share: float
    deform: bool
    step: int


class UnseenViews:
    """The prior in one run.

    Args:
        prior, clip, config: what is asked, about what, how. lifted: the first scene. motions: of the clip's objects.
    """

    def __init__(
        self, prior: ViewPrior, clip: Clip, config: RunConfig, lifted: Lifted, motions: Sequence[Moves],
        splat: Splat,
    ) -> None:  # fmt: skip
        self.prior, self.clip, self.config, self.splat = prior, clip, config, splat
        self.scene = lifted.scene
        everything = "scene" in (config.prior_scope, prior.scope)
        groups = [tuple(lifted.rows)] if everything else [(k,) for k in lifted.rows]
        self.subjects = [_subject(clip, lifted, group) for group in groups]
        self.seen: list[tuple[float, float, int]] = []
        self.best, self.share = 0.0, 0.0
        self.first_free: dict[int, int] = {}  # by object id: Gaussians with smaller uids are the frames' alone
        if isinstance(prior, EmbeddedPrior) and not everything:
            for one in self.subjects:
                self._complete(prior, one, motions[one.clip_indices[0]], lifted)

    def notes(self) -> list[str]:
        """What a large prior will need; a sentence per object it does not speak for, or only in some frames."""
        sentences = []
        if isinstance(self.prior, Zero123Prior):
            needed = self.prior.forecast_mb(self.config.prior_views)
            sentences.append(f"the prior {self.prior.kind} is expected to need {needed:.0f} MiB")
        for one in self.subjects:
            if not one.references:
                reason = "; ".join(dict.fromkeys(one.off.values()))
                sentences.append(f"the prior is off for {one.name}: {reason}")
            elif one.off:
                frames = ", ".join(f"{t} ({reason})" for t, reason in sorted(one.off.items()))
                sentences.append(f"the prior is off for {one.name} in frames {frames}")
        return sentences

    def add_to(self, outcome: Outcome, moment: Moment, weight: float, generator: torch.Generator) -> None:
        """Add the prior's loss for one step, `weight` included, to what the frames say."""
        ready = [one for one in self.subjects if one.references]
        if not ready:
            return
        rng = np.random.default_rng((self.config.seed, moment.step, 77))
        chosen = rng.permutation(len(ready))[: self.config.prior_objects or len(ready)]
        losses = [self._object_loss(ready[i], moment, rng, generator) for i in chosen]
        loss = weight * fade(moment.share) * torch.stack(losses).mean()
        outcome.loss = outcome.loss + loss.to(outcome.loss.device)
        outcome.parts["unseen"] = float(loss.detach())
        self.share = moment.share

    def objection(self, psnr: float) -> str:
        """Why the prior must be switched off: held-out pixels got worse while it spoke; empty while they agree.

        Judged once all frames take part, because frames that join late lower the figure on their own.
        """
        if self.share < ALL_FRAMES or not psnr:
            return ""
        self.best = max(self.best, psnr)
        if psnr > self.best - WORSE:
            return ""
        return f"held-out pixels fell from {self.best:.1f} to {psnr:.1f} dB while the prior spoke: it is switched off"

    def mode(self) -> Mode:
        """How the prior is followed: as configured; by itself the embedded one as pseudo-views, others by sds."""
        chosen = self.config.prior_mode
        if chosen == "auto":
            return "pseudo" if isinstance(self.prior, EmbeddedPrior) else "sds"
        return chosen

    def supervised(self) -> np.ndarray:
        """(M, 3) float32 rows elevation, azimuth (degrees), frame of the views the prior judged."""
        return np.array(self.seen, np.float32).reshape(-1, 3)

    def _object_loss(
        self, one: Subject, moment: Moment, rng: np.random.Generator, generator: torch.Generator
    ) -> Tensor:
        frames = sorted(one.references)
        t = int(rng.choice(frames)) if moment.deform else min(frames, key=lambda f: abs(f - one.home))
        placed = one.references[t]
        if t not in one.conditions:
            one.conditions[t] = self.prior.encode(placed.reference)
        views = draw_views(rng, self.config.prior_views)
        self.seen += [(float(e), float(a), t) for e, a in zip(views.elevation, views.azimuth, strict=True)]
        pictures = self._render(one.models, placed, t, views, moment)
        level = float(rng.uniform(*levels(moment.share)))
        said = distil(self.prior, pictures, one.conditions[t], views, level, self.mode(), generator)
        return said.loss * placed.visible * (2.0 / said.gradient.numel())

    def _render(
        self, models: list[ObjectModel], placed: PlacedReference, t: int, views: ViewOffsets, moment: Moment
    ) -> Tensor:  # (B, 4, S, S)
        """The objects alone from the prior's cameras, premultiplied RGBA."""
        parts = [self._splats(model, placed, t, moment.deform) for model in models]
        splats = Splats(*(torch.cat(columns) for columns in zip(*parts, strict=True)))
        side = self.prior.resolution * render_factor(moment.share)
        distance = self.prior.distance(placed.reference)
        focal = side / 2 * distance / HALF_EXTENT
        pictures = []
        for pose in view_cameras(placed.reference, views, distance):
            drawn = self.splat(splats, View(pose, focal, focal, side / 2, side / 2, side, side))
            pictures.append(torch.cat([drawn.features, drawn.alpha[..., None]], dim=-1).movedim(-1, 0))
        return torch.stack(pictures)

    def _splats(self, model: ObjectModel, placed: PlacedReference, t: int, deform: bool) -> tuple[Tensor, ...]:
        """Means, quats, scales, opacities and colours of one object at frame t in the prior's space."""
        state = model.states([t], deform)[0]
        scale, quat, origin = _object_to_prior(model, placed, t)
        means = scale * safemath.rotate(quat, state.local_means) + origin
        quats = safemath.quaternion_multiply(quat.expand_as(state.local_quats), state.local_quats)
        bent = state.deformation
        log_scales = model.gaussians.log_scales if bent is None else model.gaussians.log_scales + bent.d_log_scales
        scales = scale * safemath.exp_scale(log_scales)
        columns = (means, quats, scales, model.gaussians.opacities(), state.rgb * self._light(t))
        free = model.gaussians.uid >= self.first_free.get(model.id, 0)
        return tuple(torch.where(free.reshape(-1, *[1] * (c.dim() - 1)), c, c.detach()) for c in columns)

    def _complete(self, prior: EmbeddedPrior, one: Subject, motion: Moves, lifted: Lifted) -> None:
        """Add Gaussians where the volume has surface that no frame shows and none contradicts."""
        gaussians = one.models[0].gaussians
        self.first_free[one.models[0].id] = gaussians.next_uid
        room = self.config.gaussians_per_object - len(gaussians)
        count = min(room, int(POINT_SHARE * self.config.gaussians_per_object))
        if count < 1 or not one.references:
            return
        k = one.clip_indices[0]
        t = min(one.references, key=lambda f: abs(f - one.home))
        one.conditions[t] = prior.encode(one.references[t].reference)
        points = in_world(surface_points(prior, one.conditions[t], 4 * count), one.references[t])
        points = points.moved(np.linalg.inv(motion.pose[t]))
        if motion.bend is not None:
            points = replace(points, xyz=motion.bend.undone(t, points.xyz))
        keep = np.ones(len(points), bool)
        for f in np.flatnonzero(np.asarray(motion.confidence) >= TRUSTED):
            xyz = points.xyz if motion.bend is None else motion.bend.at(int(f), points.xyz)
            pose = motion.pose[f]
            keep &= unseen_only(xyz @ pose[:3, :3].T + pose[:3, 3], self.clip, k, int(f))
        rows = np.flatnonzero(keep)
        if len(rows) > count:
            rows = np.random.default_rng(self.config.seed).permutation(rows)[:count]
        if len(rows):
            _add(gaussians, selected(points, rows), lifted.frames_of[lifted.rows[k]], self._light(one.home))

    def _light(self, t: int) -> Tensor | float:
        return 1.0 if self.scene.gain is None else self.scene.gain(t).detach()


def draw_views(rng: np.random.Generator, count: int) -> ViewOffsets:
    """Elevation within 30 degrees, azimuth all round, no change of distance."""
    elevation = torch.tensor(rng.uniform(-ELEVATION, ELEVATION, count), dtype=torch.float32)
    azimuth = torch.tensor(rng.uniform(-180, 180, count), dtype=torch.float32)
    return ViewOffsets(elevation, azimuth, torch.zeros(count))


def levels(share: float) -> tuple[float, float]:
    """Lowest and highest noise level: high while shape is open, low once only details are."""
    return 0.25 * (1.0 - share), 1.0 - 0.6 * share


def fade(share: float) -> float:
    """Weight of the prior: whole for two thirds of the run, then falling to LAST_WEIGHT."""
    return 1.0 - (1.0 - LAST_WEIGHT) * min(max(3.0 * share - 2.0, 0.0), 1.0)


def render_factor(share: float) -> int:
    """Render side in units of the prior's side at this share of the run."""
    return next(factor for until, factor in SIZES if share <= until)


def _subject(clip: Clip, lifted: Lifted, group: tuple[int, ...]) -> Subject:
    """References of an object or of all: at most FRAMES frames, the canonical one among them."""
    models = [lifted.scene.objects[lifted.rows[k]] for k in group]
    home = sorted(model.ref_frame for model in models)[len(models) // 2]
    references: dict[int, PlacedReference] = {}
    off: dict[int, str] = {}
    for t in sorted({int(t) for t in np.linspace(0, len(clip) - 1, FRAMES)} | {home}):
        found = reference_of(clip, group, t)
        if isinstance(found, str):
            off[t] = found
        elif found.visible < LEAST_VISIBLE:
            off[t] = f"only {100 * found.visible:.0f} % of the object shows"
        else:
            references[t] = found
    name = models[0].name if len(models) == 1 else "all objects"
    return Subject(models, group, name, home, references, off)


def _object_to_prior(model: ObjectModel, placed: PlacedReference, t: int) -> tuple[float, Tensor, Tensor]:
    """Scale, unit quaternion (4,) and origin (3,) from object space to the prior's, all held fixed."""
    with torch.no_grad():
        size, quat, origin = model.placement.similarity(t)
    inverse = np.linalg.inv(placed.to_world)
    turn = matrix_to_quaternion(inverse[:3, :3] * placed.unit)
    place = inverse[:3, :3] @ origin.double().numpy() + inverse[:3, 3]
    both = safemath.quaternion_multiply(torch.tensor(turn, dtype=torch.float32), quat.detach())
    return float(size) / placed.unit, safemath.normalise(both), torch.tensor(place, dtype=torch.float32)


def _add(gaussians: Gaussians, points: Points, frame: tuple[np.ndarray, float], light: Tensor | float) -> None:
    """Append world points (at the canonical frame) to an object's Gaussians."""
    centre, size = frame
    rotations, sigmas = surface_axes(points.tangents)
    axes = _tensor(matrix_to_quaternion(rotations)), _tensor(sigmas / size)
    rgb = (_tensor(points.rgb) / light).clamp(0, 1)
    fresh = Gaussians.from_surface(_tensor((points.xyz - centre) / size), rgb, axes)
    added = {name: getattr(fresh, name).detach() for name in Gaussians.NAMES}
    gaussians.replace_rows(torch.arange(len(gaussians)), added)


def _tensor(array: np.ndarray) -> Tensor:
    return torch.tensor(np.ascontiguousarray(array), dtype=torch.float32)
