"""The review of a track: what may follow on what, whose words stay whose, and that undo brings everything back."""

from __future__ import annotations

from pathlib import Path

import annotations
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import TRACKER, Annotation, Proposal
from genmojo_core.tracks.model import VISIBLE
from genmojo_core.tracks.review import REVIEWS, closed, returned

DEEDS = st.lists(st.sampled_from(["work", "return", "fix", "approve", "reject", "lock", "unlock", "note"]), max_size=25)


def filled() -> Annotation:
    annotation = annotations.started(12, 1, 2)
    still = Proposal("still", np.full((12, 2), 50.0, np.float32), np.full(12, VISIBLE, np.uint8),
                     np.ones(12, np.float32))  # fmt: skip
    keys.accept(annotation, {1: still, 2: still}, TRACKER).do(annotation)
    return annotation


def done(annotation: Annotation, deed: str, number: int) -> edit_tracks.Edit:
    who, words = f"person {number}", f"words {number}"
    if deed == "work":
        return edit_tracks.begin(annotation, 1)
    if deed == "return":
        return edit_tracks.needs_fix(annotation, 1, "drift", (2, 5), who, words)
    if deed == "fix":
        return edit_tracks.fixed(annotation, 1)
    if deed == "approve":
        return edit_tracks.approve(annotation, 1, who)
    if deed == "reject":
        return edit_tracks.reject(annotation, 1, who, words)
    if deed == "note":
        return edit_tracks.update_track(annotation, 1, note=f"own {number}")
    return edit_tracks.lock(annotation, 1, 0, on=deed == "lock")


@given(DEEDS)
@settings(max_examples=200, deadline=None)
def test_whatever_people_do_a_review_only_goes_where_it_may_and_undo_brings_it_back(deeds: list[str]) -> None:
    """Against a table written by hand; a deed that is refused changes nothing."""
    into = {"return": "needs_fix", "fix": "fixed", "approve": "approved", "reject": "rejected"}
    annotation = filled()
    edits, digests, rounds, own, decided = [], [], 0, "", ("", "")
    for number, deed in enumerate(deeds):
        before, digest = annotation.tracks[1], annotation.digest()
        refused = (deed == "fix" and before.review != "needs_fix") or before.review == into.get(deed, "") != "needs_fix"
        if refused:
            with pytest.raises(GenmojoError):
                done(annotation, deed, number)
            assert annotation.digest() == digest
            continue
        edit = done(annotation, deed, number)
        edit.do(annotation)
        edits.append(edit)
        digests.append(digest)
        info = annotation.tracks[1]
        unlocked = deed == "unlock" and before.review == "approved"
        plain = {"draft": "in_progress"}.get(before.review, before.review) if deed == "work" else before.review
        assert info.review == into.get(deed, "in_progress" if unlocked else plain)
        rounds += deed == "return" and before.review != "needs_fix"
        own = f"own {number}" if deed == "note" else own
        if deed in ("return", "approve", "reject"):
            decided = (f"person {number}", "" if deed == "approve" else f"words {number}")
        assert (info.rounds, info.note, (info.reviewer, info.review_note)) == (rounds, own, decided)
        assert (info.run is not None) == (info.reason != "")
        assert info.review not in ("needs_fix", "fixed") or info.reason == "drift"
        assert deed != "approve" or info.locked
        assert info.review != "approved" or info.locked, "what is approved is not worked on"
        assert annotation.tracks[2].review == "draft"
    for edit, digest in zip(edits[::-1], digests[::-1], strict=True):
        edit.undo(annotation)
        assert annotation.digest() == digest


@pytest.mark.parametrize("stands", [r for r in REVIEWS if r != "needs_fix"])
def test_only_what_was_returned_can_be_called_fixed(stands: str) -> None:
    annotation = filled()
    edit_tracks.update_track(annotation, 1, review=stands).do(annotation)
    with pytest.raises(GenmojoError, match="point 1 was not returned by a reviewer"):
        edit_tracks.fixed(annotation, 1)


def test_a_second_approval_does_not_put_another_name_on_the_first() -> None:
    annotation = filled()
    edit_tracks.approve(annotation, 1, "Bo").do(annotation)
    with pytest.raises(GenmojoError, match="approved already"):
        edit_tracks.approve(annotation, 1, "Cy")
    assert annotation.tracks[1].reviewer == "Bo"


def test_returned_and_closed_tell_what_is_left() -> None:
    annotation = filled()
    assert not closed(annotation) and returned(annotation) == []
    edit_tracks.needs_fix(annotation, 2, "jump", (1, 1), "Bo", "").do(annotation)
    edit_tracks.approve(annotation, 1, "Bo").do(annotation)
    assert [i.id for i in returned(annotation)] == [2] and not closed(annotation)
    edit_tracks.reject(annotation, 2, "Bo", "").do(annotation)
    assert returned(annotation) == [] and closed(annotation)
    assert not closed(Annotation(3, annotations.SIZE))


def test_the_app_changes_reviews_through_these_steps_only() -> None:
    """`review=` in an edit of the app would be a way around them."""
    for path in (Path(__file__).resolve().parents[2] / "genmojo_studio").rglob("*.py"):
        assert "review=" not in path.read_text("utf-8"), path
