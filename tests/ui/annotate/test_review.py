"""Between reviewer and annotator in the real window: what came back, whose words are whose, who decides."""

import pytest
from annotating import refine

from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.suspicion import Spot


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


def test_what_came_back_stands_first_in_the_queue_until_it_is_fixed(workspace, said):
    session, queue, page = workspace.session, workspace.hands.going.queue, workspace.refine
    one, other, third = list(session.annotation.tracks)[:3]
    ranked = [Spot(third, 10, 14, 11, 0.9, ("sudden motion",)), Spot(other, 4, 9, 6, 0.8, ("sudden motion",))]
    queue.set_spots(ranked)
    assert page.returned.isHidden()
    send_back(workspace, other)
    assert [s.track for s in queue.spots] == [other, third], "its own doubt about the same frames is not said twice"
    assert page.returned.isVisible() and "came back" in page.returned.text.text()
    session.select_track(one)
    workspace.table.trigger("annotate.move.worst")
    assert (session.track, session.frame) == (other, 4)
    assert "sent back by Bea: drift" in said[-1] and "left ear" in said[-1]
    first = page.queue.item(0)
    assert first.text().startswith("↩") and "drift" in first.text() and "left ear" in first.text()
    workspace.refine.refresh()
    assert "Sent back by Bea, round 1: drift, frames 4 to 8" in page.why.text() and "left ear" in page.why.text()
    workspace.table.trigger("annotate.move.worst")
    assert session.track == third, "it was looked at; the next one is"
    queue.set_spots(list(ranked))
    assert queue.spots[0].track == other, "and stays at the head as long as it is not fixed"
    session.select_track(other)
    page.returned.fixed.click()
    assert session.annotation.tracks[other].review == "fixed" and "goes back to Bea" in said[-1]
    assert [s.track for s in queue.spots] == [third, other] and page.returned.isHidden()
    session.undo()
    assert queue.spots[0].track == other and page.returned.isVisible()


def test_a_person_who_is_not_the_annotator_is_told_whose_tracks_came_back(workspace, said):
    session, queue = workspace.session, workspace.hands.going.queue
    one, other = list(session.annotation.tracks)[:2]
    session.do(edit_tracks.update_track(session.annotation, one, person="Cy"))
    send_back(workspace, one)
    send_back(workspace, other)
    assert [s.track for s in queue.spots] == [other, one], "her own first"
    assert queue.spots[1].reasons[1] == "for Cy"
    lines = workspace.refine.returned.text.text().split("\n")
    assert lines[0].startswith("2 tracks came back") and lines[1].startswith("Yours: ") and lines[2].startswith("Cy: ")
