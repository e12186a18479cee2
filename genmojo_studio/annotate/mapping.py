"""The one mapping between raster pixels of a clip and pixels of a widget. No Qt."""

from __future__ import annotations

from dataclasses import dataclass, replace

MOST_ZOOM = 64.0
View = tuple[float, float, float] | None  # zoom and the raster x, y in the middle; None for the whole frame


@dataclass(frozen=True)
class Mapping:
    """widget = image * zoom + offset, in device-independent widget pixels.

    Args:
        zoom: widget pixels per raster pixel, > 0. dx, dy: where raster (0, 0) lies in the widget.
    """

    zoom: float = 1.0
    dx: float = 0.0
    dy: float = 0.0

    def to_widget(self, x: float, y: float) -> tuple[float, float]:
        """Widget position of a raster position."""
        return x * self.zoom + self.dx, y * self.zoom + self.dy

    def to_image(self, x: float, y: float) -> tuple[float, float]:
        """Raster position of a widget position."""
        return (x - self.dx) / self.zoom, (y - self.dy) / self.zoom

    def zoomed(self, factor: float, x: float, y: float, least: float = 0.02) -> Mapping:
        """Zoomed by `factor` with the widget position (x, y) staying where it is; held within limits."""
        zoom = min(max(self.zoom * factor, least), MOST_ZOOM)
        there = self.to_image(x, y)
        return Mapping(zoom, x - there[0] * zoom, y - there[1] * zoom)

    def panned(self, dx: float, dy: float) -> Mapping:
        """Moved by widget pixels."""
        return replace(self, dx=self.dx + dx, dy=self.dy + dy)

    def centred(self, x: float, y: float, widget: tuple[float, float]) -> Mapping:
        """Same zoom, with raster (x, y) in the middle of a widget of size (width, height)."""
        return replace(self, dx=widget[0] / 2 - x * self.zoom, dy=widget[1] / 2 - y * self.zoom)


def fitted(image: tuple[float, float], widget: tuple[float, float], margin: float = 8.0) -> Mapping:
    """The whole image (width, height) centred in the widget with a margin around it."""
    room = max(widget[0] - 2 * margin, 1.0), max(widget[1] - 2 * margin, 1.0)
    zoom = min(room[0] / max(image[0], 1.0), room[1] / max(image[1], 1.0))
    return Mapping(zoom, (widget[0] - image[0] * zoom) / 2, (widget[1] - image[1] * zoom) / 2)
