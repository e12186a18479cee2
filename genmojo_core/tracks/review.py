"""Where the review of a track stands, and what may follow on what: the one place that says so.

    draft -> in_progress -> needs_fix <-> fixed -> approved | rejected

A reviewer may decide at any time, also otherwise than before; only what was returned can be called fixed, and an
approved track is worked on again only once it is reopened.
"""

from __future__ import annotations

from typing import Literal, get_args

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks.annotation import Annotation, Review, TrackInfo

Deed = Literal["begin", "return", "fix", "approve", "reject", "reopen"]
REVIEWS: tuple[Review, ...] = get_args(Review)
SETTLED: tuple[Review, ...] = ("approved", "rejected")  # nothing is left to be done

_STEPS: dict[Deed, tuple[tuple[Review, ...], Review]] = {  # from which states, into which
    "begin": (("draft",), "in_progress"),
    "return": (REVIEWS, "needs_fix"),
    "fix": (("needs_fix",), "fixed"),
    "approve": (("draft", "in_progress", "needs_fix", "fixed", "rejected"), "approved"),
    "reject": (("draft", "in_progress", "needs_fix", "fixed", "approved"), "rejected"),
    "reopen": (("approved",), "in_progress"),
}


def allowed(review: Review, deed: Deed) -> bool:
    """Whether a deed is possible where a review stands."""
    return review in _STEPS[deed][0]


def after(info: TrackInfo, deed: Deed) -> Review:
    """Where a track's review stands after a deed. Raises GenmojoError("argument") where it is not possible."""
    if allowed(info.review, deed):
        return _STEPS[deed][1]
    if deed == "fix":
        raise GenmojoError("argument", f"point {info.number} was not returned by a reviewer, so there is nothing to "
                           "call fixed", hint="a reviewer returns it in step 4")  # fmt: skip
    if deed == "approve":
        raise GenmojoError("argument", f"point {info.number} is approved already",
                           hint="return it or reject it to say otherwise")  # fmt: skip
    if deed == "reject":
        raise GenmojoError("argument", f"point {info.number} is rejected already",
                           hint="approve it or return it to say otherwise")  # fmt: skip
    raise GenmojoError("argument", f"the review of point {info.number} does not stand where this is possible")


def returned(annotation: Annotation) -> list[TrackInfo]:
    """Tracks that a reviewer sent back and that are not fixed yet, by id."""
    return sorted((i for i in annotation.active() if i.review == "needs_fix"), key=lambda i: i.id)


def closed(annotation: Annotation) -> bool:
    """Whether every track is approved or rejected, and there is one."""
    tracks = annotation.active()
    return bool(tracks) and all(i.review in SETTLED for i in tracks)
