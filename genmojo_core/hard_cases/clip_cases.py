"""Hostile clips, each run to its end: short, empty, hidden, wrong, monotonous (RELIABILITY.md N15 to N20, N24, N31)."""

from __future__ import annotations

import tempfile
from functools import partial
from pathlib import Path

import numpy as np
import torch

from genmojo_core.clip.clip import Clip
from genmojo_core.hard_cases import clips
from genmojo_core.hard_cases.case import Case, hold
from genmojo_core.hard_cases.runs import Outcome, centre, checked, finished, refused, same_scene, started
from genmojo_core.store import scene_hdf5

FILE_PRECISION = 1e-3  # scene files keep what changes from frame to frame in half precision


def told(outcome: Outcome) -> str:
    """What to say of a run whose general properties hold."""
    warned = f", {len(outcome.warnings)} warnings" if outcome.warnings else ""
    return f"finite, {len(outcome.run.scene)} Gaussians, {outcome.psnr:.1f} dB{warned}"


def short(frames: int) -> str:
    """T frames: the run completes, a still has no motion, half of the Gaussians survive."""
    outcome = finished(clips.plain(frames))
    if frames == 1:
        last = outcome.run.progress._last
        hold(last is not None and not set(last.parts) & {"smooth", "rigidity", "flow"}, "a still has a loss in time")
    survived = min(len(model.gaussians) for model in outcome.run.scene.objects)
    hold(survived >= 16, f"only {survived} Gaussians survived")
    return told(outcome)


def monotonous(value: int) -> str:
    """Black or white video: no texture to follow, and still every pixel is explained."""
    outcome = finished(clips.painted(clips.plain(), value))
    hold(outcome.psnr > 30, f"one colour is drawn with {outcome.psnr:.1f} dB")
    return told(outcome)


def standing_still() -> str:
    """Identical frames: nothing moves in the scene either."""
    outcome = finished(clips.frozen(clips.plain()))
    drift = max(float(np.abs(centre(outcome, k, 4) - centre(outcome, k, 0)).max()) for k in range(2))
    hold(drift < 1.0, f"an object moved {drift:.2f} px in a clip without motion")
    return f"{told(outcome)}, moved {drift:.2f} px"


def nothing_to_follow() -> str:
    """Every pixel at random: no flow holds; the scene stays where its masks are."""
    return told(finished(clips.noisy(clips.plain(given=()))))


def specks(shape: str) -> str:
    """Masks of a pixel, a row, a corner, two islands, everything: scale bounded, nothing divides by zero."""
    clip = clips.plain()
    mask = np.zeros(clip.frames.shape[:3], bool)
    places = {"pixel": (slice(10, 11), slice(20, 21)), "row": (slice(10, 11), slice(5, 40)),
              "corner": (slice(0, 1), slice(0, 1)), "everything": (slice(None), slice(None))}  # fmt: skip
    if shape == "islands":
        mask[:, 2:5, 2:5] = mask[:, 26:29, 42:45] = True
    else:
        mask[:, places[shape][0], places[shape][1]] = True
    effects = {"non_rigid_motion": True} if shape == "everything" else None  # no background is left then
    outcome = finished(clips.masked(clip, {0: mask}), effects)
    sizes = outcome.run.scene.objects[0].placement.size.numpy()
    hold(bool((sizes > 1e-6).all() and (sizes < 1e3).all()), f"the object's size is {sizes.max():.3g}")
    hold(float(sizes.max() / sizes.min()) < 1.01, "the object's size jumps")
    return told(outcome)


def gone_and_back() -> str:
    """An object that vanishes for frames and returns: drawn where it was seen before and after."""
    clip = clips.plain(8)
    outcome = finished(clips.without(clip, 0, slice(3, 6)), joint_steps=20)
    misses = [_miss(outcome, clip, t) for t in (1, 6, 7)]
    hold(max(misses) < 6, f"after its return it is drawn {max(misses):.1f} px beside its mask")
    return f"{told(outcome)}, at most {max(misses):.1f} px beside its mask"


def flickering() -> str:
    """An object that is there in every other frame only."""
    clip = clips.plain(8)
    return told(finished(clips.without(clip, 0, slice(1, None, 2))))


def never_seen() -> str:
    """An object without a pixel is left out by name, and changes nothing for the other."""
    clip = clips.plain()
    outcome = finished(clips.without(clip, 0, slice(None)))
    hold(any("never visible" in text for text in outcome.warnings), "nobody was told of the object without a pixel")
    hold(len(outcome.run.scene.objects) == 1, "an object without a pixel became part of the scene")
    return told(outcome)


def nothing_seen() -> str:
    """No object has a pixel: refused in one sentence."""
    clip = clips.plain()
    empty = np.zeros(clip.frames.shape[:3], bool)
    return f"refused: {refused(clips.masked(clip, {0: empty, 1: empty})).code}"


def narrow(width: int, height: int) -> str:
    """Frames of a few pixels: shorter than every window and tile."""
    clip = clips.plain(3, (width, height))
    tall = np.arange(height)[:, None] * np.ones(width)
    wide = np.arange(width) * np.ones((height, 1))
    place = np.repeat((tall if height >= width else wide)[None], 3, axis=0) / max(width, height)
    return told(finished(clips.masked(clip, {0: (place > 0.2) & (place < 0.4), 1: (place > 0.6) & (place < 0.8)})))


def far_off(factor: float) -> str:
    """Depth wrong by a factor while the cameras stay: the pictures are explained all the same."""
    reference = finished(clips.plain(), lift_steps=10)
    outcome = finished(clips.deep(clips.plain(), factor), lift_steps=10)
    hold(outcome.psnr > reference.psnr - 3, f"{outcome.psnr:.1f} dB instead of {reference.psnr:.1f}")
    return f"{told(outcome)} (right depth: {reference.psnr:.1f})"


def unread_depth() -> str:
    """Depth where it does not hold is never read: any filler gives the same scene, bit for bit."""
    clip = clips.plain()
    valid = np.random.default_rng(0).random(clip.frames.shape[:3]) < 0.7
    scenes = [finished(clips.partly_deep(clip, valid, filler)) for filler in (0.0, -1.0, 1e-12, 65504.0)]
    for other in scenes[1:]:
        hold(same_scene(scenes[0], other), "the filler of unknown depth changed the scene")
    return f"{told(scenes[0])}, the same for 4 fillers"


def one_depth() -> str:
    """One pixel of depth per object and frame."""
    clip = clips.plain()
    valid = np.zeros(clip.frames.shape[:3], bool)
    for k in range(2):
        for t in range(len(clip)):
            rows, columns = np.nonzero(clip.object_mask(k)[t])
            valid[t, rows[len(rows) // 2], columns[len(rows) // 2]] = True
    return told(finished(clips.partly_deep(clip, valid, 0.0)))


def no_depth() -> str:
    """A depth file without a value: refused in one sentence."""
    clip = clips.plain()
    return f"refused: {refused(clips.partly_deep(clip, np.zeros(clip.frames.shape[:3], bool), 0.0)).code}"


def spiked_depth() -> str:
    """A measured depth with spikes to a million and down to nothing in 2 % of its pixels."""
    clip = clips.plain()
    rng = np.random.default_rng(0).random(clip.depth.value.shape)
    value = np.where(rng < 0.01, 1e6, np.where(rng > 0.99, 1e-6, clip.depth.value)).astype(np.float32)
    spoiled = clip.with_channels(depth=clips.Channel(value, clip.depth.valid, clip.depth.source))
    return told(finished(spoiled))


def colliding() -> str:
    """Two objects in one place at one time."""
    return told(finished(clips.colliding()))


def behind() -> str:
    """Cameras that look away in half of the frames: what was seen lies behind them."""
    return told(finished(clips.turned_away(clips.plain(6), slice(3, None))))


def far_world() -> str:
    """World coordinates ten thousand units away: as good as at home."""
    reference = finished(clips.plain())
    outcome = finished(clips.moved_world(clips.plain(), (1e4, -1e4, 1e4)))
    hold(abs(outcome.psnr - reference.psnr) < 0.5, f"{outcome.psnr:.1f} dB instead of {reference.psnr:.1f}")
    return f"{outcome.psnr:.1f} dB, at home {reference.psnr:.1f}"


def repeatable() -> str:
    """The same seed twice: the same scene, bit for bit."""
    first, second = (finished(clips.plain()) for _ in range(2))
    hold(same_scene(first, second), "two runs with one seed differ")
    return "two runs with one seed are equal bit for bit"


def half_precision() -> str:
    """A caller's half precision does not reach the run: the same scene, bit for bit."""
    plain = finished(clips.plain(3))
    run = started(clips.plain(3))
    with torch.autocast("cpu", dtype=torch.bfloat16):
        events = list(run)
    inside = checked(run, events)
    kinds = {value.dtype for value in inside.run.scene.parameters()}
    hold(kinds == {torch.float32}, f"parameters are {kinds}")
    hold(same_scene(plain, inside), "half precision changed the scene")
    return "under bfloat16 the same bit for bit"


def written_and_read() -> str:
    """A scene that was made, written and read again has the same Gaussians in every frame."""
    outcome = finished(clips.moved_world(clips.plain(3), (3.0, -2.0, 1.0)))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.h5"
        scene_hdf5.write(outcome.scene, path)
        again = scene_hdf5.read(path)
    for t in range(3):
        a, b = outcome.scene.frame(t), again.frame(t)
        for name in ("means", "quats", "scales", "opacities", "rgb"):
            gap = float(np.abs(getattr(a, name) - getattr(b, name)).max())
            hold(gap < FILE_PRECISION, f"{name} of frame {t} changed by {gap:.2g}")
    return f"{len(outcome.scene.xyz)} Gaussians in 3 frames"


def _miss(outcome: Outcome, clip: Clip, t: int) -> float:
    """Pixels from where object 0 is drawn to the middle of its true mask in frame t."""
    rows, columns = np.nonzero(clip.object_mask(0)[t])
    if not len(rows):
        return 0.0
    return float(np.linalg.norm(centre(outcome, 0, t) - [columns.mean() + 0.5, rows.mean() + 0.5]))


CASES = (
    *(Case("N19", f"{count} frame{'s' * (count > 1)}", partial(short, count)) for count in (1, 2, 3, 8)),
    Case("N18", "one-pixel mask", partial(specks, "pixel")),
    Case("N18", "mask of one row", partial(specks, "row")),
    Case("N18", "mask of a corner pixel", partial(specks, "corner")),
    Case("N18", "mask of two far islands", partial(specks, "islands")),
    Case("N18", "mask over everything", partial(specks, "everything")),
    Case("N18", "object vanishes and returns", gone_and_back),
    Case("N18", "object in every other frame", flickering),
    Case("N20", "object that is never seen", never_seen),
    Case("N20", "no object is ever seen", nothing_seen),
    Case("N20", "cameras that look away", behind),
    Case("N15", "unknown depth is never read", unread_depth),
    Case("N15", "one pixel of depth", one_depth),
    Case("N15", "no depth at all", no_depth),
    Case("N15", "depth with spikes", spiked_depth),
    Case("N28", "depth a million times too far", partial(far_off, 1e6)),
    Case("N28", "depth a million times too near", partial(far_off, 1e-6)),
    Case("N24", "world far from its origin", far_world),
    Case("N17", "colliding objects", colliding),
    Case("N16", "identical frames", standing_still),
    Case("N16", "black video", partial(monotonous, 0)),
    Case("N16", "white video", partial(monotonous, 255)),
    Case("N16", "pixels at random", nothing_to_follow),
    *(Case("N32", f"frames of {w} x {h} pixels", partial(narrow, w, h)) for w, h in ((1, 24), (24, 1), (5, 7))),
    Case("N31", "the same seed twice", repeatable),
    Case("N25", "half precision around a run", half_precision),
    Case("N33", "a scene written and read", written_and_read),
)  # fmt: skip
