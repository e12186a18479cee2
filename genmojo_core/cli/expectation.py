"""What to expect of a run, said before it begins; a run that takes long sends a pilot ahead (effects/pilot.py)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from genmojo_core.cli.output import progress, say
from genmojo_core.config import RunConfig
from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.clip.clip import Clip
    from genmojo_core.effects.forecast import Forecast
    from genmojo_core.effects.plan import EffectPlan


@dataclass(frozen=True)
class Expected:
    """A forecast, and the seconds that a pilot would take where one pays and none has run; None where not."""

    forecast: Forecast
    pilot_seconds: float | None

    def sentence(self) -> str:
        """ "Expected: 310 s (± 60), 30.1 dB (± 0.8, from a pilot run).", for people."""
        from genmojo_core.effects.forecast import said

        return said(self.forecast)


def expectation(clip: Clip, plan: EffectPlan, config: RunConfig) -> Expected | None:
    """Seconds and dB to expect on this machine; the first call on a machine measures it for a few seconds.

    Rests on the clip's pilot where one has run. None for a run on a graphics card, of which no model was fitted.
    """
    import torch

    from genmojo_core.effects import forecast, machine, pilot
    from genmojo_core.optimise import calibrate

    if config.device.startswith("cuda") or (config.device == "auto" and torch.cuda.is_available()):
        return None
    if machine.load() is None:
        say("Measuring how fast this machine is (once) ...")
    known = pilot.stored(clip, plan)
    told = forecast.forecast(clip, plan, config, calibrate.calibrated(), known.to_json() if known else None)
    seconds = pilot.pilot_seconds(clip, [effect.name for effect in plan.effects if effect.on], told.factor)
    return Expected(told, seconds if known is None and pilot.pays(told, seconds) else None)


def foretell(
    clip: Clip, plan: EffectPlan, config: RunConfig, source: str, frames: tuple[int, int | None] | None, pilot: bool
) -> Forecast | None:
    """What to expect, said on stderr; with `pilot` after a pilot run, where one pays and none has run.

    Args:
        source, frames: of the clip, which is read again at the size that results are measured at.
    """
    expected = expectation(clip, plan, config)
    if expected is None:
        return None
    if pilot and expected.pilot_seconds is not None:
        seconds = f"{expected.pilot_seconds:.0f} s"
        say(f"A pilot, the clip run small and short, takes about {seconds}, to foretell dB better.")
        send_pilot(clip, plan, source, frames)
        expected = expectation(clip, plan, config) or expected
    say(expected.sentence())
    return expected.forecast


def send_pilot(clip: Clip, plan: EffectPlan, source: str, frames: tuple[int, int | None] | None) -> None:
    """Run the clip's pilot and keep it for forecasts; where it fails they do without, and stderr says why."""
    from genmojo_core.measure.pilot_run import piloted
    from genmojo_core.measure.reconstruction import as_measured

    try:
        with progress("pilot") as tell:
            piloted(clip, plan, as_measured(clip, source, frames), tell)
    except GenmojoError as fault:
        say(f"There is no pilot: {fault.sentence()}")
