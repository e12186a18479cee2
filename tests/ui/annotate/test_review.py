"""Between reviewer and annotator in the real window: what came back, whose words are whose, who decides."""

import pytest
from annotating import refine

from genmojo_core.tracks import edit_tracks


@pytest.fixture
def said(workspace):
    """Two points per object, filled by a line; the sentences said since."""
    refine(workspace, each=2)
    heard = []
    workspace.session.said.connect(heard.append)
    return heard


def send_back(workspace, track, reason="drift", run=(4, 8), who="Bea", note="left ear"):
    session = workspace.session
    session.do(edit_tracks.needs_fix(session.annotation, track, reason, run, who, note))


def test_a_draft_cannot_be_called_fixed_and_a_sentence_says_why(workspace, said):
    session = workspace.session
    before = session.annotation.digest()
    workspace.table.trigger("annotate.review.fixed")
    assert session.annotation.digest() == before
    assert "was not returned by a reviewer" in said[-1]
    send_back(workspace, session.track)
    workspace.table.trigger("annotate.review.fixed")
    assert session.annotation.tracks[session.track].review == "fixed"


def test_a_reviewers_words_stand_beside_the_annotators(workspace, said):
    session, track = workspace.session, workspace.session.track
    session.do(edit_tracks.update_track(session.annotation, track, note="blurred"))
    workspace.show_step(3)
    workspace.review.note.setText("slips off")
    workspace.review.fix_button.click()
    info = session.annotation.tracks[track]
    assert (info.note, info.review_note) == ("blurred", "slips off")
    session.select_track(track)
    workspace.review.note.setText("hopeless")
    workspace.review.reject_button.click()
    info = session.annotation.tracks[track]
    assert (info.note, info.review_note) == ("blurred", "hopeless")
    session.undo()
    info = session.annotation.tracks[track]
    assert (info.review, info.note, info.review_note) == ("needs_fix", "blurred", "slips off")


def test_unlocking_takes_an_approval_back_and_says_so(workspace, said):
    session, track = workspace.session, workspace.session.track
    session.do(edit_tracks.approve(session.annotation, track, "Bea"))
    workspace.table.trigger("annotate.track.lock")
    info = session.annotation.tracks[track]
    assert (info.review, info.locked) == ("in_progress", False) and "no longer approved" in said[-1]
