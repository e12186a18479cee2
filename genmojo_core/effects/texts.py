"""What the effect plan and a run that changes it say, by key: English here, other languages where the app translates.

A `Said` is a key and its values; values called `source` are keys themselves. `sentence` puts them into words.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

Said = tuple[str, Mapping[str, Any]]
TEXTS: dict[str, str] = {
    "given": "given",
    "estimated": "estimated",
    "switched_on": "Switched on by the user.",
    "switched_off": "Switched off by the user.",
    "covers": "'{front}' covers '{back}' where they touch (frames {first} to {last}).",
    "covers_once": "'{front}' covers '{back}' where they touch (frame {first}).",
    "one_more_pair": "There is 1 more such pair.",
    "more_pairs": "There are {count} more such pairs.",
    "never_touch": "No two objects ever touch.",
    "background": "{percent:.0f} % of all pixels show no object.",
    "camera_moves": "The camera shifts the background by up to {pixels:.1f} px ({source}).",
    "camera_stands": "The camera stands still ({source}).",
    "rigid": "Every object moves like a rigid body as far as flow and outlines show.",
    "bends": "'{name}' bends {times:.1f} times as much as turning rigid objects seem to.",
    "stay_rigid": "Rigid all the same: {names}.",
    "light_changes": "Brightness changes by {percent:.0f} % over the clip.",
    "light_stays": "The light stays the same.",
    "turns": "An object turns by {degrees:.0f} degrees, the light does not.",
    "turns_little": "No object turns much.",
    "unseen": "Looked at from up to {degrees:.0f} degrees aside, {percent:.0f} % of an object was never seen.",
    "prior_draws": "The prior {prior} draws it.",
    "no_prior": "No prior is installed to draw it.",
    "objects": "{count} objects must be kept apart.",
    "one_object": "There is one object only.",
    "depth": "{percent:.0f} % of the objects' pixels have a depth ({source}).",
    "flow": "Flow holds in {percent:.0f} % of the objects' pixels ({source}).",
    "no_motion": "A single frame has no motion.",
    "corners": "Usually {count:.0f} corners of an object can be followed.",
    "never_hidden": "No object is hidden and comes back.",
    "hidden_once": "An object is hidden for 1 frame and comes back.",
    "hidden": "An object is hidden for up to {count} frames and comes back.",
    "leaves_rigid": "'{name}' leaves its rigid motion by {percent:.0f} % of its size: non-rigid motion was called in.",
    "light_called_in": "Frames differ from the scene by up to {percent:.0f} % brightness: changing light was called "
    "in.",
    "light_before": "Changing light was called in before the run was interrupted.",
    "no_shading": "Where surfaces face explains {percent:.0f} % of how their brightness changes: no shading.",
    "left_out_before": "Left out before the run was interrupted.",
    "prior_no_numbers": "What the prior says was no usable number {times} times in a row: it is switched off.",
    "prior_harms": "Held-out pixels have {psnr:.2f} dB with the Gaussians the prior invented and {without:.2f} dB "
    "without: it is switched off.",
    "origin_contact": "one frame of contact is enough to hide",
    "origin_background": "less than a twentieth is left to the objects' edges",
    "origin_camera": "half a pixel cannot be seen",
    "origin_rigid": "rigid objects stay under {mode:.1f} % (fourth mode of flow) and {outline:.0f} % (outline) of "
    "their size, {stretch:.0f} % of height and {lean:.2g} of lean",
    "origin_light": "steady light measures under 5 % on the shared clips",
    "origin_turns": "turned by 20 degrees, a surface gains or loses a third of the light",
    "origin_unseen": "the rim's own Gaussians close less than a tenth",
    "origin_objects": "one object cannot be taken for another",
    "origin_depth": "half of the objects' pixels",
    "origin_flow": "below a fifth wrong vectors outweigh right ones",
    "origin_corners": "four points fix a similarity with one to spare",
    "origin_hidden": "one frame without it must be bridged",
}
UNITS = ("% of frames", "% of pixels", "px at 256", "x rigid", "% brightness", "degrees", "% of a view", "objects",
         "% of object pixels", "corners per object", "frames")  # fmt: skip


def sentence(said: Iterable[Said], translate: Callable[[str], str] = str) -> str:
    """The words of some things said, one after the other; `translate` is given every text of TEXTS that is used."""
    return " ".join(
        translate(TEXTS[key]).format(
            **{name: translate(TEXTS[value]) if name == "source" else value for name, value in values.items()}
        )
        for key, values in said
    )
