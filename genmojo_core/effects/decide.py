"""From evidence to decisions: which effects a run simulates, each with its number, threshold, reason and cost."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast, get_args

from genmojo_core.clip.clip import Clip
from genmojo_core.config import RunConfig
from genmojo_core.effects.costs import predict, run_sizes
from genmojo_core.effects.evidence import Evidence, measure
from genmojo_core.effects.plan import Effect, EffectName, EffectPlan
from genmojo_core.effects.shape import RIGID_MODE, RIGID_OUTLINE
from genmojo_core.effects.sides import unseen_share
from genmojo_core.effects.texts import Said, sentence
from genmojo_core.effects.upright import RIGID_LEAN, RIGID_STRETCH
from genmojo_core.errors import GenmojoError

NAMES: tuple[str, ...] = get_args(EffectName)
ALL = "all"  # in overrides: every effect that the clip allows
FEWEST_BASES = 4  # motion bases of an object that bends a little; one that bends much gets all of the preset


@dataclass(frozen=True)
class Rule:
    """How one effect is decided: on when `value` reaches `threshold`.

    Args:
        value: the number, in `unit`. origin: where the threshold comes from; reason: sentences about the number, both
        by key (texts.py). lacking: why it cannot be switched on at all; empty if it can. spared: ids of objects that
        do without it.
    """

    value: float
    unit: str
    threshold: float
    origin: Said
    reason: Sequence[Said]
    lacking: str = ""
    spared: tuple[int, ...] = ()


def plan(clip: Clip, config: RunConfig, overrides: Mapping[str, bool] | None = None) -> EffectPlan:
    """Decide all effects for a completed clip.

    Args:
        clip: every channel present (estimate.complete). config: sizes and prior of the run.
        overrides: effects that the user switches on or off whatever the evidence says; ALL stands for every effect
            not named, those that this clip or run cannot do left out.

    Raises:
        GenmojoError("argument"): an override that names no effect or that this clip or run cannot do.
    """
    evidence = measure(clip)
    sizes = run_sizes(clip.size, len(clip), evidence.objects, evidence.background, config)
    overrides = dict(overrides or {})
    _check_names(overrides)
    effects = []
    for name in NAMES:
        rule = _RULES[name](clip, config, evidence)
        ms, mb = predict(name, sizes, config)
        on = rule.value >= rule.threshold and not rule.lacking
        effect = Effect(cast(EffectName, name), on, rule.value, rule.unit, rule.threshold, sentence([rule.origin]),
                        sentence(rule.reason), ms, mb, said=tuple(rule.reason), origin_said=(rule.origin,),
                        spared=rule.spared)  # fmt: skip
        wanted = overrides.get(name, None if rule.lacking else overrides.get(ALL))
        effects.append(_overridden(effect, wanted, rule.lacking))
    effects = [sparing(effect, effect.spared, clip.objects) for effect in effects]
    return EffectPlan(tuple(with_bases(effect, config.motion_bases, effect.evidence) for effect in effects))


def parse_overrides(text: str) -> dict[str, bool]:
    """{"appearance_change": True, "unseen_views": False} for "+appearance_change,-unseen_views"; {} for "auto" or "".

    "all" switches on every effect that the clip allows ({ALL: True}); others may follow: "all,-flow".

    Raises GenmojoError("argument") for a name that is no effect, a missing sign, or + and - for the same effect.
    """
    result: dict[str, bool] = {}
    for item in (part.strip() for part in text.split(",")):
        if item in ("", "auto"):
            continue
        if item == ALL:
            result[ALL] = True
            continue
        if item[0] not in "+-":
            raise GenmojoError(
                "argument", f"'{item}' says neither + nor -", "--effects", f"write +{item} or -{item}, auto or all"
            )
        name, on = item[1:].strip(), item[0] == "+"
        if result.get(name, on) != on:
            raise GenmojoError("argument", f"'{name}' is switched both on and off", "--effects", "choose one")
        result[name] = on
    _check_names(result)
    return result


def _check_names(overrides: Mapping[str, bool]) -> None:
    """Raise GenmojoError("argument") for names that are no effects."""
    unknown = [name for name in overrides if name not in (*NAMES, ALL)]
    if unknown:
        raise GenmojoError("argument", f"there is no effect {', '.join(repr(name) for name in unknown)}", "--effects",
                           f"use {', '.join(NAMES)}")  # fmt: skip


def _overridden(effect: Effect, wanted: bool | None, lacking: str) -> Effect:
    """The effect as the user wants it, then for all objects; what cannot be done cannot be switched on."""
    if wanted is None:
        return effect
    if wanted and lacking:
        raise GenmojoError("argument", f"'{effect.name}' cannot be switched on: {lacking}", "--effects",
                           f"leave out +{effect.name}")  # fmt: skip
    said: tuple[Said, ...] = (("switched_on" if wanted else "switched_off", {}), *effect.said)
    return replace(effect, on=wanted, overridden=True, reason=sentence(said), said=said, spared=())


def sparing(effect: Effect, spared: tuple[int, ...], objects: int) -> Effect:
    """An effect that `spared` of the clip's objects do without, and what it costs for the others."""
    share = 1.0 - len(spared) / max(objects, 1)
    return replace(effect, spared=spared, ms_per_step=share * effect.ms_per_step, mb=share * effect.mb)


def with_bases(effect: Effect, most: int, amount: float) -> Effect:
    """Non-rigid motion with motion bases in proportion to how much the objects bend; none when they do not."""
    if effect.name != "non_rigid_motion":
        return effect
    bases = min(most, max(min(FEWEST_BASES, most), round(FEWEST_BASES * amount))) if effect.on else 0
    return replace(effect, settings={"motion_bases": bases})


# ---- one rule per effect --------------------------------------------------------------------------------------------


def _joint_occlusion(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    percent = 100 * evidence.contact
    said = _covers(clip, evidence) if evidence.covers else [("never_touch", {})]
    return Rule(percent, "% of frames", 100 / max(len(clip), 1) - 1e-6, ("origin_contact", {}), said)


def _covers(clip: Clip, evidence: Evidence) -> list[Said]:
    """The longest cover, and how many there are besides."""
    longest = max(evidence.covers, key=lambda cover: len(cover.frames))
    front, back = (clip.object_names[k] for k in (longest.front, longest.back))
    first, last = int(longest.frames[0]), int(longest.frames[-1])
    values = {"front": front, "back": back, "first": first, "last": last}
    more = len(evidence.covers) - 1
    said: list[Said] = [("covers_once" if first == last else "covers", values)]
    return said + ([("one_more_pair" if more == 1 else "more_pairs", {"count": more})] if more else [])


def _background(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    percent = 100 * evidence.background
    return Rule(percent, "% of pixels", 5.0, ("origin_background", {}), [("background", {"percent": percent})],
                "" if evidence.background > 0 else "every pixel belongs to an object")  # fmt: skip


def _camera_motion(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    key = "camera_moves" if evidence.camera >= 0.5 else "camera_stands"
    values = {"pixels": evidence.camera, "source": _source(clip.cameras)}
    return Rule(evidence.camera, "px at 256", 0.5, ("origin_camera", {}), [(key, values)],
                "" if clip.cameras is not None else "the clip has no cameras")  # fmt: skip


def _non_rigid_motion(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    scores = [one.score for one in evidence.bending]
    worst = max(range(len(scores)), key=scores.__getitem__, default=0)
    value = scores[worst] if scores else 0.0
    name = clip.object_names[worst] if worst < len(clip.object_names) else str(worst + 1)
    reason: list[Said] = [("bends", {"name": name, "times": value}) if value >= 1 else ("rigid", {})]
    spared = [k for k, one in enumerate(evidence.bending) if value >= 1 and one.surely_rigid]
    if spared:
        reason.append(("stay_rigid", {"names": ", ".join(clip.object_names[k] for k in spared)}))
    limits = {"mode": 100 * RIGID_MODE, "outline": 100 * RIGID_OUTLINE, "stretch": 100 * RIGID_STRETCH,
              "lean": RIGID_LEAN}  # fmt: skip
    return Rule(value, "x rigid", 1.0, ("origin_rigid", limits), reason,
                "" if len(clip) > 1 else "a single frame has no motion",
                tuple(int(clip.object_ids[k]) for k in spared))  # fmt: skip


def _appearance_change(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    percent = 100 * evidence.light
    said: Said = ("light_changes", {"percent": percent}) if percent >= 8 else ("light_stays", {})
    return Rule(percent, "% brightness", 8.0, ("origin_light", {}), [said],
                "" if len(clip) > 1 else "a single frame has one light")  # fmt: skip


def _shading(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    degrees = max(evidence.turns, default=0.0)
    said: Said = ("turns", {"degrees": degrees}) if degrees >= 20 else ("turns_little", {})
    return Rule(degrees, "degrees", 20.0, ("origin_turns", {}), [said],
                "" if len(clip) > 1 else "a single frame has one light")  # fmt: skip


def _unseen_views(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    installed = config.prior != "none"
    percent = 100 * max((unseen_share(sight, config.view_range) for sight in evidence.sights), default=0.0)
    drawn: Said = ("prior_draws", {"prior": config.prior}) if installed else ("no_prior", {})
    said: list[Said] = [("unseen", {"degrees": config.view_range, "percent": percent}), drawn]
    return Rule(percent, "% of a view", 10.0, ("origin_unseen", {}), said,
                "" if installed else "no prior is installed")  # fmt: skip


def _instance_labels(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    said: Said = ("objects", {"count": evidence.objects}) if evidence.objects > 1 else ("one_object", {})
    return Rule(float(evidence.objects), "objects", 2.0, ("origin_objects", {}), [said])


def _depth_order(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    percent = 100 * evidence.depth
    said: Said = ("depth", {"percent": percent, "source": _source(clip.depth)})
    return Rule(percent, "% of object pixels", 50.0, ("origin_depth", {}), [said],
                "" if clip.depth is not None else "the clip has no depth")  # fmt: skip


def _flow(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    percent = 100 * evidence.flow
    said: Said = ("flow", {"percent": percent, "source": _source(clip.flow)}) if len(clip) > 1 else ("no_motion", {})
    return Rule(percent, "% of object pixels", 20.0, ("origin_flow", {}), [said],
                "" if clip.flow is not None and len(clip) > 1 else "the clip has no flow")  # fmt: skip


def _track_supervision(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    said: Said = ("corners", {"count": evidence.corners})
    return Rule(evidence.corners, "corners per object", 4.0, ("origin_corners", {}), [said],
                "" if len(clip) > 1 else "a single frame has no tracks")  # fmt: skip


def _reappearance(clip: Clip, config: RunConfig, evidence: Evidence) -> Rule:
    key = "never_hidden" if not evidence.hidden else "hidden_once" if evidence.hidden == 1 else "hidden"
    return Rule(float(evidence.hidden), "frames", 1.0, ("origin_hidden", {}), [(key, {"count": evidence.hidden})])


def _source(channel: object) -> str:
    """ "given" or "estimated", keys of texts.py."""
    return "given" if getattr(channel, "given", False) else "estimated"


_RULES: dict[str, Callable[[Clip, RunConfig, Evidence], Rule]] = {
    "joint_occlusion": _joint_occlusion, "background": _background, "camera_motion": _camera_motion,
    "non_rigid_motion": _non_rigid_motion, "appearance_change": _appearance_change, "shading": _shading,
    "unseen_views": _unseen_views,
    "instance_labels": _instance_labels, "depth_order": _depth_order, "flow": _flow,
    "track_supervision": _track_supervision, "reappearance": _reappearance,
}  # fmt: skip
