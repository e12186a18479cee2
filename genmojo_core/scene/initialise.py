"""From pixels with depth to first Gaussians: detail-adaptive cells, unprojected; unseen parts added from other frames.

Starting from pixels instead of a random ball gives a valid scene before the first optimiser step.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.cameras import View

STEEPEST = 3.0  # largest depth step per pixel that an object's surface is followed over, in pixel widths


@dataclass(frozen=True)
class Points:
    """N coloured pieces of surface in world space.

    Args:
        xyz: (N, 3) float64. rgb: (N, 3) in 0..1. sigma: (N,) standard deviation across the view, scene units.
        tangents: (N, 2, 3) one standard deviation along the surface as the image's columns and rows run over it.
    """

    xyz: np.ndarray
    rgb: np.ndarray
    sigma: np.ndarray
    tangents: np.ndarray

    def __len__(self) -> int:
        return len(self.xyz)

    def joined(self, other: Points) -> Points:
        """Both clouds, this one first."""
        pairs = ((self.xyz, other.xyz), (self.rgb, other.rgb), (self.sigma, other.sigma),
                 (self.tangents, other.tangents))  # fmt: skip
        return Points(*(np.concatenate(pair) for pair in pairs))

    def chosen(self, keep: np.ndarray) -> Points:  # (N,) bool
        """Some of the pieces."""
        return Points(self.xyz[keep], self.rgb[keep], self.sigma[keep], self.tangents[keep])

    def moved(self, pose: np.ndarray) -> Points:
        """The cloud under a (4, 4) similarity."""
        linear = pose[:3, :3]
        size = np.cbrt(np.linalg.det(linear))
        return Points(self.xyz @ linear.T + pose[:3, 3], self.rgb, self.sigma * size, self.tangents @ linear.T)


def quadtree(image: np.ndarray, mask: np.ndarray, count: int, smallest: int = 1) -> np.ndarray:
    """Cells of the masked part of an image, small where there is detail.

    Args:
        image: (H, W, 3) uint8. mask: (H, W) bool. count: number of cells wanted (an upper bound).
        smallest: cells of this side are not split, pixels.

    Returns:
        (M, 5) float64 rows x, y (raster centre of the masked part), width, height, masked share 0..1; M <= count.
    """
    height, width = mask.shape
    if not mask.any() or count < 1:
        return np.zeros((0, 5))
    sums = _IntegralSums(image, mask)
    side = max(smallest, int(2 ** np.floor(np.log2(max(1.0, np.sqrt(mask.sum() / count) * 4)))))
    heap: list[tuple[float, int, int, int, int]] = []
    done: list[tuple[int, int, int, int]] = []
    for top in range(0, height, side):
        for left in range(0, width, side):
            cell = (top, left, min(top + side, height), min(left + side, width))
            inside, energy = sums.energy(*cell)
            if inside:
                heapq.heappush(heap, (-energy, *cell))
    while heap and len(heap) + len(done) < count:
        _, top, left, bottom, right = heapq.heappop(heap)
        if max(bottom - top, right - left) <= smallest:
            done.append((top, left, bottom, right))
            continue
        mid_y = (top + bottom + 1) // 2 if bottom - top > smallest else bottom
        mid_x = (left + right + 1) // 2 if right - left > smallest else right
        for t, b in ((top, mid_y), (mid_y, bottom)):
            for left_, right_ in ((left, mid_x), (mid_x, right)):
                if b > t and right_ > left_:
                    inside, energy = sums.energy(t, left_, b, right_)
                    if inside:
                        heapq.heappush(heap, (-energy, t, left_, b, right_))
    cells = done + [h[1:] for h in heap]
    return np.array([sums.row(*c) for c in cells])[:count]


class _IntegralSums:
    """Counts, colour and position sums of masked pixels of any rectangle in constant time."""

    def __init__(self, image: np.ndarray, mask: np.ndarray) -> None:
        weight = mask.astype(np.float64)
        gray = image.astype(np.float64).mean(axis=2) / 255.0
        ys, xs = np.mgrid[0 : mask.shape[0], 0 : mask.shape[1]]
        layers = [weight, weight * gray, weight * gray**2, weight * (xs + 0.5), weight * (ys + 0.5)]
        self.tables = [cv2.integral(layer) for layer in layers]

    def total(self, table: int, top: int, left: int, bottom: int, right: int) -> float:
        s = self.tables[table]
        return float(s[bottom, right] - s[top, right] - s[bottom, left] + s[top, left])

    def energy(self, top: int, left: int, bottom: int, right: int) -> tuple[bool, float]:
        """Whether any pixel is masked, and the squared error one colour leaves plus a floor that grows with area."""
        n = self.total(0, top, left, bottom, right)
        if n < 0.5:
            return False, 0.0
        mean = self.total(1, top, left, bottom, right) / n
        error = max(0.0, self.total(2, top, left, bottom, right) - n * mean * mean)
        return True, error + 2e-3 * n

    def row(self, top: int, left: int, bottom: int, right: int) -> tuple[float, float, float, float, float]:
        n = self.total(0, top, left, bottom, right)
        x = self.total(3, top, left, bottom, right) / n
        y = self.total(4, top, left, bottom, right) / n
        return x, y, float(right - left), float(bottom - top), n / ((right - left) * (bottom - top))


def unproject(xy: np.ndarray, depth: np.ndarray, view: View) -> np.ndarray:  # (N, 2), (N,) -> (N, 3) world
    """World points of raster pixels at depths along the camera axis."""
    rays = np.stack([(xy[:, 0] - view.cx) / view.fx, (xy[:, 1] - view.cy) / view.fy, np.ones(len(xy))], axis=1)
    camera_to_world = np.linalg.inv(view.world_to_camera)
    return (rays * depth[:, None]) @ camera_to_world[:3, :3].T + camera_to_world[:3, 3]


def project(points: np.ndarray, view: View) -> tuple[np.ndarray, np.ndarray]:  # (N, 3) -> (N, 2) raster, (N,) depth
    """Raster pixels and depths of world points; behind the camera gives NaN pixels."""
    in_camera = points @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    z = in_camera[:, 2]
    safe = np.where(z > view.near, z, np.nan)
    return np.stack([view.fx * in_camera[:, 0] / safe + view.cx, view.fy * in_camera[:, 1] / safe + view.cy], 1), z


def points_of_image(
    image: np.ndarray, depth: np.ndarray, mask: np.ndarray, view: View, count: int, steepest: float = STEEPEST
) -> Points:
    """Coloured world points of the masked part of one frame; sigma covers the cell at its depth.

    Args:
        image: (H, W, 3) uint8. depth: (H, W) z. mask: (H, W) bool. count: most points wanted.
        steepest: largest depth step per pixel that the surface is followed over, in pixel widths.
    """
    cells = quadtree(image, mask, count)
    if not len(cells):
        return Points(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros((0, 2, 3)))
    xi = np.clip(cells[:, 0].astype(int), 0, view.width - 1)
    yi = np.clip(cells[:, 1].astype(int), 0, view.height - 1)
    z = depth[yi, xi].astype(np.float64)
    # Box-averaged colour of the cell around its centre, from masked pixels only.
    weight = mask.astype(np.float64)
    sums = cv2.integral(image.astype(np.float64) / 255.0 * weight[..., None])
    counts = cv2.integral(weight)
    x0 = np.clip(np.round(cells[:, 0] - cells[:, 2] / 2), 0, view.width - 1).astype(int)
    y0 = np.clip(np.round(cells[:, 1] - cells[:, 3] / 2), 0, view.height - 1).astype(int)
    x1 = np.clip(x0 + np.maximum(cells[:, 2], 1).astype(int), x0 + 1, view.width)
    y1 = np.clip(y0 + np.maximum(cells[:, 3], 1).astype(int), y0 + 1, view.height)
    n = np.maximum(counts[y1, x1] - counts[y0, x1] - counts[y1, x0] + counts[y0, x0], 1e-9)
    rgb = (sums[y1, x1] - sums[y0, x1] - sums[y1, x0] + sums[y0, x0]) / n[:, None]
    empty = n < 0.5
    rgb[empty] = image[yi[empty], xi[empty]] / 255.0
    side = np.sqrt(cells[:, 2] * cells[:, 3] * np.maximum(cells[:, 4], 0.25))
    sigma = 0.5 * side * z / np.sqrt(view.fx * view.fy)
    return Points(unproject(cells[:, :2], z, view), rgb, sigma, _tangents(depth, mask, cells, view, steepest))


def _tangents(depth: np.ndarray, mask: np.ndarray, cells: np.ndarray, view: View, steepest: float) -> np.ndarray:
    """(M, 2, 3) half a cell's width and height laid along the surface, so that it stays closed seen from the side.

    The slope comes from the smaller of the two neighbouring depth steps, and not from across the mask's border, so
    that a surface does not reach over to what lies behind it; it is limited to `steepest`.
    """
    known = np.where(mask, depth.astype(np.float64), np.nan)
    slopes = []
    for axis in (1, 0):
        step = np.diff(known, axis=axis)
        pad = [(0, 0), (0, 0)]
        pad[axis] = (1, 0)
        before = np.nan_to_num(np.pad(step, pad, constant_values=np.nan), nan=np.inf)
        pad[axis] = (0, 1)
        after = np.nan_to_num(np.pad(step, pad, constant_values=np.nan), nan=np.inf)
        slope = np.where(np.abs(before) < np.abs(after), before, after)
        slopes.append(np.where(np.isfinite(slope), slope, 0.0))
    xi = np.clip(cells[:, 0].astype(int), 0, view.width - 1)
    yi = np.clip(cells[:, 1].astype(int), 0, view.height - 1)
    z = depth[yi, xi].astype(np.float64)
    ends = []
    for axis, slope in enumerate(slopes):
        reach = 0.5 * cells[:, 2 + axis] * np.sqrt(np.maximum(cells[:, 4], 0.25))  # pixels
        limit = steepest * z / (view.fx, view.fy)[axis]
        shift = np.zeros((len(cells), 2))
        shift[:, axis] = reach
        far = z + np.clip(slope[yi, xi], -limit, limit) * reach
        ends.append(unproject(cells[:, :2] + shift, far, view) - unproject(cells[:, :2], z, view))
    return np.stack(ends, axis=1)


def surface_axes(tangents: np.ndarray, thickness: float = 0.5) -> tuple[np.ndarray, np.ndarray]:
    """Gaussians that cover pieces of surface: rotations (N, 3, 3) and standard deviations (N, 3).

    The covariance is the sum of the tangents' outer products; along the normal, `thickness` of the smaller of the two.
    """
    left, spread, _ = np.linalg.svd(np.swapaxes(tangents, 1, 2), full_matrices=True)
    flip = np.linalg.det(left) < 0
    left[flip, :, 2] *= -1.0
    spread = np.maximum(spread, 1e-12)
    return left, np.concatenate([spread, thickness * spread[:, 1:]], axis=1)


def uncovered(points: Points, view: View, mask: np.ndarray) -> np.ndarray:  # (H, W) bool
    """Mask pixels onto which no point falls within about two sigma (occlusion within the cloud is ignored)."""
    xy, z = project(points.xyz, view)
    good = np.isfinite(xy).all(axis=1)
    radius = 2.2 * points.sigma[good] * np.sqrt(view.fx * view.fy) / z[good]
    covered = np.zeros(mask.shape, np.uint8)
    limit = 8 * max(mask.shape)
    for (x, y), r in zip(xy[good], radius, strict=True):
        if -limit < x < limit and -limit < y < limit:
            cv2.circle(covered, (int(x), int(y)), max(1, int(r)), 1, -1)
    return mask & (covered == 0)
