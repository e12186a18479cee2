"""How far an object's links slide, learnt from places people are sure of.

Texture that is smooth, striped or lit lets matches slide along by a little in every frame, alike for neighbouring
points and frames, and with full confidence. Two sure places of a point say by how much its links slid between them;
points nearby and frames soon after most likely slide alike. Adding that to every link is what makes one corrected
point help the others of its object, and the frames that nobody has seen yet. Regression with a Gaussian process over
the place on the object and the frame.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.trackers.object_motion import ObjectMotion

_APART = 4  # frames between two sure places at most
_MATCHED = 0.4  # score of a link from which it is a match: one that is none does not slide
_NEAR = 0.35  # of the object's size: how far one point speaks for others
_LASTING = 5.0  # frames for which a slide goes on
_DOUBT = 0.1  # variance of one slide around what its neighbourhood does, as a share
_NOISE = 1.5  # held px per frame at 540 lines: slower slides are taken for the hand's noise
_MOST = 8.0  # held px per frame: what is faster is a wrong match
_SLIDES = 2.5  # held px per frame from which links are corrected at all


def slides(
    motion: ObjectMotion,
    xy: np.ndarray,  # (n, T, 2) held px
    sure: np.ndarray,  # (n, T) bool
) -> np.ndarray:  # (n, T, 2) held px
    """What to add to links: one from frame s to t misses point n by slides[n, t] - slides[n, s]; 0 where all hold."""
    out = np.zeros_like(xy)
    points, frames, rates = _measured(motion, xy, sure)
    if not len(points):
        return out
    place = xy[np.arange(len(xy)), np.argmax(sure, axis=1)] / (_NEAR * float(np.sqrt(motion.areas.max())))
    near = np.exp(-0.5 * np.square(place[:, None] - place[None]).sum(axis=2))
    lasting = np.exp(-np.abs(np.arange(xy.shape[1] - 1)[:, None] - frames[None]) / _LASTING)  # (T - 1, m)
    alike = near[points][:, points] * np.exp(-np.abs(frames[:, None] - frames[None]) / _LASTING)
    known = np.linalg.solve(alike + _DOUBT * np.eye(len(points)), rates)
    speed = np.einsum("nm,tm,mc->ntc", near[:, points], lasting, known)
    unit = motion.layer.mask.shape[1] / 540.0
    square = np.square(speed).sum(axis=2, keepdims=True)
    speed *= square / (square + (_NOISE * unit) ** 2)
    if np.linalg.norm(speed, axis=2).max() > _SLIDES * unit:
        out[:, 1:] = np.cumsum(speed, axis=1)
    return out


def _measured(
    motion: ObjectMotion, xy: np.ndarray, sure: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:  # (m,), (m,), (m, 2)
    """Points, frames and held px per frame by which links slide between sure places."""
    pairs: dict[tuple[int, int], list[int]] = {}
    for n, row in enumerate(sure):
        at = np.flatnonzero(row)
        for s, t in zip(at[:-1].tolist(), at[1:].tolist(), strict=True):
            if t - s <= _APART:
                pairs.setdefault((s, t), []).append(n)
    points, frames, rates = [np.zeros(0, int)], [np.zeros(0)], [np.zeros((0, 2))]
    for (s, t), rows in pairs.items():
        link, there, back = motion.path(s, t), motion.carry(s, t, xy[rows, s]), motion.carry(t, s, xy[rows, t])
        if link is None or there is None or back is None or link.score < _MATCHED:
            continue
        rate = 0.5 * ((xy[rows, t] - there[0]) - (xy[rows, s] - back[0])) / (t - s)
        slid = np.linalg.norm(rate, axis=1) < _MOST * motion.layer.mask.shape[1] / 540.0
        points.append(np.array(rows)[slid])
        frames.append(np.full(int(slid.sum()), (s + t - 1) / 2.0))
        rates.append(rate[slid])
    return np.concatenate(points), np.concatenate(frames), np.concatenate(rates)
