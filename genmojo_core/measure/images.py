"""How alike two pictures are: PSNR, SSIM, and overlap of shapes (METHOD.md section 8). Colours are 0..1."""

from __future__ import annotations

import cv2
import numpy as np

PSNR_MAX = 100.0  # dB, reported for equal pictures, so that means and JSON stay finite
_WINDOW, _SIGMA = 11, 1.5


def psnr(
    image: np.ndarray,  # (H, W, 3) 0..1
    target: np.ndarray,  # (H, W, 3) 0..1
    mask: np.ndarray | None = None,  # (H, W) bool or weights
) -> float:
    """-10 log10 of the mean squared error, in dB: over all pixels, or sum m e^2 / (3 sum m) over a mask.

    At most PSNR_MAX. NaN if the mask is empty.
    """
    error = np.square(image.astype(np.float64) - target.astype(np.float64)).mean(axis=-1)
    weight = np.ones(error.shape) if mask is None else mask.astype(np.float64)
    if weight.sum() == 0:
        return float("nan")
    mean = float((error * weight).sum() / weight.sum())
    return PSNR_MAX if mean <= 10 ** (-PSNR_MAX / 10) else -10.0 * float(np.log10(mean))


def ssim(image: np.ndarray, target: np.ndarray) -> float:
    """Structural similarity (Wang et al. 2004): Gaussian window 11, sigma 1.5, data range 1, population covariance.

    Mean over channels and all pixels whose window lies inside, as scikit-image computes it. Pictures smaller than the
    window are averaged whole, with mirrored borders. Args are (H, W, 3), 0..1.
    """
    a, b = image.astype(np.float64), target.astype(np.float64)
    mean_a, mean_b = _blur(a), _blur(b)
    var_a, var_b = _blur(a * a) - mean_a**2, _blur(b * b) - mean_b**2
    covariance = _blur(a * b) - mean_a * mean_b
    c1, c2 = 0.01**2, 0.03**2
    quality = ((2 * mean_a * mean_b + c1) * (2 * covariance + c2)) / (
        (mean_a**2 + mean_b**2 + c1) * (var_a + var_b + c2)
    )
    border = _WINDOW // 2
    inside = quality[border:-border, border:-border]
    return float(inside.mean() if inside.size else quality.mean())


def iou(a: np.ndarray, b: np.ndarray) -> float:  # (H, W) bool, (H, W) bool
    """Intersection over union of two shapes; 1 if both are empty."""
    union = int((a | b).sum())
    return float((a & b).sum() / union) if union else 1.0


def instance_ious(
    labels: np.ndarray,  # (H, W) rendered: 0 background, k + 1 object k
    masks: np.ndarray,  # (H, W) truth, same numbering
    valid: np.ndarray,  # (H, W) bool, False on void pixels
    objects: int,
) -> np.ndarray:  # (K,) IoU, NaN where the object has no pixel in the truth
    """Overlap of each object's rendered and true visible pixels."""
    found = np.full(objects, np.nan)
    for k in range(objects):
        true = (masks == k + 1) & valid
        if true.any():
            found[k] = iou((labels == k + 1) & valid, true)
    return found


def _blur(image: np.ndarray) -> np.ndarray:
    """Gaussian window of SSIM."""
    return cv2.GaussianBlur(image, (_WINDOW, _WINDOW), _SIGMA, borderType=cv2.BORDER_REFLECT)
