"""Procedural clips in which chosen effects are present, at random strength: what effect plans are judged on.

Two thirds of the strengths are plain, the rest lie around what could just be noticed. What a clip really shows is
measured on its exact scene afterwards (measure/effect_truth.py), not taken from the wish.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from genmojo_core.clip.shapes import Kind, Shape, Vector
from genmojo_core.clip.synthetic_specs import SyntheticSpec

WISHES = ("joint_occlusion", "camera_motion", "non_rigid_motion", "appearance_change", "reappearance")
COMBINATIONS: tuple[tuple[bool, ...], ...] = tuple(product((False, True), repeat=len(WISHES)))
FRAMES, SIZE = 12, (240, 180)
_FOCAL = SyntheticSpec("", ()).focal
_LANES = (-1.2, 0.2, 1.6)  # y of the objects' lanes, front to back
_KINDS: tuple[Kind, ...] = ("ball", "cube", "cylinder")
_FAINT = 0.33  # share of strengths around the noticeable


@dataclass(frozen=True)
class MadeClip:
    """A clip to make: its spec, the effects wished for, and how far around the user wants to look (degrees)."""

    spec: SyntheticSpec
    wished: dict[str, bool]
    view_range: float


def made_clip(seed: int) -> MadeClip:
    """The clip of a seed; seeds run through all combinations of `WISHES` in turn."""
    wished = dict(zip(WISHES, COMBINATIONS[seed % len(COMBINATIONS)], strict=True))
    rng = np.random.default_rng((seed, 4021))
    fewest = 1 + wished["joint_occlusion"] + (wished["joint_occlusion"] and wished["reappearance"])
    count = int(rng.integers(fewest, 4))
    tracks = _crossing(rng, count) if wished["joint_occlusion"] else _apart(rng, count)
    if wished["reappearance"]:
        tracks = _leaving(rng, tracks)
    shapes = [_solid(rng, k, *tracks[k]) for k in range(count)]
    parts = list(range(count))
    if wished["non_rigid_motion"] or rng.random() < 0.15:
        _bend(rng, shapes, parts, wished["non_rigid_motion"])
    eye, moves = np.array([0.0, -6.0, 1.9]), wished["camera_motion"]
    travel = _strength(rng, moves, (0.15, 1.2), (0.004, 0.08)) * np.array([rng.choice([-1, 1]), 0.0, 0.25])
    low, high = (0.15, 0.75) if wished["appearance_change"] else (1.0, 1.0)
    light = float(rng.uniform(0.7, 0.97)) if rng.random() < _FAINT else float(rng.uniform(low, high))
    lights = (1.0, light) if rng.random() < 0.5 else (light, 1.0)
    base = SyntheticSpec(
        f"effects-{seed}", tuple(shapes), frames=FRAMES, size=SIZE, eye=(_vector(eye), _vector(eye + travel)),
        light=lights if wished["appearance_change"] or rng.random() < 0.2 else (1.0, 1.0),
        given=("depth", "cameras") if rng.random() < 0.5 else (), seed=seed, novel_every=0, parts=tuple(parts),
    )  # fmt: skip
    return MadeClip(base, wished, float(rng.choice([5.0, 20.0, 30.0, 60.0, 180.0])))


def _strength(rng: np.random.Generator, on: bool, plain: tuple[float, float], faint: tuple[float, float]) -> float:
    """Log-uniform in one of the ranges; zero or faint when not wished for."""
    low, high = faint if rng.random() < _FAINT else plain if on else (0.0, 0.0)
    return float(np.exp(rng.uniform(np.log(low), np.log(high)))) if low > 0 else 0.0


def _distance(lane: float) -> float:
    """From the camera to a lane, along y."""
    return lane + 6.0


def _world_x(place: float, lane: float) -> float:
    """World x of a place across the picture, -0.5..0.5 of its width, in a lane."""
    return place * _distance(lane) / _FOCAL


Track = tuple[float, float, tuple[float, ...]]  # lane y, half width across the picture, places over time


def _apart(rng: np.random.Generator, count: int) -> list[Track]:
    """Every object keeps to its own part of the picture; sometimes they come very near."""
    width = 0.9 / count
    tracks: list[Track] = []
    for k in range(count):
        half = float(rng.uniform(0.5, 0.75)) * min(width / 2, 0.17)
        gap = float(rng.uniform(0.0, 0.02)) if rng.random() < _FAINT else 0.03
        room = max(0.0, width / 2 - half - gap)
        ends = -0.45 + width * (k + 0.5) + room * rng.uniform(-1, 1, 2)
        tracks.append((float(rng.choice(_LANES)), half, tuple(map(float, ends))))
    return tracks


def _crossing(rng: np.random.Generator, count: int) -> list[Track]:
    """The first two objects pass each other in different lanes, or only just meet; a third stands aside."""
    lanes = rng.permutation(_LANES)
    halves = rng.uniform(0.08, 0.14, 2)
    start, end = -0.3, 0.3
    other_start, other_end = 0.3, -0.3
    if rng.random() < _FAINT:  # they meet by a few pixels and stop, or just miss each other
        meet = float(rng.uniform(-6, 10)) / SIZE[0]
        end, other_end = -halves[0] + meet / 2, halves[1] - meet / 2
    tracks: list[Track] = [
        (float(lanes[0]), float(halves[0]), (start, end)), (float(lanes[1]), float(halves[1]), (other_start, other_end))
    ]  # fmt: skip
    if count > 2:
        side = float(rng.choice([-1, 1]))
        tracks.append((float(lanes[2]), 0.05, (0.43 * side, 0.41 * side)))
    return tracks


def _leaving(rng: np.random.Generator, tracks: list[Track]) -> list[Track]:
    """The object nearest to a side leaves the picture there and comes back; sometimes only in part."""
    k = int(np.argmax([abs(sum(track[2])) for track in tracks]))
    lane, half, places = tracks[k]
    side = 1.0 if places[0] >= 0 else -1.0
    beyond = half * float(rng.uniform(0.4, 1.4) if rng.random() < _FAINT else rng.uniform(1.4, 3.0))
    out = side * (0.5 + beyond)
    return [*tracks[:k], (lane, half, (places[0], out, out, places[0])), *tracks[k + 1 :]]


def _solid(rng: np.random.Generator, k: int, lane: float, half: float, places: tuple[float, ...]) -> Shape:
    """One object on the ground along its track, of random kind, colours and turn."""
    kind = _KINDS[int(rng.integers(len(_KINDS)))]
    radius = _world_x(half, lane) / (1.42 if kind == "cube" else 1.0)
    height = radius if kind == "ball" else radius * float(rng.uniform(0.8, 1.5))
    path = tuple((_world_x(place, lane), lane, height) for place in places)
    spin = 0.0 if rng.random() < 0.4 else float(rng.uniform(-150, 150))
    colours = tuple(_vector(colour) for colour in np.stack([rng.uniform(0.05, 0.5, 3), rng.uniform(0.5, 1.0, 3)]))
    return Shape(kind, (radius, radius, height), path, (colours[0], colours[1]), pattern=float(rng.uniform(1.5, 3.0)),
                 checker=bool(rng.random() < 0.3), spin=spin, turned=float(rng.uniform(0, 90)))  # fmt: skip


def _bend(rng: np.random.Generator, shapes: list[Shape], parts: list[int], wished: bool) -> None:
    """Make one object sway, stretch or swing an arm (a second solid of the same object)."""
    k = int(rng.integers(len(shapes)))
    way = int(rng.integers(3))
    if way == 0:
        shapes[k] = replace(shapes[k], sway=_strength(rng, wished, (0.15, 0.5), (0.02, 0.12)))
    elif way == 1:
        shapes[k] = replace(shapes[k], pulse=_strength(rng, wished, (0.15, 0.4), (0.02, 0.12)))
    else:
        swing = _strength(rng, wished, (20.0, 80.0), (2.0, 12.0))
        shapes[k] = replace(shapes[k], spin=0.0)
        shapes.append(_arm(shapes[k], float(rng.uniform(20, 60)), swing))
        parts.append(k)


def _arm(body: Shape, start: float, swing: float) -> Shape:
    """A rod on top of a body that turns by `swing` degrees about the line of sight over the clip."""
    length, phases = 1.1 * max(body.radii), np.linspace(0, 1, FRAMES)
    centres = [np.array(body.matrix(float(p))[:3, 3]) for p in phases]
    angles = np.deg2rad(start + swing * phases)
    path = [_vector(c + [np.sin(a) * length, 0.0, 0.8 * body.radii[2] + np.cos(a) * length])
            for c, a in zip(centres, angles, strict=True)]  # fmt: skip
    thick = 0.3 * body.radii[0]
    return replace(body, kind="cylinder", radii=(thick, thick, length), path=tuple(path), axis=(0.0, 1.0, 0.0),
                   turned=start, spin=swing, checker=False)  # fmt: skip


def _vector(values: np.ndarray) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])
