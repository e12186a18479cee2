"""How good point tracks are: ATE, MTE, EPE, survival, TAP-Vid's AJ, delta and OA, and errors in space.

Definitions of METHOD.md section 8. All distances in the plane are in pixels of a 256 x 256 image; x and y are scaled
on their own. P tracks, T frames. AJ, delta, OA and survival are 0..100.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks.model import NONE, PointTracks

SIDE = 256.0
THRESHOLDS = (1, 2, 4, 8, 16)
SURVIVAL_PIXELS = 16.0  # the value of the pips2 script
STRIDE = 5  # TAP-Vid "strided": a query every 5 frames


def track_metrics(
    predicted: PointTracks, truth: PointTracks, query_frames: np.ndarray | None = None
) -> dict[str, float]:
    """All figures of METHOD.md section 8 for tracks row by row.

    Positions are scored wherever the truth has one, hidden frames included; where a prediction has none, its last
    known position counts (so leaving points out gains nothing) and `missing` tells how many.

    Args:
        predicted, truth: the same P tracks over the same T frames, each in pixels of its own `size`.
        query_frames: (P,) frame each track was asked at; default: the first frame where the truth is visible.

    Returns:
        ate (mean over all scored track frames), mte (per-track median, then mean), mte_pooled (median of all), a_epe
        and m_epe (mean and median of the error in the last frame, tracks without truth there count in epe_skipped),
        ate_visible, hidden (mean over frames where the truth is not visible), survival, aj, delta, oa and delta_<d>
        (TAP-Vid "first": only frames after the query), the same with _strided (a query every 5 frames where visible,
        every other frame scored), delta_all (all frames but 0, hidden too, as pips2), tracks, frames, missing.
    Raises GenmojoError("schema") if tracks or frames do not match, "empty" without any truth.
    """
    if predicted.state.shape != truth.state.shape:
        raise GenmojoError("schema", f"{predicted.state.shape[0]} tracks over {predicted.state.shape[1]} frames are "
                           f"compared with {truth.state.shape[0]} over {truth.state.shape[1]}", "tracks")  # fmt: skip
    scored = (truth.state != NONE) & np.isfinite(truth.xy).all(axis=-1)  # (P, T)
    if not scored.any():
        raise GenmojoError("empty", "the truth holds no position", "tracks")
    guess, missing = _filled(predicted)
    offset = _at_256(guess, predicted.size) - _at_256(truth.xy, truth.size)
    squared = np.where(scored, np.square(offset).sum(axis=-1), 0.0)  # (P, T)
    figures = {"tracks": float(len(scored)), "frames": float(scored.shape[1]),
               "missing": float((missing & scored).sum())}  # fmt: skip
    figures |= _position_figures(np.sqrt(squared), scored, truth.visible & scored)
    if query_frames is None:
        query_frames = np.argmax(truth.visible, axis=1)
    seen = truth.visible.any(axis=1)
    return figures | _tap_figures(squared, scored, truth.visible & scored, predicted.visible,
                                  np.where(seen, query_frames, scored.shape[1]))  # fmt: skip


def select(tracks: PointTracks, rows: np.ndarray, frames: np.ndarray | None = None) -> PointTracks:
    """Some tracks (indices or bool), and some frames (positions), of point tracks."""
    columns = slice(None) if frames is None else frames

    def cut(array: np.ndarray | None) -> np.ndarray | None:
        return None if array is None else array[rows][:, columns]

    return PointTracks(
        tracks.xy[rows][:, columns], tracks.state[rows][:, columns], tracks.object[rows], tracks.size,
        cut(tracks.xyz), cut(tracks.conf), cut(tracks.flags), cut(tracks.source),
    )  # fmt: skip


def space_metrics(
    predicted: np.ndarray,  # (P, T, 3) world
    truth: np.ndarray,  # (P, T, 3) world
    fit: bool,
    objects: np.ndarray | None = None,  # (P,) ids
) -> dict[str, float]:
    """Errors in space, in the truth's units: ate_3d is the mean distance over all tracks and frames.

    Args:
        fit: the scene's unit and place are its own (depth or cameras were estimated), so ate_3d is taken after one
            similarity fit over all points; without it the raw coordinates are compared.

    Returns:
        ate_3d, and under their own keys ate_3d_raw, ate_3d_fit, the fitted scale fit_scale, and extent_3d (root mean
        square distance of the truth from its mean, to judge the others by). With objects also ate_3d_percent: ate_3d
        in percent of the objects' mean size, each twice the largest distance of its points from their middle.
    Raises GenmojoError("empty") without a finite pair.
    """
    good = np.isfinite(predicted).all(axis=-1) & np.isfinite(truth).all(axis=-1)
    if not good.any():
        raise GenmojoError("empty", "no point has a position in space", "tracks")
    ours, theirs = predicted[good].astype(np.float64), truth[good].astype(np.float64)
    scale, rotation, shift = fit_similarity(ours, theirs)
    moved = scale * ours @ rotation.T + shift
    raw = float(np.linalg.norm(ours - theirs, axis=-1).mean())
    fitted = float(np.linalg.norm(moved - theirs, axis=-1).mean())
    extent = float(np.sqrt(np.square(theirs - theirs.mean(axis=0)).sum(axis=-1).mean()))
    figures = {"ate_3d": fitted if fit else raw, "ate_3d_raw": raw, "ate_3d_fit": fitted, "fit_scale": scale,
               "extent_3d": extent}  # fmt: skip
    size = 0.0 if objects is None else float(np.mean([_size(truth[objects == k]) for k in np.unique(objects)]))
    return figures | ({"ate_3d_percent": 100.0 * figures["ate_3d"] / size} if size > 0 else {})


def _size(truth: np.ndarray) -> float:  # (P, T, 3) of one object
    """Its mean size over the frames in which all its points have a place; 0 if there is none."""
    known = np.isfinite(truth).all(axis=(0, 2))
    away = np.linalg.norm(truth[:, known] - truth[:, known].mean(axis=0), axis=-1)
    return 2.0 * float(away.max(axis=0).mean()) if known.any() else 0.0


def fit_similarity(source: np.ndarray, target: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """Scale s, rotation R and shift t that bring source (M, 3) nearest to target: s R x + t (Umeyama 1991).

    R is right-handed; s > 0. One point, or all points the same, give s = 1 and a pure shift.
    """
    mean_source, mean_target = source.mean(axis=0), target.mean(axis=0)
    a, b = source - mean_source, target - mean_target
    spread = np.square(a).sum()
    if spread < 1e-20:
        return 1.0, np.eye(3), mean_target - mean_source
    u, singular, vt = np.linalg.svd(b.T @ a)
    sign = np.array([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(vt))])
    rotation = (u * sign) @ vt
    scale = float(max((singular * sign).sum() / spread, 1e-12))
    return scale, rotation, mean_target - scale * rotation @ mean_source


def _at_256(xy: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Pixels of a 256 x 256 image, x and y scaled on their own."""
    return xy.astype(np.float64) * (SIDE / np.array(size, np.float64))


def _filled(tracks: PointTracks) -> tuple[np.ndarray, np.ndarray]:
    """Positions with gaps closed by the last known one (before the first: the first; none at all: the centre)."""
    known = np.isfinite(tracks.xy).all(axis=-1) & (tracks.state != NONE)  # (P, T)
    frames = np.arange(known.shape[1])
    last = np.maximum.accumulate(np.where(known, frames, -1), axis=1)
    source = np.where(last >= 0, last, np.argmax(known, axis=1)[:, None])
    xy = np.take_along_axis(tracks.xy, source[..., None], axis=1)
    centre = np.array(tracks.size, np.float32) / 2
    return np.where(known.any(axis=1)[:, None, None], xy, centre), ~known


def _position_figures(error: np.ndarray, scored: np.ndarray, visible: np.ndarray) -> dict[str, float]:
    """Figures of distances; error, scored and visible are (P, T)."""
    medians = [float(np.median(e[s])) for e, s in zip(error, scored, strict=True) if s.any()]
    last = error[:, -1][scored[:, -1]]
    hidden = scored & ~visible
    figures = {
        "ate": float(error[scored].mean()),
        "mte": float(np.mean(medians)),
        "mte_pooled": float(np.median(error[scored])),
        "epe_skipped": float((~scored[:, -1]).sum()),
        "survival": 100.0 * float(np.cumprod((error <= SURVIVAL_PIXELS) | ~scored, axis=1).mean()),
    }
    if last.size:
        figures |= {"a_epe": float(last.mean()), "m_epe": float(np.median(last))}
    if visible.any():
        figures["ate_visible"] = float(error[visible].mean())
    if hidden.any():
        figures["hidden"] = float(error[hidden].mean())
    later = scored.copy()
    later[:, 0] = False
    if later.any():
        figures["delta_all"] = 100.0 * float(np.mean([(error[later] < d).mean() for d in THRESHOLDS]))
    return figures


def _tap_figures(
    squared: np.ndarray,  # (P, T) squared distance at 256 x 256
    scored: np.ndarray,  # (P, T) bool
    visible: np.ndarray,  # (P, T) bool truth
    claimed: np.ndarray,  # (P, T) bool prediction
    query: np.ndarray,  # (P,) frame, T for tracks that are never visible
) -> dict[str, float]:
    """TAP-Vid's occlusion accuracy, delta and Jaccard, "first" and "strided"."""
    frames = np.arange(squared.shape[1])
    first = scored & (frames > query[:, None])
    figures = _tap(squared, visible, claimed, first.astype(np.int64), "")
    asked = visible & (frames % STRIDE == 0)  # every asked frame is one query; it scores all other frames
    weight = np.where(scored, asked.sum(axis=1, keepdims=True) - asked, 0)
    return figures | _tap(squared, visible, claimed, weight, "_strided")


def _tap(
    squared: np.ndarray, visible: np.ndarray, claimed: np.ndarray, weight: np.ndarray, suffix: str
) -> dict[str, float]:
    """OA, delta and AJ where each (track, frame) counts `weight` times. "Within d" is strict: squared < d * d."""
    total, positives = weight.sum(), (weight * visible).sum()
    if total == 0:
        return {}
    figures = {f"oa{suffix}": 100.0 * float((weight * (visible == claimed)).sum() / total)}
    if positives == 0:
        return figures
    deltas, jaccards = [], []
    for threshold in THRESHOLDS:
        within = squared < threshold * threshold
        hit = (weight * (within & visible & claimed)).sum()
        false = (weight * (claimed & ~(visible & within))).sum()
        deltas.append(100.0 * float((weight * (within & visible)).sum() / positives))
        jaccards.append(100.0 * float(hit / (positives + false)))
        figures[f"delta_{threshold}{suffix}"] = deltas[-1]
    return figures | {f"delta{suffix}": float(np.mean(deltas)), f"aj{suffix}": float(np.mean(jaccards))}
