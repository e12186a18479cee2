"""A second program follows what the first does, knows who that is, and takes over once it has left."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import annotations
import numpy as np
import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_db, project_file, project_news
from genmojo_core.store.project import Project, info_of
from genmojo_core.store.project_db import Holder
from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.annotation import ObjectInfo, Proposal
from genmojo_core.tracks.model import VISIBLE


def both(tmp_path: Path) -> tuple[Project, Project]:
    writer = Project.create(tmp_path / "p.genmojo", info_of(24, annotations.SIZE, "demo"), person="Ada")
    writer.do(edit_tracks.put_objects(writer.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    writer.wait()
    return writer, Project.open(tmp_path / "p.genmojo", person="Bob")


def catch_up(writer: Project, reader: Project) -> None:
    writer.wait()
    news = project_news.read(reader.path, len(reader.log), reader.log.chain)
    assert news is not None
    reader.follow(news)


@pytest.mark.parametrize("seed", range(3))
def test_a_reader_follows_edits_undo_and_jumps(tmp_path: Path, seed: int) -> None:
    writer, reader = both(tmp_path)
    rng = np.random.default_rng(seed)
    for _ in range(8):
        for _ in range(12):
            action = rng.integers(8)
            if action == 0 and writer.log.head > 1:  # the object stays
                writer.undo()
            elif action == 1:
                writer.redo()
            elif action == 2:
                writer.go_to(int(rng.choice([r.seq for r in writer.history()])))
            elif action == 3:
                writer.checkpoint("here")
            else:
                writer.do(annotations.random_edit(writer.annotation, rng))
        catch_up(writer, reader)
        assert reader.annotation.digest() == writer.annotation.digest()
        assert (reader.log.rows, reader.log.head, reader.log.chain) == (
            writer.log.rows, writer.log.head, writer.log.chain)  # fmt: skip
    assert project_news.read(reader.path, len(reader.log), reader.log.chain) is None
    writer.close()
    reader.close()


def test_the_writer_is_named_and_only_a_change_changes_the_stamp(tmp_path: Path) -> None:
    writer, reader = both(tmp_path)
    assert reader.read_only and not reader.take_over()
    assert project_db.holder(reader.path) == Holder("Ada", os.getpid(), socket.gethostname())
    before = project_news.stamp(reader.path)
    assert project_news.read(reader.path, len(reader.log), reader.log.chain) is None
    assert project_db.take_lock(reader.path, None) is None
    assert project_news.stamp(reader.path) == before
    writer.do(edit_tracks.add_track(writer.annotation, 1, 1))
    writer.wait()
    assert project_news.stamp(reader.path) != before
    writer.close()
    reader.close()


def test_writing_is_taken_over_with_what_was_written_last(tmp_path: Path) -> None:
    writer, reader = both(tmp_path)
    writer.do(edit_tracks.add_track(writer.annotation, 1, 1))
    writer.close()
    assert reader.take_over() and not reader.read_only
    assert len(reader.annotation.tracks) == 1
    assert project_db.holder(reader.path) == Holder("Bob", os.getpid(), socket.gethostname())
    assert reader.do(edit_tracks.add_track(reader.annotation, 1, 2)) is not None
    reader.undo()
    reader.redo()
    digest = reader.annotation.digest()
    third = Project.open(reader.path)
    assert third.read_only
    third.close()
    reader.close()
    assert project_file.verify(reader.path) == []
    again = Project.open(reader.path)
    assert again.annotation.digest() == digest
    again.close()


def test_proposals_that_no_edit_tells_of_are_taken_over(tmp_path: Path) -> None:
    writer, reader = both(tmp_path)
    writer.do(edit_tracks.add_track(writer.annotation, 1, 1))
    (track,) = writer.annotation.tracks
    catch_up(writer, reader)
    xy = np.full((24, 2), 7.0, np.float32)
    writer.propose(track, Proposal("scene", xy, np.full(24, VISIBLE, np.uint8), np.full(24, 0.5, np.float32)))
    writer.close()
    assert track not in reader.annotation.proposals
    assert reader.take_over()
    assert (reader.annotation.proposals[track]["scene"].xy == 7.0).all()
    reader.close()


def test_another_history_in_the_same_place_is_not_followed(tmp_path: Path) -> None:
    writer, reader = both(tmp_path)
    writer.close()
    other = Project.create(tmp_path / "other.genmojo", info_of(24, annotations.SIZE, "demo"))
    other.do(edit_tracks.put_objects(other.annotation, [ObjectInfo(1, "cat", 1, "chosen")]))
    other.do(edit_tracks.add_track(other.annotation, 1, 1))
    other.close()
    os.replace(other.path, reader.path)
    with pytest.raises(GenmojoError, match="another history"):
        project_news.read(reader.path, len(reader.log), reader.log.chain)
    with pytest.raises(GenmojoError):
        reader.take_over()
    assert reader.read_only
    reader.close()


def test_a_lock_of_an_older_program_names_nobody(tmp_path: Path) -> None:
    path = tmp_path / "p.genmojo"
    assert project_db.holder(path) is None
    path.with_name("p.genmojo.lock").write_bytes(b"")
    assert project_db.holder(path) is None
