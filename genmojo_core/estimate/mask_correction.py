"""A mask that a person corrects: strokes and boxes change it in their frames, and the change is carried on from there.

What was added and what was taken away are followed as objects of their own, as `masks.carried` does, until the mask
agrees with the correction by itself. What nobody pointed at stays as it is.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import cv2
import numpy as np

from genmojo_core.estimate.cutout import cut_in_box, cut_part
from genmojo_core.estimate.flow import FlowOnDemand
from genmojo_core.estimate.masks import Drawing, Helpers, Prompt, carried, drawings

_SPECK = 12  # pixels: a smaller change is too small to be followed
_ADDED, _TAKEN = 0.3, 0.5  # shares of an addition, a removal, that the mask makes by itself: it is not carried further
_SURE = 0.1  # of an object's size: how far inside its outline a mask is taken for granted when a box is drawn round it


def correct_masks(
    frames: np.ndarray,  # (T, H, W, 3) uint8
    mask: np.ndarray,  # (T, H, W) bool
    prompts: Sequence[Prompt],
    source_size: tuple[int, int],  # (width, height) the prompts refer to
    drawn: Collection[int] = (),
    helpers: Helpers | None = None,
) -> np.ndarray:  # (T, H, W) bool
    """The mask of one object with what was drawn put right.

    Strokes beside the object (`foreground` False) take their surroundings out of the mask, strokes on it add theirs; a
    box says that all of the object lies in it. `drawn` are frames in which a person drew before: they change by
    prompts of their own only, and no change goes past them.

    Raises GenmojoError("argument") for a prompt outside the clip or the frame, or without area.
    """
    marks = {frame: drawing for (frame, _), drawing in drawings(frames, prompts, source_size).items()}
    helpers = helpers or Helpers(FlowOnDemand(frames))
    result = mask.copy()
    for done, (frame, drawing) in enumerate(sorted(marks.items()), 1):
        now = corrected(frames[frame], mask[frame], drawing)
        result[frame] = now
        for step in (1, -1):
            end = _end(frame, step, set(drawn) - set(marks), set(marks), len(frames))
            for change, adds in ((mask[frame] & ~now, False), (now & ~mask[frame], True)):
                if change.sum() >= _SPECK:
                    _carry(frames, (mask, result), (frame, end, step), (change, adds), helpers)
        if helpers.progress:
            helpers.progress(done / len(marks))
    return result


def corrected(frame: np.ndarray, mask: np.ndarray, drawing: Drawing) -> np.ndarray:  # (H, W, 3), (H, W) -> (H, W) bool
    """A mask of one frame with what was drawn in it put right."""
    found = mask.copy()
    if drawing.box is not None:
        found = _in_box(frame, mask, drawing)
    if drawing.outside.any():
        found &= ~cut_part(frame, drawing.outside, drawing.inside, found)
    if drawing.inside.any():
        found |= cut_part(frame, drawing.inside, drawing.outside | found, ~found & _around(drawing.inside))
    return (found | drawing.inside) & ~drawing.outside


def _in_box(frame: np.ndarray, mask: np.ndarray, drawing: Drawing) -> np.ndarray:  # (H, W) bool
    """All of the object lies in the box; the middle of what the mask has there is taken for granted."""
    box = np.zeros(mask.shape, np.uint8)
    if drawing.box is not None:
        x0, y0, x1, y1 = np.maximum(drawing.box, 0).astype(int)
        box[y0:y1, x0:x1] = 1
    known = (mask & (box > 0)).astype(np.uint8)
    reach = max(1, round(_SURE * float(np.sqrt(known.sum()))))
    sure = cv2.erode(known, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))) > 0
    found = cut_in_box(frame, drawing.box, drawing.inside | sure, drawing.outside)
    touched = drawing.inside | (known > 0)
    if not touched.any():
        return found
    _, parts = cv2.connectedComponents(found.astype(np.uint8))
    return np.isin(parts, np.unique(parts[touched & found])) & found  # not what merely looks alike elsewhere in the box


def _around(stroke: np.ndarray) -> np.ndarray:  # (H, W) bool
    """The surroundings of strokes in which what belongs to them is looked for."""
    x, y, w, h = cv2.boundingRect(stroke.astype(np.uint8))
    reach = max(w, h, min(stroke.shape) // 8)
    found = np.zeros_like(stroke)
    found[max(0, y - reach) : y + h + reach, max(0, x - reach) : x + w + reach] = True
    return found


def _end(frame: int, step: int, drawn: set[int], marks: set[int], count: int) -> int:
    """The first frame, going by `step`, that a change of `frame` does not reach.

    It ends at frames drawn before, and halfway to another one that is corrected now.
    """
    ends = [count if step > 0 else -1]
    ends += [other for other in drawn if (other - frame) * step > 0]
    ends += [frame + step * ((abs(other - frame) + 1) // 2) for other in marks if (other - frame) * step > 0]
    return min(ends, key=lambda end: abs(end - frame))


def _carry(
    frames: np.ndarray,
    masks: tuple[np.ndarray, np.ndarray],  # (T, H, W) bool, before and as corrected so far
    way: tuple[int, int, int],  # frame, frame that is not reached, 1 or -1
    change: tuple[np.ndarray, bool],  # (H, W) bool, whether it is added
    helpers: Helpers,
) -> None:
    """Make a change of one frame in the frames that follow, as long as the mask does not agree with it already."""
    before, result = masks
    start, end, step = way
    part, adds = change
    for f, found in carried(frames, start, part, step, helpers):
        if f == end:
            break
        agreed = float((before[f] == adds)[found].sum())
        if found.any() and agreed > (_ADDED if adds else _TAKEN) * float(found.sum()):
            break
        result[f] = result[f] | found if adds else result[f] & ~found
