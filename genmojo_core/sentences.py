"""What estimates and runs tell a person beside their results, each sentence once.

Events, scene files and JSON hold the English words, made by `say`. Who shows them in another language finds the
sentence again that some words were made from: `translated`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from string import Formatter

SENTENCES: dict[str, str] = {
    # what a clip lacked (`Clip.guesses`)
    "camera_still": "the camera is taken to stand still; its field of view is taken to be {degrees:.3g} degrees high",
    "camera_turning": "the camera's motion is a guess: it is taken to turn on the spot; its field of view is taken to "
    "be {degrees:.3g} degrees high",
    "camera_moving": "the camera's motion is a guess from background points; its field of view is taken to be "
    "{degrees:.3g} degrees high",
    "depth_from": "depth comes from {source}",
    "depth_order_from": "depth comes from {source}; its scale and shift are a guess, so distances are an order, not a "
    "measure",
    "depth_guess": "depth is a guess from {method}; distances between objects are an order, not a measure",
    "depth_method": "ground contact, occlusion order and rounded shapes",
    "depth_steadied": "the depth's scale jumped by up to {percent:.1f} % from frame to frame and was brought to rest",
    "painted": "{share:.1%} of the background is never seen and was painted in from around it",
    "boxes_not_used": "the clip has masks, so the boxes were not used",
    "masks_guess": "masks are a guess from {source}; look at them before trusting the scene",
    "masks_carried": "{count} of {frames} frames have no mask; theirs are a guess carried on by optical flow",
    "frames_lost": "{count} of {frames} frames of {name} cannot be decoded and are left out",
    # what a run is at, and its stages
    "reading": "reading the clip",
    "estimating": "looking at the clip: {stage}, {percent:.0f} %",
    "loading": "loading the optimiser",
    "compiling": "compiling the CPU kernels, once on this machine (about 10 seconds)",
    "lifting": "lifting one frame",
    "optimising": "optimising",
    "writing": "writing the scene",
    "flow": "flow",
    "masks": "masks",
    "cameras": "cameras",
    "depth": "depth",
    "background": "background",
    "first_scene": "first scene",
    "motion": "motion",
    "lift": "lift",
    "joint": "joint",
    # what went wrong in a run, and what was done about it (`Warned`)
    "motion_cut": "there was no time to follow every object exactly; give more budget",
    "motion_not_found": "the motion of {name} could not be followed; it goes where its pixels are",
    "never_visible": "object {name} is never visible and is left out",
    "prior_memory": "the prior {name} is expected to need {megabytes:.0f} MiB",
    "prior_off": "the prior is off for {name}: {reason}",
    "prior_off_in_frames": "the prior is off for {name} in frames {frames}",
    "prior_no_number": "{percent:.2g} % of what the prior said of {name} was no usable number and is left out",
    "made_transparent": "{count} Gaussians of {name} were not finite and were made transparent",
    "step_left_out": "a step was left out: {culprits} not finite",
    "rolled_back": "{count} bad steps in a row: back to the last good state, learning rates x {rate:g}",
    "gradients_left_out": "{count} gradients of {what} of {name} were not finite and were left out",
    "limited": "{count} {what} of {name} were limited to +-{limit:g}",
    "made_unit": "{count} quaternions of {name} were made unit ones",
}


def say(key: str, **values: object) -> str:
    """The English words of a sentence. Raises KeyError for an unknown key or a missing value."""
    return SENTENCES[key].format(**values)


def translated(words: str, translate: Callable[[str], str]) -> str:
    """Words of `say` in the language of `translate`, which is given the sentence; values that are sentences likewise.

    Words that no sentence gives come back as they are.
    """
    for template, pattern in _patterns():
        found = pattern.fullmatch(words)
        if found is not None:
            plain = re.sub(r"\{(\w+)[^}]*\}", r"{\1}", translate(template))  # numbers are in words already
            return plain.format(**{name: translated(value, translate) for name, value in found.groupdict().items()})
    return words


@cache
def _patterns() -> list[tuple[str, re.Pattern[str]]]:
    """Every sentence with an expression that finds its values; those with most words of their own first."""
    made = []
    for template in SENTENCES.values():
        parts = [
            re.escape(words) + (f"(?P<{name}>.+?)" if name else "") for words, name, _, _ in Formatter().parse(template)
        ]
        made.append((template, re.compile("".join(parts), re.DOTALL)))
    return sorted(made, key=lambda one: -len(one[1].pattern))
