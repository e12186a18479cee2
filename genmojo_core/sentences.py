"""What estimates, runs and edits tell a person, each sentence once.

Events, scene files, JSON and the history of a project hold the English words, made by `say`. Who shows them in another
language finds the sentence again that some words were made from: `translated`. Values called `name` are what people
called something and stay as they are; other values may be sentences themselves.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache, lru_cache
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
    # what an edit of tracks is called in the history (`Edit.title`); projects keep these words for ever
    "point_of": "point {number} of {name}",
    "object_number": "object {number}",
    "frame": "frame {first}",
    "frames": "frames {first} to {last}",
    "place": "Place {point}",
    "delete_key": "Delete the key of {point}",
    "visible": "{point} visible, {frames}",
    "occluded": "{point} occluded, {frames}",
    "out_of_view": "{point} out of view, {frames}",
    "not_annotated": "{point} not annotated, {frames}",
    "uncertain": "{point} uncertain, {frames}",
    "certain": "{point} certain, {frames}",
    "accept_point": "Accept {point}",
    "accept_points": "Accept {count} points",
    "reopen_points": "Reopen {count} points",
    "fill_mode": "Fill mode of {point}",
    "solve": "Solve {point}",
    "solve_tracks": "Solve {count} tracks",
    "seed": "Seed {count} tracks",
    "seed_by": "Seed {count} tracks by {name}",
    "merge": "Merge {count} tracks",
    "merge_objects": "Merge {count} objects",
    "merge_mixed": "Merge {tracks} tracks and {objects} objects",
    "import": "Import {count} tracks",
    "set_objects": "Set objects",
    "candidates": "Candidates from the masks",
    "cut_out": "Cut out {name}",
    "correct_mask": "New mask for {name}",
    "choose_object": "Choose {name}",
    "reject_object": "Reject {name}",
    "name_object": "Name {name}",
    "order_objects": "Order of objects",
    "most_objects": "At most {count} objects",
    "most_points": "At most {count} points each",
    "add_point": "Add point {number}",
    "delete_point": "Delete point {number}",
    "change_point": "Change point {number}",
    "name_points": "Name points",
    "swap": "Swap point {one} and point {other}",
    "split": "Split point {number} at frame {frame}",
    "join": "Join point {one} and point {other}",
    "swap_run": "Exchange {one} and {other}, {frames}",
    "split_to": "Split {one}: from {frame} on it is {other}",
    "join_to": "Join {other} to {one}",
    "lock": "Lock",
    "unlock": "Unlock",
    "note": "Note",
    "set_note": "Set {what}",
    "consent": "consent",
    "needs_fix": "Needs fix: {reason}",
    "needs_fix_note": "Needs fix: {reason} ({name})",
    "fixed": "Fixed",
    "approve": "Approve",
    "reject": "Reject",
    "reject_note": "Reject: {name}",
    # why a reviewer returns a track (`annotation.REASONS`)
    "fault_drift": "drift",
    "fault_jump": "jump",
    "fault_swap": "swap",
    "fault_occlusion": "occlusion wrong",
    "fault_part": "wrong part",
    "fault_imprecise": "imprecise",
    # why a place of a track is suspicious (`suspicion.SIGNALS`)
    "doubt_motion": "sudden motion",
    "doubt_links": "neighbouring frames contradict it",
    "doubt_look": "looks different from its keys",
    "doubt_trackers": "trackers disagree",
    "doubt_mask": "contradicts the object's mask",
    "doubt_affine": "moves unlike the other points of the object",
    "doubt_flicker": "state changes back and forth",
    "doubt_confidence": "the tracker is unsure",
    "doubt_keys": "far from any key",
    # why a figure of the work on a clip is not known (`store/work_figures.py`)
    "figure_no_track": "no track yet",
    "figure_empty": "nothing is annotated yet",
    "figure_no_review": "nothing was reviewed yet",
    "figure_no_times": "times were taken out of this copy",
    "figure_pace": "needs {count} accepted places and {seconds} s of work",
    # what stood before and after an edit, in the audit log (`store/edit_words.py`)
    "log_visible": "visible ×{count}",
    "log_occluded": "occluded ×{count}",
    "log_out_of_view": "out of view ×{count}",
    "log_none": "not annotated ×{count}",
    "log_keys": "keys: {count}",
    "log_accepted": "accepted: {count}",
    "log_uncertain": "uncertain: {count}",
    "log_by_tracker": "filled by the tracker",
    "log_by_line": "filled by a line",
    "log_by_hold": "held until the next key",
    "log_place": "x {x:.1f} y {y:.1f}",
    "log_moved": "moved by {pixels:.1f} px",
    "log_moved_most": "moved by up to {pixels:.1f} px",
    "log_made": "made",
    "log_gone": "deleted",
    "log_name": "called “{name}”",
    "log_note": "note “{name}”",
    "log_review_note": "the reviewer says “{name}”",
    "log_person": "annotator “{name}”",
    "log_reviewer": "reviewer “{name}”",
    "log_meta": "{what} “{name}”",
    "log_locked": "locked",
    "log_unlocked": "not locked",
    "log_order": "place {count} in the order",
    "log_number": "point number {count}",
    "log_mask": "mask drawn: no. {count}",
    "log_rounds": "times returned: {count}",
    "log_draft": "draft",
    "log_in_progress": "in progress",
    "log_needs_fix": "needs a fix",
    "log_fixed": "fixed",
    "log_approved": "approved",
    "log_rejected": "rejected",
    "log_candidate": "candidate",
    "log_chosen": "chosen",
}

PARTS = ("point_of", "object_number", "frame", "frames")  # values of other sentences, which go before them


def say(key: str, **values: object) -> str:
    """The English words of a sentence. Raises KeyError for an unknown key or a missing value."""
    return SENTENCES[key].format(**values)


def translated(words: str, translate: Callable[[str], str], point: str = ".", more: tuple[str, ...] = ()) -> str:
    """Words of `say` in the language of `translate`, which is given the sentence; values that are sentences likewise.

    Words that no sentence gives come back as they are. `point` is that language's decimal point; `more` are sentences
    with fields beside those of SENTENCES.
    """
    template, values = origin(words, more)
    if not template:
        return words
    numbers = _numbers(template)

    def shown(name: str, value: str) -> str:
        if name == "name":
            return value
        return value.replace(".", point) if name in numbers else translated(value, translate, point)

    plain = re.sub(r"\{(\w+)[^}]*\}", r"{\1}", translate(template))  # numbers are in words already
    return plain.format(**{name: shown(name, value) for name, value in values.items()})


@lru_cache(maxsize=4096)
def origin(words: str, more: tuple[str, ...] = ()) -> tuple[str, dict[str, str]]:
    """The sentence that some words were made from, and its values in words; "" if there is none."""
    for template, pattern in _patterns(more):
        found = pattern.fullmatch(words)
        if found is not None:
            return template, found.groupdict()
    return "", {}


@cache
def _patterns(more: tuple[str, ...]) -> list[tuple[str, re.Pattern[str]]]:
    """Every sentence with an expression that finds its values; those with most words of their own first."""
    made = []
    parts_of_others = [SENTENCES[key] for key in PARTS]
    for template in (*SENTENCES.values(), *more):
        parts = list(Formatter().parse(template))
        pattern = "".join(re.escape(own) + (f"(?P<{name}>.+?)" if name else "") for own, name, _, _ in parts)
        own_words = 0 if template in parts_of_others else sum(len(own) for own, *_ in parts)
        made.append((own_words, template, re.compile(pattern, re.DOTALL)))
    return [(template, pattern) for _, template, pattern in sorted(made, key=lambda one: -one[0])]


@cache
def _numbers(template: str) -> set[str]:
    """Names of the values that are numbers with decimals."""
    return {name for _, name, spec, _ in Formatter().parse(template) if name and spec and spec[-1] in "efg%"}
