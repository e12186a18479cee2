"""How long seeding takes: a guess from the clip, put right by what this machine needed before; and while it runs, how
long it still takes."""

from __future__ import annotations

from genmojo_studio.settings import Settings
from genmojo_studio.translate import tr

_KEY = "seed/speed/"  # of the settings: seconds needed per second guessed, by kind of tracker
_NEWEST = 0.5  # what the newest run counts beside those before
_FACTOR = 100.0  # by which a run may differ from its guess and still teach something
_LEAST = 0.5  # seconds guessed from which a run is measured
_MOMENT = 2.0  # seconds that are not worth a number
_MINUTES = 90.0  # seconds from which minutes are told
_TOLD = 0.02  # share done from which it tells how long the rest takes


class Speeds:
    """What was measured on this machine, per kind of tracker ("optical", "cotracker:scaled_offline", ...)."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings

    def seconds(self, kind: str, guess: float) -> tuple[float, bool]:
        """Seconds to expect where a tracker guesses so many; and whether any run of its kind was measured."""
        factor = self._factor(kind)
        return guess * (factor or 1.0), factor is not None

    def learn(self, kind: str, guess: float, seconds: float) -> None:
        """A run that was guessed to take `guess` seconds took so many; one with nothing to do teaches nothing."""
        if guess < _LEAST:
            return
        newest = min(max(seconds / guess, 1.0 / _FACTOR), _FACTOR)
        old = self._factor(kind)
        factor = newest if old is None else old ** (1.0 - _NEWEST) * newest**_NEWEST
        self._settings.put(_KEY + kind, f"{factor:.4f}")

    def _factor(self, kind: str) -> float | None:
        try:
            factor = float(self._settings.text(_KEY + kind))
        except ValueError:
            return None
        return factor if 1.0 / _FACTOR <= factor <= _FACTOR else None


def duration(seconds: float) -> str:
    """ "about 40 s", "about 3 min", "a moment"."""
    if seconds < _MOMENT:
        return tr("a moment")
    if seconds < _MINUTES:
        return tr("about {n} s").format(n=round(seconds) if seconds < 10 else 5 * round(seconds / 5))
    return tr("about {n} min").format(n=round(seconds / 60))


def foretold(seconds: float, measured: bool, points: int, frames: int) -> str:
    """What to expect, and how well that is known."""
    if measured:
        words = tr("{points} points in {frames} frames: {time}, by what this machine needed before.")
    else:
        words = tr("{points} points in {frames} frames: {time}, a guess; it has not run on this machine yet.")
    return words.format(points=points, frames=frames, time=duration(seconds))


def rest(share: float, elapsed: float, expected: float) -> float | None:
    """Seconds still to go: at first as expected, more and more by what was done so far; None where nobody knows."""
    before = expected - elapsed
    if share < _TOLD:
        return before if before > 0 else None
    measured = elapsed * (1.0 - share) / share
    return share * measured + (1.0 - share) * max(before, measured * share)


def so_far(share: float, elapsed: float, expected: float) -> str:
    """The words on the progress bar: share, time so far, time to go."""
    left = rest(share, elapsed, expected)
    gone = f"{int(elapsed) // 60}:{int(elapsed) % 60:02d}"
    if left is None:
        return tr("{percent} % – {gone} so far, longer than expected").format(percent=round(100 * share), gone=gone)
    words = tr("{percent} % – {gone} so far, {left} to go")
    return words.format(percent=round(100 * share), gone=gone, left=duration(left))
