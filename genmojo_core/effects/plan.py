"""The effect plan: which parts of the model a clip calls for, why, and what each costs (ARCHITECTURE.md section 3)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

from genmojo_core.effects.texts import Said, sentence

EffectName = Literal[
    "joint_occlusion", "background", "camera_motion", "non_rigid_motion", "appearance_change", "shading",
    "unseen_views", "instance_labels", "depth_order", "flow", "track_supervision", "reappearance",
]  # fmt: skip


@dataclass(frozen=True)
class Effect:
    """One decision.

    Args:
        name: which effect. on: the decision.
        evidence, unit: the number measured on the clip. threshold: it is on at or above this.
        origin: where the threshold comes from. reason: one plain sentence.
        ms_per_step, mb: predicted cost when on. overridden: the user decided, not the evidence.
        said, origin_said: reason and origin as keys and values (texts.py), for other languages.
        settings: numbers that go with it, e.g. {"motion_bases": 6}.
        spared: ids of objects that it is not simulated for although it is on.
        measured_ms, measured_mb: what it did cost per step and in memory, once a run has measured it.
    """

    name: EffectName
    on: bool
    evidence: float
    unit: str
    threshold: float
    origin: str
    reason: str
    ms_per_step: float = 0.0
    mb: float = 0.0
    overridden: bool = False
    settings: Mapping[str, float] | None = None
    spared: tuple[int, ...] = ()
    measured_ms: float | None = None
    measured_mb: float | None = None
    said: tuple[Said, ...] = ()
    origin_said: tuple[Said, ...] = ()


@dataclass(frozen=True)
class EffectPlan:
    """All decisions for one clip, in the order of `EffectName`."""

    effects: tuple[Effect, ...]

    def on(self, name: EffectName) -> bool:
        """True if the effect is simulated."""
        return self.get(name).on

    def on_object(self, name: EffectName, object_id: int) -> bool:
        """True if the effect is simulated for an object."""
        effect = self.get(name)
        return effect.on and object_id not in effect.spared

    def get(self, name: EffectName) -> Effect:
        """The decision about one effect; KeyError for a name that is none."""
        for effect in self.effects:
            if effect.name == name:
                return effect
        raise KeyError(name)

    def changed(self, name: EffectName, **changes: Any) -> EffectPlan:
        """The plan with fields of one effect replaced; KeyError for a name that is none."""
        changes = {"said": (), **changes} if "reason" in changes else changes
        new = replace(self.get(name), **changes)
        return EffectPlan(tuple(new if effect.name == name else effect for effect in self.effects))

    def decided(self, name: EffectName, on: bool, said: Said) -> EffectPlan:
        """The plan with another decision about one effect, and why; KeyError for a name that is none."""
        return self.changed(name, on=on, reason=sentence([said]), said=(said,))

    def to_json(self) -> list[dict[str, Any]]:
        """Plain data, as `genmojo effects --json` prints it."""
        return [dict(vars(effect)) for effect in self.effects]
