"""The data terms of the joint splat in one walk over the picture, and their gradient in another (optimise/losses.py).

Every pixel has a weight in each term's sum, which depends on the target alone: w = inside seen / n_in + outside seen /
n_out for a balanced mean. With d = colour - target, the objects' labels f_k, their sum F, and p the pixel's own label
(1 - F, at least 0, on the background)

    rgb = sum w (|d|_1 / 6 + 5 |d|^2 / 3),   alpha = sum w (F - inside)^2,   labels = sum w (-log p),
    spill = sum v F

where v is what coverage beside the masks weighs, and the logarithm goes on as its tangent below 0.01. Depth and flow
look at the pixels of lists: at most all of the objects. Eight pixels are done at once; rows are summed on their own,
so the bits do not depend on the threads.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.buffers import take
from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.lane_bits import log_8
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.simd import fma, load8, max8, select8, splat8, store8, sum_rows
from genmojo_core.kernels.threads import run_jobs, run_ranges, scratch
from genmojo_core.render.loss_limits import ALPHA_FLOOR, FEWEST, FLOW_LIMIT, GUESSED_DEPTH, LABEL_FLOOR, SHOWN

LANES = 8
ROWS_PER_JOB = 32
LOWEST = np.float32(LABEL_FLOOR)
SIXTH, TWO_THIRDS = np.float32(1 / 6), np.float32(5 / 3)
LABEL, COLOR_WEIGHT, WEIGHT, BESIDE = 3, 4, 5, 6  # planes of the target after its three colours


class Target(NamedTuple):
    """One frame's targets. Rows are padded to `wide` pixels, a multiple of 8, with weight 0."""

    planes: np.ndarray  # (7 * height * wide,) float32: colours, label (0 background), weights: colour, others, spill
    depth_pixels: np.ndarray  # (P,) int64 places in a plane, object by object
    depth_starts: np.ndarray  # (K + 1,) int64
    depth: np.ndarray  # (P,) float32
    flow_pixels: np.ndarray  # (F,) int64
    flow: np.ndarray  # (F, 2) float32 px


class Terms(NamedTuple):
    """Which terms there are, and their sizes."""

    height: int
    wide: int
    labels: int  # label channels, after the three colours
    compares_labels: bool
    flow: bool  # two flow channels follow the labels
    depth_scaled: bool  # depth was measured, no guess
    flow_unit: float  # px: 1 % of the diagonal


class Picture(NamedTuple):
    """What was drawn, padded like the target, float32, flat; or its gradient, empty where not wanted."""

    features: np.ndarray
    depth: np.ndarray
    alpha: np.ndarray


NOTHING = np.zeros(0, np.float32)


def padded(planes: np.ndarray, wide: int) -> np.ndarray:
    """(C, H, W) float32 as flat planes with rows of `wide`, the rest 0; the same memory where that is how it lies."""
    if planes.shape[2] == wide and planes.flags.c_contiguous:
        return planes.reshape(-1)
    out = take((*planes.shape[:2], wide))
    out[:, :, : planes.shape[2]] = planes
    out[:, :, planes.shape[2] :] = 0
    return out.reshape(-1)


def joint_terms(picture: Picture, target: Target, terms: Terms) -> tuple[np.ndarray, int]:
    """(6,) float64: rgb, alpha, labels, spill, depth, flow; and the number of pixels whose flow was compared."""
    sums = np.zeros((terms.height, 4))
    _walk_rows(picture, target, terms, np.zeros(4, np.float32), sums, NOTHING)
    objects = len(target.depth_starts) - 1
    values, slopes = np.zeros(max(objects, 1)), Picture(NOTHING, NOTHING, NOTHING)
    run_jobs(lambda k: compare_depth(k, picture, target, terms, 0.0, values, slopes), objects)
    flow, count = compare_flow(picture.features, target, terms, 0.0, NOTHING)
    return np.array([*sums.sum(axis=0), values.sum() / max(objects, 1), flow / max(count, 1)]), count


def joint_slopes(picture: Picture, target: Target, terms: Terms, factors: np.ndarray, flowing: int) -> Picture:
    """Gradient of factors (6,) times `joint_terms`, whose second result is `flowing`."""
    slopes = Picture(take(picture.features.shape), take(picture.depth.shape), take(picture.alpha.shape))
    slopes.depth.fill(0)
    slopes.alpha.fill(0)
    _walk_rows(picture, target, terms, factors[:4].astype(np.float32), np.zeros((terms.height, 4)), slopes.features)
    objects = len(target.depth_starts) - 1
    share, values = float(factors[4]) / max(objects, 1), np.zeros(max(objects, 1))
    run_jobs(lambda k: compare_depth(k, picture, target, terms, share, values, slopes), objects)
    compare_flow(picture.features, target, terms, float(factors[5]) / max(flowing, 1), slopes.features)
    return slopes


def warm_up() -> None:
    """Compile the kernels on almost nothing."""
    pixels, places = np.zeros(7 * LANES, np.float32), np.zeros(1, np.int64)
    target = Target(pixels, places, np.array([0, 1]), pixels[:1], places, np.zeros((1, 2), np.float32))
    picture = Picture(pixels, pixels[:LANES], pixels[:LANES])
    joint_slopes(picture, target, Terms(1, LANES, 1, True, True, True, 1.0), np.zeros(6), 1)


def _walk_rows(
    picture: Picture, target: Target, terms: Terms, factors: np.ndarray, sums: np.ndarray, slopes: np.ndarray
) -> None:  # fmt: skip
    def job(start: int, stop: int) -> None:
        span = (start, stop)
        compare_rows(span, picture.features, target.planes, terms, factors, sums, slopes, scratch(8 * LANES))

    run_ranges(job, terms.height, ROWS_PER_JOB)


@inlined
def color_terms(
    at: int, plane: int, features: np.ndarray, target: np.ndarray, slopes: np.ndarray, factor: float
) -> object:
    """Eight pixels' error of colour (Float8); their gradient where it is wanted."""
    zero = splat8(np.float32(0))
    error = zero
    weight = load8(target, COLOR_WEIGHT * plane + at)
    for c in range(3):
        d = load8(features, c * plane + at) - load8(target, c * plane + at)
        size = max8(d, zero - d)
        error = error + size * fma(size, TWO_THIRDS, SIXTH)
        if slopes.size > 0:
            sign = select8(d > zero, np.float32(1), select8(d < zero, np.float32(-1), zero))
            store8(slopes, c * plane + at, weight * factor * fma(d, TWO_THIRDS + TWO_THIRDS, sign * SIXTH))
    return weight * error


@inlined
def label_terms(
    at: int, plane: int, features: np.ndarray, target: np.ndarray, terms: Terms, slopes: np.ndarray, factors: np.ndarray
) -> tuple:
    """Eight pixels' error of coverage and of labels, and spill (Float8 each); their gradient where it is wanted."""
    zero, one = splat8(np.float32(0)), splat8(np.float32(1))
    weight, label = load8(target, WEIGHT * plane + at), load8(target, LABEL * plane + at)
    beside = load8(target, BESIDE * plane + at)
    covered, own = zero, zero
    for k in range(terms.labels):
        f = load8(features, (3 + k) * plane + at)
        covered = covered + f
        own = select8(label == np.float32(k + 1), f, own)
    inside = label > zero
    off = covered - select8(inside, one, zero)
    left = one - covered
    own = select8(inside, own, max8(left, zero))
    low = max8(own, LOWEST)
    pull = one / low
    surprise = zero
    if terms.compares_labels:
        surprise = (low - own) * pull - log_8(low)
    if slopes.size > 0:
        joint = fma(beside, factors[3], weight * off * (factors[1] + factors[1]))
        pull = weight * pull * factors[2]
        others = joint + select8(inside, zero, select8(left >= zero, pull, zero))
        for k in range(terms.labels):
            store8(slopes, (3 + k) * plane + at, others - select8(label == np.float32(k + 1), pull, zero))
        for k in range(3 + terms.labels, features.size // plane):
            store8(slopes, k * plane + at, zero)
    return weight * off * off, weight * surprise, beside * covered


@kernel
def compare_rows(
    span: tuple,
    features: np.ndarray,
    target: np.ndarray,
    terms: Terms,
    factors: np.ndarray,
    sums: np.ndarray,
    slopes: np.ndarray,
    scratch: np.ndarray,
) -> None:
    """Sums of rgb, alpha, labels and spill of rows span[0]..span[1]-1.

    Their gradient times `factors` where `slopes` has room. scratch: 64 float32 of any content.
    """
    zero = splat8(np.float32(0))
    plane = terms.height * terms.wide
    for i in range(0, 8 * LANES, LANES):
        store8(scratch, i, zero)
    for row in range(span[0], span[1]):
        rgb, alpha, labels, spill = zero, zero, zero, zero
        for at in range(row * terms.wide, (row + 1) * terms.wide, LANES):
            rgb = rgb + color_terms(at, plane, features, target, slopes, factors[0])
            off, surprise, spilt = label_terms(at, plane, features, target, terms, slopes, factors)
            alpha, labels, spill = alpha + off, labels + surprise, spill + spilt
        store8(scratch, 0, rgb)
        store8(scratch, LANES, alpha)
        store8(scratch, 2 * LANES, labels)
        store8(scratch, 3 * LANES, spill)
        total = sum_rows(scratch, 0)
        store8(scratch, 0, total)
        for i in range(4):
            sums[row, i] = scratch[i]


@inlined
def depth_at(picture: Picture, pixel: int) -> float:
    """Depth normalised by coverage, 0 where there is next to none."""
    alpha = np.float64(picture.alpha[pixel])
    return picture.depth[pixel] / alpha if alpha > ALPHA_FLOOR else 0.0


@kernel
def compare_depth(
    k: int, picture: Picture, target: Target, terms: Terms, share: float, values: np.ndarray, slopes: Picture
) -> None:
    """values[k]: error of object k's depth where it is shown; its gradient times `share` where `slopes` has room.

    The mean relative error where depth was measured, GUESSED_DEPTH (1 - correlation) where it is a guess.
    """
    shown = (3 + smaller(k, terms.labels - 1)) * terms.height * terms.wide
    count, sum_a, sum_b, error = 0, 0.0, 0.0, 0.0
    for i in range(target.depth_starts[k], target.depth_starts[k + 1]):
        pixel = target.depth_pixels[i]
        if picture.features[shown + pixel] > SHOWN:
            a, b = depth_at(picture, pixel), np.float64(target.depth[i])
            count += 1
            sum_a, sum_b = sum_a + a, sum_b + b
            error += abs(a - b) / larger(b, 1e-6)
    if count < FEWEST:
        return
    mean_a, mean_b = sum_a / count, sum_b / count
    aa, bb, ab = 0.0, 0.0, 0.0
    if not terms.depth_scaled:
        for i in range(target.depth_starts[k], target.depth_starts[k + 1]):
            pixel = target.depth_pixels[i]
            if picture.features[shown + pixel] > SHOWN:
                a, b = depth_at(picture, pixel) - mean_a, target.depth[i] - mean_b
                aa, bb, ab = aa + a * a / count, bb + b * b / count, ab + a * b / count
    spread = math.sqrt(aa * bb)
    related = spread > 1e-7
    correlation = ab / spread if related else 0.0
    values[k] = error / count if terms.depth_scaled else GUESSED_DEPTH * (1.0 - correlation)
    if slopes.depth.size == 0 or not (terms.depth_scaled or related):
        return
    for i in range(target.depth_starts[k], target.depth_starts[k + 1]):
        pixel = target.depth_pixels[i]
        alpha = np.float64(picture.alpha[pixel])
        if picture.features[shown + pixel] > SHOWN and alpha > ALPHA_FLOOR:
            a, b = depth_at(picture, pixel), np.float64(target.depth[i])
            if terms.depth_scaled:
                g = (1.0 if a > b else (-1.0 if a < b else 0.0)) / larger(b, 1e-6)
            else:
                g = -GUESSED_DEPTH * ((b - mean_b) / spread - correlation * (a - mean_a) / aa)
            g *= share / (count * alpha)
            slopes.depth[pixel] = g
            slopes.alpha[pixel] = -g * a


@kernel
def compare_flow(features: np.ndarray, target: Target, terms: Terms, share: float, slopes: np.ndarray) -> tuple:
    """Sum of flow errors where the objects are shown, in percent of the diagonal, and the number of those pixels.

    Flow is splatted without normalisation, so it is compared with the flow times the coverage. The gradient times
    `share` is added where `slopes` has room.
    """
    plane = terms.height * terms.wide
    first = (3 + terms.labels) * plane
    error, count = 0.0, 0
    for i in range(target.flow_pixels.size if terms.flow else 0):
        pixel = target.flow_pixels[i]
        covered = 0.0
        for k in range(terms.labels):
            covered += features[(3 + k) * plane + pixel]
        if not covered > SHOWN:
            continue
        x = features[first + pixel] - target.flow[i, 0] * covered
        y = features[first + plane + pixel] - target.flow[i, 1] * covered
        off = (abs(x) + abs(y)) / terms.flow_unit
        count += 1
        error += FLOW_LIMIT if off > FLOW_LIMIT else off
        if slopes.size > 0 and off <= FLOW_LIMIT:
            g = share / terms.flow_unit
            slopes[first + pixel] = g if x > 0 else (-g if x < 0 else 0.0)
            slopes[first + plane + pixel] = g if y > 0 else (-g if y < 0 else 0.0)
    return error, count
