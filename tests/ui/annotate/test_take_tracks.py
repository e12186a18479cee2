"""Tracks of files in the real window: they can be reached and are said; exports are chosen and come back whole."""

import pickle

import numpy as np
import pytest
from annotating import choose_all, fill, place_points
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog, QMessageBox

from genmojo_core.clip.frames import frame_names, open_source
from genmojo_core.store import npz, tapvid, track_npz
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.model import PointTracks
from genmojo_studio.annotate import take_tracks, track_files


@pytest.fixture
def plain_tapvid(clip_folder, tmp_path):
    """The clip's true tracks as TAP-Vid has them: nobody's, without numbers; and whose they really are."""
    with np.load(clip_folder / "truth.npz") as truth:
        owner = truth["track_object"]
    tracks = npz.read_tracks(clip_folder / "truth.npz", open_source(clip_folder).size)
    seen = np.flatnonzero(tracks.visible[:, 0] & (owner > 0))[:8]
    xy, state = tracks.xy[seen], tracks.state[seen]
    path = tmp_path / "tapvid.npz"
    tapvid.write(TrackSheet.of_tracks(PointTracks(xy, state, np.zeros(len(seen), np.int64), tracks.size)), path)
    with np.load(path) as held:
        kept = {key: held[key] for key in ("points", "occluded", "size")}
    np.savez(path, **kept)
    return path, owner[seen]


def test_plain_tapvid_is_reached_in_the_tree_of_a_fresh_project(workspace, qtbot, plain_tapvid):
    path, owners = plain_tapvid
    session, said = workspace.session, []
    session.said.connect(said.append)
    assert session.objects() == []
    take_tracks.take_file(workspace, path)
    qtbot.waitUntil(lambda: bool(session.annotation.tracks), timeout=60_000)
    assert [i.object for i in session.annotation.tracks.values()] == owners.tolist()
    assert {o.id for o in session.objects()} == set(owners.tolist())
    tree = workspace.refine.tree
    rows = {tree.topLevelItem(k).child(n).data(0, 0x100)
            for k in range(tree.topLevelItemCount()) for n in range(tree.topLevelItem(k).childCount())}  # fmt: skip
    assert {(i.object, i.number) for i in session.annotation.tracks.values()} <= {tuple(row) for row in rows}
    assert f"{len(owners)} new" in said[-1]
    session.undo()
    assert session.objects() == []


def test_an_export_is_chosen_in_a_dialog_and_comes_back_whole(workspace, qtbot, monkeypatch, tmp_path):
    choose_all(workspace)
    place_points(workspace)
    fill(workspace)
    session, said = workspace.session, []
    session.said.connect(said.append)
    last = max(session.annotation.tracks)
    session.do(edit_tracks.update_track(session.annotation, last, name="tip", review="rejected"))
    offered = []

    def name(_parent, _title, start, _kind):
        offered.append(start)
        return str(tmp_path / "out.npz"), ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", name)
    dialog = take_tracks.ExportDialog(session, workspace)
    dialog.format.setCurrentIndex(dialog.format.findText("SLEAP", Qt.MatchFlag.MatchStartsWith))
    total = len(session.annotation.tracks)
    assert [dialog.which.itemText(k)[-3:] for k in range(3)] == [f"({n})" for n in (total - 1, total, 0)]
    take_tracks._choose_file(workspace, dialog)
    target = tmp_path / "out.analysis.h5"
    qtbot.waitUntil(lambda: any(str(target) in text for text in said), timeout=60_000)
    assert target.exists()
    assert not (tmp_path / "out.npz").exists()
    assert offered[0].endswith(".analysis.h5")
    assert "1 left out" in next(text for text in said if str(target) in text)
    dialog.format.setCurrentIndex(0)
    dialog.which.setCurrentIndex(1)
    take_tracks._choose_file(workspace, dialog)
    qtbot.waitUntil((tmp_path / "out.npz").exists, timeout=60_000)
    sheet = track_npz.read(tmp_path / "out.npz")
    assert len(sheet.numbers) == total
    assert sheet.frame_names == frame_names(session.project.info.path)
    assert np.allclose(sheet.seconds, session.project.info.seconds)
    before = {i.id: [a.copy() for a in session.annotation.track(i.id).arrays()[:5]]
              for i in session.annotation.tracks.values()}  # fmt: skip
    for track in list(session.annotation.tracks):
        session.do(edit_tracks.delete_track(session.annotation, track))
    take_tracks.take_file(workspace, tmp_path / "out.npz")
    qtbot.waitUntil(lambda: bool(session.annotation.tracks), timeout=60_000)
    for old, new in zip(before.values(), session.annotation.tracks, strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(old, session.annotation.track(new).arrays()[:5], strict=True))
    assert [i.name for i in session.annotation.tracks.values()][-1] == "tip"


def test_a_pickle_needs_consent_and_one_of_its_videos_is_chosen(workspace, qtbot, monkeypatch, tmp_path):
    session = workspace.session
    frames = session.annotation.frames
    video = {"points": np.full((1, frames, 2), 0.5, np.float32), "occluded": np.zeros((1, frames), bool)}
    (tmp_path / "davis.pkl").write_bytes(pickle.dumps({"a b": video, "a/b": video | {"points": video["points"] / 2}}))
    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.StandardButton.No)
    take_tracks.take_file(workspace, tmp_path / "davis.pkl")
    assert not workspace.work.tasks.busy
    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.StandardButton.Yes)
    asked = []

    def choose(_parent, _title, _label, names, first, _editable):
        asked.append((names, first))
        return names[1], True

    monkeypatch.setattr(QInputDialog, "getItem", choose)
    take_tracks.take_file(workspace, tmp_path / "davis.pkl")
    qtbot.waitUntil(lambda: bool(session.annotation.tracks), timeout=60_000)
    assert asked == [(["a_b", "a_b_2"], 0)]
    width, height = session.annotation.size
    assert session.annotation.track(1).xy[0].tolist() == [width / 4, height / 4]


def test_a_file_is_known_by_what_is_in_it(tmp_path):
    sheet = TrackSheet.of_tracks(PointTracks(np.ones((1, 2, 2), np.float32), np.ones((1, 2), np.uint8), np.array([1]),
                                             (9, 9)))  # fmt: skip
    for form in track_files.FORMATS:
        path = tmp_path / f"{form.name}.{form.ending}"
        form.write(sheet, path)
        assert track_files.told_apart(path).ending == form.ending
        assert np.allclose(form.read(path, (9, 9), 2).tracks.xy, 1.0)
        assert track_files.named(tmp_path / f"x.{track_files.FORMATS[0].ending}", form).name == f"x.{form.ending}"
