"""The view in real windows, with both of Qt's ways to OpenGL, and without OpenGL."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.view3d.screens import run_window, screen

WAYS = ("xcb_glx", "xcb_egl")


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    with screen() as name:
        yield name


@pytest.mark.parametrize("way", WAYS)
def test_a_view_lives(display: str, way: str) -> None:
    """It shows what the optimiser sees, turns under the mouse, answers clicks; two views do not disturb each other."""
    answer = run_window(display, way, "life")
    _check_life(answer, "SplatView")


def test_a_view_on_a_fine_screen(display: str) -> None:
    """Twice the pixels, the same scene, and clicks hit what is under them."""
    answer = run_window(display, "xcb_egl", "life", QT_SCALE_FACTOR="2")
    assert answer["pixels"] == [800, 600]
    _check_life(answer, "SplatView")


def test_the_processor_draws_the_same(display: str) -> None:
    _check_life(run_window(display, "xcb_glx", "processor"), "CpuView")


@pytest.mark.parametrize("way", WAYS)
def test_taking_docks_out_and_back(display: str, way: str) -> None:
    _check_docks(run_window(display, way, "docks", "8"), 12.0)


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_taking_docks_out_and_back_50_times(display: str, way: str) -> None:
    _check_docks(run_window(display, way, "docks", "50"), 12.0)


def test_previews_leave_nothing_behind(display: str) -> None:
    """Memory after 150 previews is that after 75: textures are written anew or freed."""
    answer = run_window(display, "xcb_egl", "previews", "150")
    assert answer["newest"] == 150
    assert answer["growth_mb"] < 8


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_5000_previews_leave_nothing_behind(display: str) -> None:
    answer = run_window(display, "xcb_egl", "previews", "5000", timeout=1100)
    assert answer["newest"] == 5000
    assert answer["growth_mb"] < 8


def test_without_opengl_the_processor_draws_and_says_so(display: str) -> None:
    answer = run_window(display, "none", "missing")
    assert answer["probe"] == "MISSING"
    for engine in ("auto", "gl"):
        surface, message, brightest = answer[engine]
        assert surface == "CpuView"
        assert "No OpenGL" in message
        assert brightest > 100


def test_a_driver_that_fails_while_drawing(display: str) -> None:
    answer = run_window(display, "xcb_egl", "broken")
    assert answer["surface"] == "CpuView"
    assert "driver out of memory" in answer["message"]
    assert answer["brightest"] > 100
    assert answer["left"] == []


def test_a_late_first_picture_is_explained(display: str) -> None:
    answer = run_window(display, "xcb_glx", "late")
    assert len(answer["texts"]) == 2
    assert "once on this computer" in answer["texts"][0]
    assert answer["left_on_screen"] == answer["texts"][1] == ""


def _check_life(answer: dict, surface: str) -> None:
    assert answer["surface"] == surface
    assert answer["screen_is_screenshot"] >= 50
    assert answer["screen_is_optimiser"] >= 45
    assert answer["picked"] == "disc 1"
    assert answer["dragged"] == pytest.approx([24 * 0.35, -40 * 0.35])
    assert answer["picks_after_drag"] == 1
    assert answer["preset"] == [0.0, 30.0]
    assert answer["gizmo"] == [89.9, 0.0]
    assert answer["picks_after_gizmo"] == 1
    assert answer["time_changes_it"] < 40
    assert "black" not in answer
    assert answer["drawn_while_minimised"] == 0
    assert answer["after_minimised"] == 7.0
    assert answer["second"] > 100
    assert answer["closed_and_shown"] > 100
    assert answer["second_after_first_closed"] > 100
    assert answer["left"] == []


def _check_docks(answer: dict, growth_mb: float) -> None:
    assert answer["black"] == 0
    assert answer["sizes"] > 1
    assert answer["growth_mb"] < growth_mb
    assert answer["left"] == []
