"""Masks for clips that have none: cut out inside a box or along scribbles (GrabCut), carried on by optical flow.

From the frame of its prompt an object is followed both ways. Each step moves the mask by dense flow and by the object's
own affine motion, then cuts again in a narrow band, with colours learnt where the user pointed. An object whose mask
shrinks away or changes colour is taken for hidden; it is looked for by its picture until it comes back.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.cutout import Look, cut, cut_in_box, learn_look, resembles
from genmojo_core.estimate.flow import FlowOnDemand, SequenceFlow, warp
from genmojo_core.estimate.models import MaskModel
from genmojo_core.estimate.order import object_motion

METHOD = "GrabCut from the box or scribble, carried on by optical flow"
_SMALLEST_SHARE = 0.25  # of its usual area: under this an object counts as hidden
_LARGEST_STEP = 1.5  # a cut that grows the mask by more than this in one frame is not believed
_MOST_COMPARED = 20_000  # pixels
_CLEARLY_BETTER = 0.75  # share of the misfit under which a jump is believed against flow
_FOUND_AGAIN = 0.65  # normalised correlation with the object's picture


@dataclass(frozen=True)
class Box:
    """A rectangle round one object, in raster pixels of the source: [x0, x1) x [y0, y1) of clip frame `frame`."""

    frame: int
    x0: float
    y0: float
    x1: float
    y1: float
    label: int = 1


@dataclass(frozen=True)
class Scribble:
    """Points (N, 2) drawn over an object (foreground) or beside it, in raster pixels of the source."""

    frame: int
    points: np.ndarray
    foreground: bool = True
    label: int = 1


Prompt = Box | Scribble


@dataclass(frozen=True)
class Drawing:
    """Prompts of one object in one frame: box (4,) x0, y0, x1, y1 or None, pixels (H, W) bool on it and beside it."""

    box: np.ndarray | None
    inside: np.ndarray
    outside: np.ndarray


@dataclass(frozen=True)
class Helpers:
    """What following an object may use: flow of the frames, a mask model or None, a hearer of progress 0..1."""

    flows: SequenceFlow | FlowOnDemand
    model: MaskModel | None = None
    progress: Callable[[float], None] | None = None


def masks_from_prompts(
    frames: np.ndarray,  # (T, H, W, 3) uint8
    prompts: Sequence[Prompt],
    source_size: tuple[int, int],  # (width, height) the prompts refer to
    helpers: Helpers | None = None,
) -> np.ndarray:  # (T, H, W) uint8
    """Labels of every frame; an object is 0 pixels large where it is hidden.

    Raises GenmojoError("argument") for a prompt outside the clip or the frame, or without area.
    """
    helpers = helpers or Helpers(FlowOnDemand(frames))
    seeds = seed_masks(frames, prompts, source_size, helpers.model)
    labels = sorted({label for _, label in seeds})
    scores = np.zeros((len(labels), *frames.shape[:3]), np.float16)
    for n, label in enumerate(labels):
        own = {frame: mask for (frame, of), mask in seeds.items() if of == label}
        scores[n] = follow(frames, own, helpers)
        if helpers.progress:
            helpers.progress((n + 1) / len(labels))
    best = scores.argmax(axis=0)
    return np.where(scores.max(axis=0) >= 0.5, np.array(labels, np.uint8)[best], 0).astype(np.uint8)


def seed_masks(
    frames: np.ndarray, prompts: Sequence[Prompt], source_size: tuple[int, int], model: MaskModel | None = None
) -> dict[tuple[int, int], np.ndarray]:
    """The mask (H, W) bool of each prompted (frame, label); prompts of one frame and label are cut together."""
    seeds = {}
    for (frame, label), drawing in drawings(frames, prompts, source_size).items():
        if model is not None and drawing.box is not None:
            found = model.segment(frames[frame], drawing.box)
            if found.any():
                seeds[frame, label] = found
                continue
        seeds[frame, label] = cut_in_box(frames[frame], drawing.box, drawing.inside, drawing.outside)
    return seeds


def drawings(
    frames: np.ndarray, prompts: Sequence[Prompt], source_size: tuple[int, int]
) -> dict[tuple[int, int], Drawing]:
    """What was drawn for each (frame, label), at the frames' size.

    Raises GenmojoError("argument") for a prompt outside the clip or the frame, or without area.
    """
    h, w = frames.shape[1:3]
    scale = np.array([w / source_size[0], h / source_size[1]])
    groups: dict[tuple[int, int], list[Prompt]] = {}
    for prompt in prompts:
        _check(prompt, len(frames), source_size)
        groups.setdefault((prompt.frame, prompt.label), []).append(prompt)
    found = {}
    for key, group in groups.items():
        strokes = {True: np.zeros((h, w), bool), False: np.zeros((h, w), bool)}
        box = None
        for prompt in group:
            if isinstance(prompt, Box):
                corners = np.array([[prompt.x0, prompt.y0], [prompt.x1, prompt.y1]]) * scale
                box = np.concatenate([np.floor(corners[0]), np.ceil(corners[1])])
            else:
                strokes[prompt.foreground] |= _stroke(np.asarray(prompt.points) * scale, (h, w))
        found[key] = Drawing(box, strokes[True], strokes[False])
    return found


def follow(frames: np.ndarray, seeds: dict[int, np.ndarray], helpers: Helpers) -> np.ndarray:
    """One object followed from its seed frames (frame -> (H, W) bool, none empty), both ways, up to the next seed.

    Returns (T, H, W) float16, near 1 where it is, 0 elsewhere; between two seeds the nearer one weighs more.
    """
    total, weight = np.zeros(frames.shape[:3], np.float32), np.zeros(len(frames), np.float32)
    for start, mask in seeds.items():
        total[start] += mask
        weight[start] += 1.0
        for step in (1, -1):
            for f, current in carried(frames, start, mask, step, helpers):
                if f in seeds:
                    break
                share = 1.0 / (1.0 + abs(f - start))
                total[f] += share * current
                weight[f] += share
    return (total / np.maximum(weight, 1e-6)[:, None, None]).astype(np.float16)


def carried(
    frames: np.ndarray, start: int, mask: np.ndarray, step: int, helpers: Helpers
) -> Iterator[tuple[int, np.ndarray]]:
    """An object's mask (H, W) bool, not empty, of frame `start` in the frames after it (step 1) or before it (-1).

    Yields frame and mask (H, W) bool, empty where the object is hidden, up to the end of the clip.
    """
    look = learn_look(frames[start], mask)
    current, usual, last = mask, float(mask.sum()), mask
    f = start + step
    while 0 <= f < len(frames):
        flows = helpers.flows.between(f, f - step), helpers.flows.between(f - step, f)
        prior = _prior(frames[f - step], frames[f], current, flows)
        current = _carry_on(frames[f], current, last, prior, look, usual)
        current = _refined(frames[f], current, helpers.model)
        if current.any():
            last, usual = current, 0.95 * usual + 0.05 * float(current.sum())
        yield f, current
        f += step


def _refined(frame: np.ndarray, mask: np.ndarray, model: MaskModel | None) -> np.ndarray:  # (H, W) bool
    """The mask as a model cuts it inside its box, if the two agree by half (intersection over union)."""
    if model is None or not mask.any():
        return mask
    x, y, w, h = cv2.boundingRect(mask.astype(np.uint8))
    found = model.segment(frame, np.array([x, y, x + w, y + h], float))
    return found if (found & mask).sum() > 0.5 * (found | mask).sum() else mask


def _carry_on(
    frame: np.ndarray, mask: np.ndarray, last: np.ndarray, prior: np.ndarray, look: Look, usual: float
) -> np.ndarray:  # (H, W) bool
    """The mask one frame on; empty while the object is hidden.

    Args:
        frame: the frame to cut. mask: in the frame before; empty if hidden there. last: the last mask that was not.
        prior: (H, W) 0..1, where it is expected. look: colours and picture of it. usual: its usual area in pixels.
    """
    if not mask.any():
        return _find_again(frame, last, look)
    found = cut(frame, prior, look)
    area = float(found.sum())
    if area > _LARGEST_STEP * max(float(mask.sum()), 0.5 * usual):
        found = prior > 0.5
        area = float(found.sum())
    if area < _SMALLEST_SHARE * usual or not resembles(frame, found, look):
        return np.zeros_like(mask)
    return found


def _prior(before: np.ndarray, now: np.ndarray, mask: np.ndarray, flows: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Where a mask (H, W) bool of the frame before is expected now: (H, W) float32 0..1.

    Flow and the object's affine motion speak alike; when its picture fits far better at another place nearby, the
    object moved faster than flow can follow and that place counts alone. `flows` go from now to before, and
    from before to now.
    """
    if not mask.any():
        return mask.astype(np.float32)
    motion, jump = object_motion(mask, flows[1]), np.zeros((2, 3))
    jump[:, 2] = _best_shift(before, now, mask)
    by_motion = _misfit(before, now, mask, motion)
    if _misfit(before, now, mask, jump) < _CLEARLY_BETTER * by_motion - 1.0:
        return _moved(mask, jump)
    return 0.5 * warp(mask.astype(np.float32), flows[0]) + 0.5 * _moved(mask, motion)


def _best_shift(before: np.ndarray, now: np.ndarray, mask: np.ndarray) -> np.ndarray:  # (2,) pixels
    """Whole-pixel shift within one object size at which the object's picture fits best (masked squared difference)."""
    x, y, w, h = cv2.boundingRect(mask.astype(np.uint8))
    reach = int(np.clip(max(w, h), 4, min(mask.shape) // 4 + 1))
    stride = max(1, min(w, h) // 24)
    wide = cv2.copyMakeBorder(now, reach, reach, reach, reach, cv2.BORDER_REPLICATE)
    area = np.ascontiguousarray(wide[y : y + h + 2 * reach : stride, x : x + w + 2 * reach : stride])
    picture = np.ascontiguousarray(before[y : y + h : stride, x : x + w : stride])
    weight = np.ascontiguousarray(mask[y : y + h : stride, x : x + w : stride]).astype(np.uint8)
    if not weight.any():
        return np.zeros(2)
    score = cv2.matchTemplate(area, picture, cv2.TM_SQDIFF, None, cv2.merge([weight] * 3))
    _, _, place, _ = cv2.minMaxLoc(np.where(np.isfinite(score), score, np.inf))
    return np.array(place, float) * stride - reach


def _misfit(before: np.ndarray, now: np.ndarray, mask: np.ndarray, motion: np.ndarray) -> float:
    """Mean difference in grey levels, clipped at 60, between the object and the place it would have moved to.

    Of a large object evenly spread pixels are looked at: remap takes fewer than 32,767 in a row.
    """
    y, x = np.nonzero(mask)
    spread = slice(None, None, 1 + len(x) // _MOST_COMPARED)
    y, x = y[spread], x[spread]
    target = (np.stack([x, y]) + motion @ np.stack([x, y, np.ones(len(x))])).astype(np.float32)
    there = cv2.remap(now, target[0][None], target[1][None], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)[0]
    return float(np.minimum(np.abs(there.astype(np.float32) - before[y, x]), 60).mean())


def _moved(mask: np.ndarray, motion: np.ndarray) -> np.ndarray:  # (H, W) bool, (2, 3) -> (H, W) float32
    """The mask moved by an affine displacement of pixel indices."""
    h, w = mask.shape
    return cv2.warpAffine(mask.astype(np.float32), motion + np.eye(2, 3), (w, h))


def _find_again(frame: np.ndarray, last: np.ndarray, look: Look) -> np.ndarray:  # (H, W) bool
    """The object where its picture fits again, or an empty mask.

    It is sought within two of its sizes of where it was last seen.
    """
    empty = np.zeros_like(last)
    h, w = last.shape
    th, tw = look.picture.shape[:2]
    x, y, bw, bh = cv2.boundingRect(last.astype(np.uint8))
    left, top = max(0, x - 2 * max(bw, tw)), max(0, y - 2 * max(bh, th))
    area = frame[top : min(h, y + bh + 2 * max(bh, th)), left : min(w, x + bw + 2 * max(bw, tw))]
    if area.shape[0] < th or area.shape[1] < tw:
        return empty
    template_mask = look.picture_mask.astype(np.float32)
    score = cv2.matchTemplate(area.astype(np.float32), look.picture.astype(np.float32), cv2.TM_CCORR_NORMED, None,
                              cv2.merge([template_mask] * 3))  # fmt: skip
    score = np.where(np.isfinite(score), score, 0)
    _, _, _, place = cv2.minMaxLoc(score)
    put = empty.copy()
    put[top + place[1] : top + place[1] + th, left + place[0] : left + place[0] + tw] = look.picture_mask
    if _likeness(frame, put, look) < _FOUND_AGAIN:
        return empty
    found = cut(frame, put.astype(np.float32), look)
    return found if found.sum() > 0.5 * put.sum() and resembles(frame, found, look) else empty


def _likeness(frame: np.ndarray, put: np.ndarray, look: Look) -> float:
    """Correlation -1..1 of the picture with the frame under it, brightness and contrast set aside."""
    here = frame[put].astype(np.float64).reshape(-1)
    there = look.picture[look.picture_mask].astype(np.float64).reshape(-1)
    here, there = here - here.mean(), there - there.mean()
    return float(here @ there / max(np.linalg.norm(here) * np.linalg.norm(there), 1e-6))


def _stroke(points: np.ndarray, shape: tuple[int, int]) -> np.ndarray:  # (N, 2), (H, W) -> (H, W) bool
    """Pixels under a polyline two pixels wide; one point is one dot."""
    canvas = np.zeros(shape, np.uint8)
    polyline = np.floor(points).astype(np.int32).reshape(-1, 1, 2)
    cv2.polylines(canvas, [polyline], False, 1, 2)
    for x, y in polyline[:, 0]:
        cv2.circle(canvas, (int(x), int(y)), 1, 1, -1)
    return canvas > 0


def _check(prompt: Prompt, frames: int, size: tuple[int, int]) -> None:
    """Raise GenmojoError("argument") for a prompt that cannot be meant."""
    kind = "box" if isinstance(prompt, Box) else "scribble"
    if not 0 <= prompt.frame < frames:
        raise GenmojoError("argument", f"the {kind} is for frame {prompt.frame} of {frames}", "--box", "count from 0")
    if not 1 <= prompt.label <= 254:
        raise GenmojoError("argument", f"the {kind}'s label is {prompt.label}", "--box", "use 1 to 254")
    if isinstance(prompt, Box):
        numbers = np.array([prompt.x0, prompt.y0, prompt.x1, prompt.y1], dtype=float)
        inside = prompt.x0 < size[0] and prompt.y0 < size[1] and prompt.x1 > 0 and prompt.y1 > 0
        if not np.isfinite(numbers).all() or prompt.x1 - prompt.x0 < 1 or prompt.y1 - prompt.y0 < 1 or not inside:
            raise GenmojoError("argument", f"the box {numbers.tolist()} has no area inside the {size[0]} x {size[1]} "
                               "frame", "--box", "give x0, y0, x1, y1 in pixels of the source")  # fmt: skip
    elif np.asarray(prompt.points).size == 0 or not np.isfinite(prompt.points).all():
        raise GenmojoError("argument", "the scribble has no points", "--box", "draw at least one")
