"""Eight families of procedural objects: solids put together at random, with symmetry and limbs where nature has them.

Space: z up, about one unit large, the front towards -y. Every draw comes from the generator that is given.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.priors.solids import BALL, CUBE, CYLINDER, PATTERNS, Solids

Rng = np.random.Generator
ROUND_OR_BOX = (BALL, CUBE, CYLINDER)


@dataclass
class Parts:
    """Solids as they are put together: `material` is an index into a palette that `painted` draws."""

    kinds: list[int] = field(default_factory=list)
    placed: list[np.ndarray] = field(default_factory=list)
    materials: list[int] = field(default_factory=list)

    def add(
        self, kind: int, centre: np.ndarray, radii: np.ndarray, material: int, turn: np.ndarray | None = None
    ) -> None:
        """One solid: centre (3,), radii (3,) along its axes, turn (3, 3)."""
        linear = np.diag(radii) if turn is None else turn @ np.diag(radii)
        self.kinds.append(kind)
        self.placed.append(np.column_stack([linear, centre]))
        self.materials.append(material)

    def rod(self, start: np.ndarray, end: np.ndarray, thickness: float, material: int, kind: int) -> None:
        """A limb from one point to another."""
        way = np.asarray(end, float) - start
        length = np.linalg.norm(way) + 1e-9
        z = way / length
        x = np.cross(z, [0.3, 0.5, 0.8])
        x /= np.linalg.norm(x) + 1e-9
        turn = np.column_stack([x, np.cross(z, x), z])
        reach = 0.5 * length + (0.5 * thickness if kind == BALL else 0.0)
        self.add(kind, (start + np.asarray(end)) / 2, np.array([thickness, thickness, reach]), material, turn)

    def painted(self, rng: Rng) -> Solids:
        """The parts with a palette, patterns and a light."""
        palette = _palette(rng, max(self.materials) + 1)
        patterned = rng.random(len(palette)) < 0.45
        pattern = np.where(patterned, rng.integers(1, PATTERNS, len(palette)), 0)
        waves = np.column_stack([rng.normal(size=(len(palette), 3)), rng.uniform(0, 6.3, len(palette))])
        waves[:, :3] *= rng.uniform(6, 22, (len(palette), 1)) / (np.linalg.norm(waves[:, :3], axis=1)[:, None] + 1e-9)
        light = rng.normal(size=3) + [0, 0, 1.2]
        rows = np.array(self.materials)
        return Solids(np.array(self.kinds), np.array(self.placed), palette[rows], pattern[rows], waves[rows],
                      light / np.linalg.norm(light), float(rng.uniform(0.35, 0.85)))  # fmt: skip


def draw_object(rng: Rng, strange: float = 0.0) -> Solids:
    """One object of a random family, turned about the vertical at random; of STRANGE with that probability."""
    parts = Parts()
    families = STRANGE if strange and rng.random() < strange else FAMILIES
    families[int(rng.integers(len(families)))](parts, rng)
    turn = axis_angle_matrix(np.array([0.0, 0.0, 1.0]), float(rng.uniform(0, 360)))
    if rng.random() < 0.15:  # lying, falling, seen at an odd angle
        axis = rng.normal(size=3)
        turn = axis_angle_matrix(axis / np.linalg.norm(axis), float(rng.uniform(0, 180))) @ turn
    parts.placed = [turn @ place for place in parts.placed]
    return parts.painted(rng)


def _palette(rng: Rng, count: int) -> np.ndarray:  # (count, 2, 3)
    """Pairs of colours, some muted, some strong; the second of a pair is often a shade of the first."""
    first = rng.random((count, 3)) ** rng.uniform(0.5, 2.0)
    muted = rng.random((count, 1)) < 0.5
    grey = first.mean(axis=1, keepdims=True)
    first = np.where(muted, grey + 0.35 * (first - grey), first)
    shade = np.clip(first * rng.uniform(0.25, 1.8, (count, 1)), 0, 1)
    second = np.where(rng.random((count, 1)) < 0.5, shade, rng.random((count, 3)))
    return np.clip(np.stack([first, second], axis=1), 0.02, 1.0)


def _solids(parts: Parts, rng: Rng) -> None:
    """One or two solids."""
    for i in range(int(rng.integers(1, 3))):
        axis = rng.normal(size=3)
        turn = axis_angle_matrix(axis / np.linalg.norm(axis), float(rng.uniform(0, 90)) * (rng.random() < 0.4))
        centre = rng.normal(size=3) * 0.25 * i
        parts.add(int(rng.choice(ROUND_OR_BOX)), centre, rng.uniform(0.2, 0.6, 3), i, turn)


def _blobs(parts: Parts, rng: Rng) -> None:
    """Some balls that grow out of one another, mirrored half the time."""
    mirror = rng.random() < 0.5
    centre = np.zeros(3)
    for _ in range(int(rng.integers(3, 7))):
        radii = rng.uniform(0.12, 0.38, 3)
        material = int(rng.integers(3))
        parts.add(BALL, centre, radii, material)
        if mirror:
            parts.add(BALL, centre * [-1, 1, 1], radii, material)
        centre = centre + rng.normal(size=3) * 0.25


def _quadruped(parts: Parts, rng: Rng) -> None:
    """Body, neck, head with ears, four legs, tail."""
    length, width, height = rng.uniform(0.3, 0.6), rng.uniform(0.1, 0.24), rng.uniform(0.12, 0.26)
    leg, thick = rng.uniform(0.2, 0.6), rng.uniform(0.03, 0.08)
    body = CUBE if rng.random() < 0.15 else BALL
    parts.add(body, np.zeros(3), np.array([width, length, height]), 0)
    if rng.random() < 0.6:  # chest and hips
        parts.add(BALL, np.array([0, -0.6 * length, 0.02]), np.array([width, 0.4 * length, height]) * 1.08, 0)
        parts.add(BALL, np.array([0, 0.6 * length, 0.0]), np.array([width, 0.4 * length, height]) * 1.02, 0)
    neck = np.array([0, -length - rng.uniform(-0.05, 0.15), height + rng.uniform(0.0, 0.3)])
    parts.rod(np.array([0, -0.8 * length, 0.3 * height]), neck, rng.uniform(0.06, 0.12), 0, BALL)
    skull = rng.uniform(0.08, 0.17)
    parts.add(BALL, neck, np.array([skull, skull * rng.uniform(1, 1.8), skull]), int(rng.integers(2)))
    ear, tall = rng.uniform(0.02, 0.06), rng.uniform(0.04, 0.14)
    for side in (-1, 1):
        parts.add(BALL, neck + [side * 0.7 * skull, 0.02, skull], np.array([ear, ear, tall]), 1)
        for place in (-0.75, 0.75):
            hip = np.array([side * 0.75 * width, place * length, -0.3 * height])
            foot = hip + [0, rng.normal() * 0.15, -leg]
            parts.rod(hip, foot, thick, int(rng.integers(2)), BALL if rng.random() < 0.6 else CYLINDER)
    tail = np.array([0, length, 0.2 * height])
    parts.rod(tail, tail + [0, rng.uniform(0.1, 0.4), rng.uniform(-0.3, 0.3)], rng.uniform(0.02, 0.06), 1, BALL)


def _human(parts: Parts, rng: Rng) -> None:
    """Torso, head with hair or hat, two jointed arms and legs, sometimes a bag or a skirt."""
    tall, wide, deep = rng.uniform(0.24, 0.36), rng.uniform(0.13, 0.22), rng.uniform(0.08, 0.15)
    parts.add(int(rng.choice(ROUND_OR_BOX)), np.zeros(3), np.array([wide, deep, tall]), 0)
    parts.add(BALL, np.array([0, 0, -0.8 * tall]), np.array([wide, deep * 1.1, 0.14]), 1)
    skull = rng.uniform(0.09, 0.14)
    head = np.array([0, 0, tall + skull * 1.1])
    parts.add(BALL, head, np.array([skull, skull, skull * 1.2]), 2)
    if rng.random() < 0.7:
        parts.add(BALL, head + [0, 0.03, 0.04], np.array([1.08, 1.05, 1.15]) * skull, 3)
    arm, leg = rng.uniform(0.04, 0.07), rng.uniform(0.05, 0.09)
    kind = BALL if rng.random() < 0.6 else CYLINDER
    for side in (-1, 1):
        shoulder = np.array([side * (wide + 0.5 * arm), 0, 0.8 * tall])
        elbow = shoulder + [side * abs(rng.normal()) * 0.08, rng.normal() * 0.12, -rng.uniform(0.15, 0.28)]
        hand = elbow + [side * rng.normal() * 0.06, -abs(rng.normal()) * 0.15, -rng.uniform(0.02, 0.25)]
        parts.rod(shoulder, elbow, arm, 0, kind)
        parts.rod(elbow, hand, 0.85 * arm, 2, kind)
        hip = np.array([side * 0.55 * wide, 0, -0.9 * tall])
        knee = hip + [side * abs(rng.normal()) * 0.03, rng.normal() * 0.14, -rng.uniform(0.22, 0.34)]
        foot = knee + [0, rng.normal() * 0.12, -rng.uniform(0.2, 0.34)]
        parts.rod(hip, knee, leg, 1, kind)
        parts.rod(knee, foot, 0.8 * leg, 1, kind)
        parts.add(BALL, foot + [0, -0.05, 0], np.array([0.05, 0.1, 0.04]), 4)
    if rng.random() < 0.3:
        parts.add(int(rng.choice(ROUND_OR_BOX)), np.array([0, deep + 0.08, 0.1]), rng.uniform(0.08, 0.2, 3), 4)
    if rng.random() < 0.2:
        parts.add(CYLINDER, np.array([0, 0, -tall - 0.15]), np.array([1.3 * wide, 1.3 * deep, 0.2]), 1)


def _vehicle(parts: Parts, rng: Rng) -> None:
    """Body, cabin, wheels, lights; cars, vans, carts."""
    length, width, height = rng.uniform(0.4, 0.7), rng.uniform(0.2, 0.3), rng.uniform(0.09, 0.2)
    body = CUBE if rng.random() < 0.75 else BALL
    parts.add(body, np.zeros(3), np.array([width, length, height]), 0)
    top, place = rng.uniform(0.08, 0.2), rng.uniform(-0.35, 0.35) * length
    cabin = np.array([0.88 * width, rng.uniform(0.35, 0.8) * length, top])
    parts.add(body, np.array([0, place, height + 0.8 * top]), cabin, int(rng.integers(2)))
    parts.add(CUBE, np.array([0, place, height + 0.9 * top]), cabin * [1.02, 0.92, 0.55], 2)
    wheel, thick = rng.uniform(0.09, 0.16), rng.uniform(0.03, 0.06)
    turn = axis_angle_matrix(np.array([0.0, 1.0, 0.0]), 90)
    for side in (-1, 1):
        for along in (-0.65, 0.65):
            centre = np.array([side * width, along * length, -height])
            parts.add(CYLINDER, centre, np.array([wheel, wheel, thick]), 3, turn)
        parts.add(BALL, np.array([side * 0.7 * width, -length, 0.2 * height]), np.array([0.05, 0.03, 0.04]), 4)


def _furniture(parts: Parts, rng: Rng) -> None:
    """Tables, chairs, shelves: a board, legs, often a back."""
    wide, deep, thick = rng.uniform(0.25, 0.5), rng.uniform(0.2, 0.45), rng.uniform(0.03, 0.1)
    parts.add(CUBE if rng.random() < 0.7 else CYLINDER, np.zeros(3), np.array([wide, deep, thick]), 0)
    leg, foot = rng.uniform(0.2, 0.5), rng.uniform(0.025, 0.06)
    kind = CUBE if rng.random() < 0.5 else CYLINDER
    for x in (-0.85, 0.85):
        for y in (-0.85, 0.85):
            parts.add(kind, np.array([x * wide, y * deep, -thick - leg / 2]), np.array([foot, foot, leg / 2]), 1)
    if rng.random() < 0.6:
        tall = rng.uniform(0.2, 0.45)
        parts.add(CUBE, np.array([0, 0.9 * deep, tall]), np.array([wide, 0.05, tall]), int(rng.integers(3)))
    if rng.random() < 0.4:
        parts.add(int(rng.choice(ROUND_OR_BOX)), np.array([0, 0, thick + 0.1]), rng.uniform(0.08, 0.2, 3), 2)


def _stack(parts: Parts, rng: Rng) -> None:
    """Things turned on a lathe or piled up: bottles, lamps, towers, cups."""
    height = 0.0
    radius = rng.uniform(0.15, 0.35)
    for i in range(int(rng.integers(2, 6))):
        half = rng.uniform(0.05, 0.28)
        kind = int(rng.choice([CYLINDER, CYLINDER, BALL, CUBE]))
        shift = rng.normal(size=2) * 0.03 * (rng.random() < 0.3)
        parts.add(kind, np.array([*shift, height + half]), np.array([radius, radius, half]), i % 4)
        height += 1.8 * half
        radius = float(np.clip(radius * rng.uniform(0.5, 1.4), 0.05, 0.4))


def _flyer(parts: Parts, rng: Rng) -> None:
    """Birds and fish: body, head, flat wings or fins, tail."""
    length, width, height = rng.uniform(0.3, 0.55), rng.uniform(0.08, 0.2), rng.uniform(0.1, 0.28)
    parts.add(BALL, np.zeros(3), np.array([width, length, height]), 0)
    skull = rng.uniform(0.08, 0.16)
    head = np.array([0, -length - rng.uniform(-0.12, 0.05), rng.uniform(-0.02, 0.15)])
    parts.add(BALL, head, np.full(3, skull), int(rng.integers(2)))
    parts.rod(head, head + [0, -skull - 0.1, -0.02], 0.03, 2, BALL)
    wing, span, lift = rng.uniform(0.1, 0.25), rng.uniform(0.1, 0.5), rng.uniform(-40, 60)
    for side in (-1, 1):
        turn = axis_angle_matrix(np.array([0.0, 1.0, 0.0]), -side * lift)
        centre = np.array([side * width, 0, 0.2 * height]) + turn @ np.array([side * 0.8 * span, 0, 0])
        parts.add(BALL, centre, np.array([span, wing, 0.03]), 1, turn)
    flat = np.array([0.03, 0.15, rng.uniform(0.1, 0.25)])
    parts.add(BALL, np.array([0, length + 0.08, 0]), flat if rng.random() < 0.5 else flat[[2, 1, 0]], 1)
    if rng.random() < 0.4:
        parts.add(BALL, np.array([0, 0, height]), np.array([0.03, 0.2, 0.12]), 1)


FAMILIES: tuple[Callable[[Parts, Rng], None], ...] = (
    _solids, _blobs, _quadruped, _human, _vehicle, _furniture, _stack, _flyer,
)  # fmt: skip


def _ring(parts: Parts, rng: Rng) -> None:
    """Rings, handles, knots of a rod: pierced things, standing, leaning or lying."""
    radius, thick = rng.uniform(0.2, 0.45), rng.uniform(0.05, 0.2)
    count, squash = 14, rng.uniform(0.6, 1.0)
    wave = rng.uniform(0.0, 0.15) * (rng.random() < 0.3)
    axis = rng.normal(size=3)
    tilt = axis_angle_matrix(axis / np.linalg.norm(axis), float(rng.uniform(0, 90)))
    turn = np.linspace(0, 2 * np.pi, count + 1)
    points = np.column_stack([radius * np.cos(turn), wave * np.sin(3 * turn), squash * radius * np.sin(turn)]) @ tilt.T
    for start, end in zip(points[:-1], points[1:], strict=True):
        parts.rod(start, end, thick, 0, BALL)
    if rng.random() < 0.3:
        parts.add(int(rng.choice(ROUND_OR_BOX)), points[0] + rng.normal(size=3) * 0.1, rng.uniform(0.1, 0.3, 3), 1)


def _cone(parts: Parts, rng: Rng) -> None:
    """Cones and tapered bodies in slices, upright or upside down, with a base or a top half the time."""
    low, high = rng.uniform(0.2, 0.45), rng.uniform(0.0, 0.2)
    tall, count = rng.uniform(0.4, 1.0), 14
    for share in (np.arange(count) + 0.5) / count:
        radius = low + share * (high - low)
        parts.add(CYLINDER, np.array([0, 0, (share - 0.5) * tall]), np.array([radius, radius, tall / count / 1.9]), 0)
    if rng.random() < 0.5:
        end = np.array([0, 0, rng.choice([-0.5, 0.5]) * tall])
        parts.add(int(rng.choice(ROUND_OR_BOX)), end, rng.uniform(0.08, 0.4, 3), 1)


def _bent(parts: Parts, rng: Rng) -> None:
    """A thick bar that bends: worms, bananas, leaning poles."""
    tall, bend, thick = rng.uniform(0.5, 1.1), rng.uniform(-1.5, 1.5), rng.uniform(0.08, 0.28)
    share = np.linspace(-0.5, 0.5, 9)
    points = np.column_stack([bend * 0.4 * (share + 0.5) ** 2, rng.uniform(-0.3, 0.3) * share, tall * share])
    for start, end in zip(points[:-1], points[1:], strict=True):
        parts.rod(start, end, thick, 0, CYLINDER)


def _face(parts: Parts, rng: Rng) -> None:
    """A head: skull, brow, snout, jaw, eyes, large ears; the front clearly unlike the back."""
    wide, deep, tall = rng.uniform(0.25, 0.45), rng.uniform(0.22, 0.4), rng.uniform(0.25, 0.45)
    parts.add(BALL, np.zeros(3), np.array([wide, deep, tall]), 0)
    parts.add(BALL, np.array([0, -0.8 * deep, 0.45 * tall]), np.array([0.7 * wide, 0.25 * deep, 0.2 * tall]), 0)
    snout = np.array([0, -0.9 * deep, -0.45 * tall])
    parts.add(BALL, snout, np.array([0.5 * wide, rng.uniform(0.3, 0.7) * deep, 0.4 * tall]), int(rng.integers(2)))
    ear = rng.uniform(0.1, 0.28)
    for side in (-1, 1):
        parts.add(BALL, np.array([side * 0.4 * wide, -0.85 * deep, 0.2 * tall]), np.full(3, 0.16 * wide), 2)
        place = np.array([side * (wide + 0.5 * ear), rng.uniform(-0.2, 0.3) * deep, rng.uniform(0, 0.6) * tall])
        parts.add(BALL, place, np.array([ear, 0.05, ear * rng.uniform(0.8, 1.6)]), int(rng.integers(2)))


STRANGE: tuple[Callable[[Parts, Rng], None], ...] = (_ring, _cone, _bent, _face)
