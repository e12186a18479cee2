"""Colours and glyphs of points: hue says the object, lightness and glyph say the point 1 to 5. The same everywhere.

Hues are those of Okabe and Ito's palette, which people with any colour vision tell apart; they are far from skin and
grass tones where possible. No Qt, so that tests and exports can use it.
"""

from __future__ import annotations

import colorsys

GLYPHS = ("circle", "square", "triangle", "diamond", "star")
_HUES = (
    (0.555, 0.85),  # sky blue
    (0.115, 0.95),  # orange
    (0.445, 0.90),  # bluish green
    (0.890, 0.62),  # pink
    (0.155, 0.90),  # yellow
    (0.030, 0.90),  # vermilion
    (0.740, 0.60),  # violet
    (0.290, 0.70),  # leaf green
)
_LIGHTNESS = (0.56, 0.72, 0.46, 0.64, 0.80)

STATE_COLOURS = {1: (86, 190, 120), 2: (214, 142, 52), 3: (128, 134, 148), 0: (70, 74, 82)}  # none is 0


def object_colour(place: int) -> tuple[int, int, int]:
    """(r, g, b) of the object at a place (0-based) of the object list."""
    return point_colour(place, 0)


def point_colour(place: int, point: int) -> tuple[int, int, int]:
    """(r, g, b) 0..255 of a point (0-based) of the object at a place (0-based) of the object list."""
    hue, saturation = _HUES[place % len(_HUES)]
    red, green, blue = colorsys.hls_to_rgb(hue, _LIGHTNESS[point % len(_LIGHTNESS)], saturation)
    return round(255 * red), round(255 * green), round(255 * blue)


def glyph(point: int) -> str:
    """Name of the glyph of a point (0-based)."""
    return GLYPHS[point % len(GLYPHS)]


def heat_colour(suspicion: float) -> tuple[int, int, int]:
    """(r, g, b) from yellow (doubtful) to red (surely wrong) for a suspicion of 0..1."""
    share = min(max(suspicion, 0.0), 1.0)
    return 255, round(210 - 165 * share), round(70 - 30 * share)
