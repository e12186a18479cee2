"""Runs the pilot of a clip (effects/pilot.py) and measures what its result and the clip's own pixels tell."""

from __future__ import annotations

import json
import math
from collections.abc import Callable

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.cut import picked
from genmojo_core.config import MEASURED_SIDE
from genmojo_core.conventions import DILATION
from genmojo_core.effects import pilot
from genmojo_core.effects.forecast import PILOT_SIDE
from genmojo_core.effects.pilot import Pilot
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.effects.sample import sample
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.events import Failed, Step
from genmojo_core.measure.images import psnr
from genmojo_core.measure.reconstruction import foreground_of, reconstruction
from genmojo_core.optimise.run import Run
from genmojo_core.store.atomic import write_bytes

# Pixels of a blur: the smallest splat and the pixel that it is averaged over, narrower because an edge is made of many.
# With 0.6 the pilots of ten clips told 41 runs best, each clip left out (0.90 dB; 0.99 with 0.8, above 1 with 1).
PIXEL_SIGMA = 0.6 * math.sqrt(DILATION + 1 / 12)


def piloted(clip: Clip, plan: EffectPlan, measured: Clip, progress: Callable[[float], None]) -> Pilot:
    """The stored pilot of a completed clip under a plan, else a new one, which is stored.

    Args:
        measured: the same clip as a run's result is compared with it (`as_measured`). progress: takes a share 0..1.
    Raises GenmojoError: "empty" where its frames show no object, "numeric" where the run fails.
    """
    known = pilot.stored(clip, plan)
    if known is not None:
        return known
    run = Run(small(clip), pilot.pilot_plan(plan), pilot.pilot_config(clip.objects))
    for event in run:
        if isinstance(event, Failed):
            raise GenmojoError("numeric", event.message.rstrip("."), clip.path)
        if isinstance(event, Step):
            progress(event.progress)
    reached = reconstruction(run.bake(), measured)["psnr"]
    found = Pilot(reached, blurred_psnr(measured, PILOT_SIDE), blurred_psnr(measured, MEASURED_SIDE))
    if not math.isfinite(found.reached + found.coarse):
        raise GenmojoError("empty", "shows no object", clip.path)
    keep(clip, plan, found)
    return found


def keep(clip: Clip, plan: EffectPlan, found: Pilot) -> bool:
    """Store a pilot for later forecasts; False where the user's cache folder cannot be written, which is no fault."""
    try:
        write_bytes(pilot.pilot_file(clip, plan), json.dumps(found.to_json()).encode())
    except GenmojoError:
        return False
    return True


def small(clip: Clip) -> Clip:
    """The pilot's frames at its size, completed anew: a plate has another size, flow may skip frames."""
    places = np.unique(np.linspace(0, len(clip) - 1, min(pilot.FRAMES, len(clip))).round().astype(int))
    few = sample(picked(clip, places.tolist()), PILOT_SIDE)
    return complete(few.with_channels(background=None, background_depth=None, background_frame=0))


def blurred_psnr(clip: Clip, short_side: int) -> float:
    """Foreground PSNR in dB of the clip's own frames blurred as if they had `short_side` pixels on the short side.

    Every third frame; NaN where none of them shows an object.
    """
    sigma = PIXEL_SIGMA * min(clip.size) / short_side
    found = []
    for t in range(0, len(clip), 3):
        inside = foreground_of(clip, t)
        if inside.any():
            image = clip.frames[t].astype(np.float32) / 255.0
            found.append(psnr(cv2.GaussianBlur(image, (0, 0), sigma), image, inside))
    return float(np.mean(found)) if found else math.nan
