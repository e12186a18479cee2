"""Between reviewer and annotator in the real window: what came back, whose words are whose, who decides."""

import pytest
from annotating import refine
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.suspicion import Spot
from genmojo_studio.annotate.session import open_session
from genmojo_studio.annotate.sheet_painter import ROW, RULER
from genmojo_studio.annotate.sheet_words import describe_cell
from genmojo_studio.settings import Settings


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


@pytest.fixture
def nameless():
    """A machine on which nobody has said a name yet."""
    before = Settings().text("person")
    Settings().put("person", "")
    yield
    Settings().put("person", before)


def test_the_name_is_asked_once_kept_for_later_and_changes_only_what_comes_after(nameless, workspace, said):
    session, page = workspace.session, workspace.review
    one, other, third = list(session.annotation.tracks)[:3]
    workspace.show_step(3)
    assert page.ask.isVisible() and page.person.text() == "Ada"
    session.select_track(one)
    page.approve_button.click()
    assert Settings().text("person") == "Ada" and page.ask.isHidden(), "the first decision answers"
    page.person.setText("Bea")  # and no Enter: the next decision is under this name all the same
    session.select_track(other)
    workspace.table.trigger("annotate.review.approve")
    tracks = session.annotation.tracks
    assert (tracks[one].reviewer, tracks[other].reviewer) == ("Ada", "Bea")
    assert [r.who for r in session.project.history() if r.title == "Approve"] == ["Ada", "Bea"]
    page.person.setText("Cy")
    page.person.editingFinished.emit()
    session.select_track(one)
    page.approve_button.click()
    assert "approved already" in said[-1] and session.annotation.tracks[one].reviewer == "Ada"
    assert workspace.person() == "Cy", "who is named when the next clip is opened"
    page.person.setText("  ")
    page.person.editingFinished.emit()
    assert page.person.text() == "Cy"
    assert third in tracks


def test_deciding_on_ones_own_track_is_possible_and_told(workspace, said):
    session, page = workspace.session, workspace.review
    one, other = list(session.annotation.tracks)[:2]
    session.do(edit_tracks.update_track(session.annotation, other, person="Cy"))
    workspace.show_step(3)
    session.select_track(one)
    assert "It is your own track." in page.about.text()
    page.approve_button.click()
    assert session.annotation.tracks[one].review == "approved" and "your own track" in said[-1]
    session.select_track(other)
    assert "Annotated by Cy." in page.about.text() and "own track" not in page.about.text()
    page.fix_button.click()
    assert said[-1] == "Returned to Cy: drift."


def test_step_four_tells_rounds_words_of_both_sides_and_when_the_clip_is_closed(workspace, said, qtbot):
    session, page = workspace.session, workspace.review
    tracks = list(session.annotation.tracks)
    one = tracks[0]
    session.do(edit_tracks.update_track(session.annotation, one, note="blurred"))
    for run in ((4, 8), (5, 6)):
        send_back(workspace, one, run=run)
        session.do(edit_tracks.fixed(session.annotation, one))
    workspace.show_step(3)
    session.select_track(one)
    item = page.tree.topLevelItem(0).child(0)
    qtbot.waitUntil(lambda: item.text(1) == "fixed  ↩2", timeout=60_000)
    assert item.toolTip(1) == "sent back 2 times"
    for words in ("Sent back by Bea, round 2: drift, frames 5 to 6.", "left ear", "The annotator's note: blurred"):
        assert words in page.about.text()
    session.select_track(tracks[-1])
    page.approve_button.click()
    assert (session.track, session.frame) == (one, 5), "what was fixed is looked at first, where it was wrong"
    for _ in tracks[1:]:
        assert "closed" not in page.summary.text()
        page.approve_button.click()
    assert "The clip is closed" in page.summary.text() and "the clip is closed" in said[-1]
    qtbot.waitUntil(lambda: page.history.item(0).text().startswith("Approve"), timeout=60_000)
    page.fix_button.click()
    assert "closed" not in page.summary.text()


def test_what_was_typed_about_a_track_goes_with_no_other(workspace, said):
    session, page = workspace.session, workspace.review
    one, other = list(session.annotation.tracks)[:2]
    workspace.show_step(3)
    session.select_track(one)
    page.note.setText("slips")
    session.select_track(other)
    assert page.note.text() == ""
    page.fix_button.click()
    assert session.annotation.tracks[other].review_note == ""
    session.select_track(one)
    assert page.note.text() == "slips"
    page.approve_button.click()
    assert session.annotation.tracks[one].review_note == "slips"


def test_accepting_is_work_and_one_step_takes_it_back(workspace, said):
    session = workspace.session
    before = session.annotation.digest()
    session.go(2)
    workspace.canvas.setFocus()
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Return)
    assert {i.review for i in session.annotation.tracks.values()} == {"in_progress"}
    session.undo()
    assert session.annotation.digest() == before


def test_a_note_is_typed_and_the_decision_made_from_the_keyboard(workspace, said, qtbot):
    session, page, track = workspace.session, workspace.review, workspace.session.track
    workspace.show_step(3)
    session.go(6)
    page.note.setFocus()
    QTest.keyClicks(page.note, "x slips")
    QTest.keyClick(page.note, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    info = session.annotation.tracks[track]
    assert (info.review, info.review_note, page.note.text()) == ("approved", "x slips", "")
    other = session.track
    assert other != track
    workspace.canvas.setFocus()
    answer = QTimer(workspace, singleShot=True, interval=50)
    answer.timeout.connect(lambda: QTest.keyClick(QApplication.activePopupWidget(), Qt.Key.Key_2))
    answer.start()
    QTest.keyClick(workspace.canvas, Qt.Key.Key_X)
    info = session.annotation.tracks[other]
    assert (info.review, info.reason, info.run) == ("needs_fix", "jump", (6, 6))


def test_in_step_four_n_goes_to_what_was_fixed_and_not_to_what_was_just_sent_back(workspace, said):
    session, queue = workspace.session, workspace.hands.going.queue
    one, other, third = list(session.annotation.tracks)[:3]
    queue.set_spots([Spot(third, 10, 14, 11, 0.9, ("sudden motion",))])
    send_back(workspace, one, run=(7, 9))
    session.do(edit_tracks.fixed(session.annotation, one))
    send_back(workspace, other)
    assert [s.track for s in queue.spots] == [other, third]
    workspace.show_step(3)
    assert [s.track for s in queue.spots] == [one, third]
    workspace.table.trigger("annotate.move.worst")
    assert (session.track, session.frame, said[-1]) == (one, 7, "fixed: drift, “left ear”")
    workspace.show_step(2)
    assert [s.track for s in queue.spots] == [other, third]


def test_another_person_who_opens_the_project_sees_whose_track_came_back_and_why(workspace, said, clip_folder):
    session, track = workspace.session, workspace.session.track
    send_back(workspace, track)
    path = session.project.path
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, path, "Cy"))
    session, page = workspace.session, workspace.refine
    assert workspace.step == 2 and session.project.person == "Cy"
    assert page.returned.isVisible() and "Ada: " in page.returned.text.text()
    assert "for Ada" in page.queue.item(0).text() and "left ear" in page.queue.item(0).text()
    workspace.table.trigger("annotate.move.worst")
    assert (session.track, session.frame) == (track, 4)


def test_the_frames_that_a_reviewer_means_are_tinted_in_the_dope_sheet_until_it_is_fixed(workspace, said, qtbot):
    session, sheet, track = workspace.session, workspace.play.sheet, workspace.session.track
    session.select_track(list(session.annotation.tracks)[1])
    session.go(0)

    def pinks():
        """Frames of the row whose lower edge is of the colour of what came back."""
        picture = sheet.viewport().grab().toImage()
        scale = picture.width() / sheet.viewport().width()
        y = round((RULER + ROW * (sheet.rows().index(track) + 1) - 2) * scale)
        at = [picture.pixelColor(round(sheet.x_of(t + 0.5) * scale), y) for t in range(session.annotation.frames)]
        return [t for t, colour in enumerate(at) if colour.red() > 180 and colour.blue() > 100 > colour.green()]

    assert pinks() == []
    send_back(workspace, track, run=(4, 8))
    assert pinks() == [4, 5, 6, 7, 8]
    assert "Sent back by Bea" in describe_cell(session, track, 5)
    assert "Sent back by Bea" not in describe_cell(session, track, 9)
    session.do(edit_tracks.fixed(session.annotation, track))
    assert pinks() == []
