"""What sure places say about links that slide: an object that stands still, links that miss it by a known amount."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from genmojo_core.trackers.slide import slides

FRAMES, SIZE = 8, 100.0
PLACES = np.array([[50.0, 50.0], [55.0, 50.0], [250.0, 50.0]])  # the first, one beside it, one far away


class Sliding:
    """Links of a still object of 100 x 100 px that end `rate` px per frame left of where they should."""

    def __init__(self, rate: float, score: float = 0.7) -> None:
        self.areas = np.full(FRAMES, SIZE**2)
        self.layer = SimpleNamespace(mask=np.zeros((FRAMES, 540, 960), bool))
        self._rate, self._score = rate, score

    def path(self, s: int, t: int) -> SimpleNamespace:
        return SimpleNamespace(score=self._score)

    def carry(self, s: int, t: int, xy: np.ndarray) -> tuple[np.ndarray, None, None]:
        return xy - (t - s) * np.array([self._rate, 0.0]), None, None


def learnt(rate: float, sure_frames: tuple[int, ...] = (0, 2, 4), **more: float) -> np.ndarray:
    """Slides of the three points after the first was placed in some frames."""
    xy = np.repeat(PLACES[:, None], FRAMES, axis=1)
    sure = np.zeros((3, FRAMES), bool)
    sure[:, 0] = True
    sure[0, list(sure_frames)] = True
    return slides(Sliding(rate, **more), xy, sure)  # type: ignore[arg-type]


def test_a_slide_is_measured_taken_to_the_neighbour_and_to_frames_to_come_but_not_far_away() -> None:
    found = learnt(5.0)
    missed = (found[:, 4] - found[:, 0])[:, 0]
    assert missed[0] == pytest.approx(20.0, rel=0.25) and missed[1] == pytest.approx(missed[0], rel=0.1)
    assert abs(missed[2]) < 0.05
    ahead = (found[:, 6] - found[:, 4])[:, 0]
    assert 2.0 < ahead[1] < 10.0, "it goes on, less and less surely"
    assert np.abs(found[..., 1]).max() < 1e-9


@pytest.mark.parametrize(
    ("rate", "more"), [(0.7, {}), (20.0, {}), (5.0, {"score": 0.1})], ids=["hand's noise", "wrong match", "no match"]
)
def test_what_is_no_slide_changes_nothing(rate: float, more: dict[str, float]) -> None:
    assert not learnt(rate, **more).any()


def test_one_sure_frame_says_nothing() -> None:
    assert not learnt(5.0, sure_frames=(0,)).any()
