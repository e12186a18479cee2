"""The prior's part in a run: which frames and objects it speaks for, first Gaussians of unseen sides, its loss.

Each step one object (or all) is shown to the prior alone, in the prior's space, from views around one of its good
frames (METHOD.md sections 2 and 5). No gradient reaches the placement: the prior knows shapes, not places. Where the
prior gave Gaussians of its own, only those and what grows out of them follow it, in shape and colour, not in motion;
what frames show is theirs alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.clip.clip import Clip
from genmojo_core.config import RunConfig
from genmojo_core.conventions import SH_C0, matrix_to_quaternion
from genmojo_core.effects.texts import Said
from genmojo_core.optimise.first_poses import Moves
from genmojo_core.optimise.lift import Lifted
from genmojo_core.optimise.objective import Objective, Outcome
from genmojo_core.priors.agreement import Seen, disagreement
from genmojo_core.priors.completion import CELL, in_world, surface_points, thinned, unseen_only
from genmojo_core.priors.embedded import EmbeddedPrior, view_cameras
from genmojo_core.priors.prior import ViewOffsets, ViewPrior
from genmojo_core.priors.references import LEAST_VISIBLE, PlacedReference, reference_of
from genmojo_core.priors.sds import Mode, distil
from genmojo_core.priors.solids import HALF_EXTENT
from genmojo_core.priors.zero123 import Zero123Prior
from genmojo_core.render.backend import Splat, splat_frames
from genmojo_core.render.rasterizer import Splats
from genmojo_core.scene import safemath
from genmojo_core.scene.deform import Deformation
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.initialise import Points, surface_axes
from genmojo_core.scene.scene4d import ObjectModel
from genmojo_core.sentences import say

ELEVATION = 30.0  # degrees around the reference's
TRUSTED = 0.3  # confidence of a frame's pose from which it may contradict the prior
FRAMES = 12  # references per object at most, spread over the clip
POINT_SHARE = 0.25  # of the allowed Gaussians, spent on unseen sides at first
LAST_WEIGHT = 0.1  # of the loss, reached at the end of the run's last third
COMPARED = (0.5, 0.75)  # shares of the run at which held-out pixels are compared with and without the prior
WORSE = 0.1  # dB they must be better without it, to switch it off
USELESS = 10  # steps in a row in which most of what the prior said was no number, until it is switched off
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
        self.asked: set[float] = set()  # shares of the run at which the held-out pixels were compared
        self.completed: set[int] = set()  # ids of objects with invented Gaussians
        self.useless, self.told = 0, False
        self._news: list[str] = []
        if isinstance(prior, EmbeddedPrior) and not everything:
            for one in self.subjects:
                self._check_agreement(prior, one, motions[one.clip_indices[0]])
                self._complete(prior, one, motions[one.clip_indices[0]], lifted)

    def notes(self) -> list[str]:
        """What a large prior will need; a sentence per object it does not speak for, or only in some frames."""
        sentences = []
        if isinstance(self.prior, Zero123Prior):
            needed = self.prior.forecast_mb(self.config.prior_views)
            sentences.append(say("prior_memory", name=self.prior.kind, megabytes=needed))
        for one in self.subjects:
            if not one.references:
                reason = "; ".join(dict.fromkeys(one.off.values()))
                sentences.append(say("prior_off", name=one.name, reason=reason))
            elif one.off:
                frames = ", ".join(f"{t} ({reason})" for t, reason in sorted(one.off.items()))
                sentences.append(say("prior_off_in_frames", name=one.name, frames=frames))
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

    def news(self) -> list[str]:
        """What was left out of the prior's words since the last call, a sentence each."""
        told, self._news = self._news, []
        return told

    def objection(self, objective: Objective, share: float) -> Said | None:
        """Why the prior must be switched off: it gives no numbers, or held-out pixels are better without; or None.

        The same scene is drawn with and without the invented Gaussians, at the shares COMPARED of the run, when all
        frames take part. Costs two renderings of every frame.
        """
        if self.useless >= USELESS:
            return "prior_no_numbers", {"times": USELESS}
        due = next((at for at in COMPARED if share >= at and at not in self.asked), None)
        if due is None or not self.completed:
            return None
        self.asked.add(due)
        with_it = held_out_psnr(objective)
        sets = [model.gaussians for model in self.scene.objects]
        kept = [g.logit_opacities.detach().clone() for g in sets]
        with torch.no_grad():
            for g in sets:
                g.logit_opacities[g.invented] = -safemath.LOGIT_LIMIT
            without = held_out_psnr(objective)
            for g, logits in zip(sets, kept, strict=True):
                g.logit_opacities.copy_(logits)
        return None if without < with_it + WORSE else ("prior_harms", {"psnr": with_it, "without": without})

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
        views = draw_views(rng, self.config.prior_views, self.config.view_range)
        self.seen += [(float(e), float(a), t) for e, a in zip(views.elevation, views.azimuth, strict=True)]
        pictures = self._render(one.models, placed, t, views, moment)
        level = float(rng.uniform(*levels(moment.share)))
        said = distil(self.prior, pictures, one.conditions[t], views, level, self.mode(), generator)
        self._take_note(one, said.statistics["left_out"])
        return said.loss * placed.visible * (2.0 / said.gradient.numel())

    def _take_note(self, one: Subject, left_out: float) -> None:
        """Count steps without usable words; the first value left out is news."""
        self.useless = self.useless + 1 if left_out > 0.5 else 0
        if left_out and not self.told:
            self.told = True
            self._news.append(say("prior_no_number", percent=100 * left_out, name=one.name))

    def _render(
        self, models: list[ObjectModel], placed: PlacedReference, t: int, views: ViewOffsets, moment: Moment
    ) -> Tensor:  # (B, 4, S, S)
        """The objects alone from the prior's cameras, premultiplied RGBA."""
        parts = [self._splats(model, placed, t, moment.deform) for model in models]
        splats = Splats(*(torch.cat(columns) for columns in zip(*parts, strict=True)))
        side = self.prior.resolution * render_factor(moment.share)
        distance = self.prior.distance(placed.reference)
        focal = side / 2 * distance / HALF_EXTENT
        poses = view_cameras(placed.reference, views, distance)
        cameras = [View(pose, focal, focal, side / 2, side / 2, side, side) for pose in poses]
        drawn = splat_frames(self.splat, [splats] * len(cameras), cameras)
        return torch.stack([torch.cat([p.features, p.alpha[..., None]], dim=-1).movedim(-1, 0) for p in drawn])

    def _splats(self, model: ObjectModel, placed: PlacedReference, t: int, deform: bool) -> tuple[Tensor, ...]:
        """Means, quats, scales, opacities and colours of one object at frame t in the prior's space."""
        own = model.id in self.completed
        with torch.set_grad_enabled(not own):
            state = model.states([t], deform)[0]
            shade = 1.0 if self.scene.shade is None else self.scene.shade(*model.facing(state)).detach()
        scale, quat, origin = _object_to_prior(model, placed, t)
        local_means, local_quats, log_scales, dc = _bent(model.gaussians, state.deformation)
        means = scale * safemath.rotate(quat, local_means) + origin
        quats = safemath.quaternion_multiply(quat.expand_as(local_quats), safemath.normalise(local_quats))
        rgb = (0.5 + SH_C0 * dc) * self._light(t) * shade
        columns = (means, quats, scale * safemath.exp_scale(log_scales), model.gaussians.opacities(), rgb)
        if not own:
            return columns
        free = model.gaussians.invented
        return tuple(torch.where(free.reshape(-1, *[1] * (c.dim() - 1)), c, c.detach()) for c in columns)

    def _check_agreement(self, prior: EmbeddedPrior, one: Subject, motion: Moves) -> None:
        """Switch the prior off for an object of which it says different things from two frames."""
        trusted = [t for t in one.references if motion.confidence[t] >= TRUSTED and t != one.home]
        if one.home not in one.references or not trusted:
            return
        other = max(trusted, key=lambda t: abs(t - one.home))
        volumes = []
        for t in (one.home, other):
            placed = one.references[t]
            one.conditions[t] = prior.encode(placed.reference)
            volumes.append(Seen(one.conditions[t].volume, placed.reference.elevation, placed.reference.distance))
        first, second = one.references[one.home], one.references[other]
        moved = motion.pose[other] @ np.linalg.inv(motion.pose[one.home])
        to_other = np.linalg.inv(second.to_world) @ moved @ first.to_world
        differ = disagreement(volumes[0], volumes[1], to_other)
        if differ > prior.agreement:
            reason = (f"what it says from frames {one.home} and {other} differs by {100 * differ:.0f} %, more than "
                      f"{100 * prior.agreement:.0f} %")  # fmt: skip
            one.off, one.references = dict.fromkeys(one.references, reason), {}

    def _complete(self, prior: EmbeddedPrior, one: Subject, motion: Moves, lifted: Lifted) -> None:
        """Add Gaussians where the volume has surface that no frame shows and none contradicts."""
        gaussians = one.models[0].gaussians
        room = self.config.gaussians_per_object - len(gaussians)
        count = min(room, int(POINT_SHARE * self.config.gaussians_per_object))
        if count < 1 or not one.references:
            return
        k = one.clip_indices[0]
        t = min(one.references, key=lambda f: abs(f - one.home))
        one.conditions[t] = prior.encode(one.references[t].reference)
        points = in_world(surface_points(prior, one.conditions[t]), one.references[t])
        points = points.moved(np.linalg.inv(motion.pose[t]))
        if motion.bend is not None:
            points = replace(points, xyz=motion.bend.undone(t, points.xyz))
        keep = np.ones(len(points), bool)
        for f in np.flatnonzero(np.asarray(motion.confidence) >= TRUSTED):
            xyz = points.xyz if motion.bend is None else motion.bend.at(int(f), points.xyz)
            pose = motion.pose[f]
            keep &= unseen_only(xyz @ pose[:3, :3].T + pose[:3, 3], self.clip, k, int(f))
        points = thinned(points.chosen(keep), count, CELL * one.references[t].unit)
        if len(points):
            _add(gaussians, points, lifted.frames_of[lifted.rows[k]], self._light(one.home))
            self.completed.add(one.models[0].id)

    def _light(self, t: int) -> Tensor | float:
        return 1.0 if self.scene.gain is None else self.scene.gain(t).detach()


def held_out_psnr(objective: Objective) -> float:
    """PSNR in dB of the scene as it stands on the held-out pixels of all frames; 0 if there are none."""
    error, count = 0.0, 0
    with torch.no_grad():
        for t in range(objective.frames):
            row = objective.evaluate([t], True, torch.Generator().manual_seed(0)).held_out[0]
            error, count = error + row.squared, count + row.count
    return -10.0 * math.log10(max(error / count, 1e-10)) if count else 0.0


def draw_views(rng: np.random.Generator, count: int, view_range: float = 180.0) -> ViewOffsets:
    """Azimuth within `view_range` degrees, elevation too but within 30 at most, no change of distance."""
    rise = min(ELEVATION, view_range)
    elevation = torch.tensor(rng.uniform(-rise, rise, count), dtype=torch.float32)
    azimuth = torch.tensor(rng.uniform(-view_range, view_range, count), dtype=torch.float32)
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


def _bent(gaussians: Gaussians, bent: Deformation | None) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """Means, quaternions (not unit), logarithmic scales and colour coefficients in object space."""
    g = gaussians
    if bent is None:
        return g.means, g.quats, g.log_scales, g.dc
    dc = g.dc if bent.d_dc is None else g.dc + bent.d_dc
    return g.means + bent.d_means, g.quats + bent.d_quats, g.log_scales + bent.d_log_scales, dc


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
    everything = torch.ones(len(points), dtype=torch.bool)
    gaussians.replace_rows(torch.arange(len(gaussians)), added, everything)


def _tensor(array: np.ndarray) -> Tensor:
    return torch.tensor(np.ascontiguousarray(array), dtype=torch.float32)
