"""Every state there ever was can be reached, also from a branch that redo does not lead to, and after a restart."""

from __future__ import annotations

from pathlib import Path

import annotations
import numpy as np
import pytest

from genmojo_core.store import project_file, project_news
from genmojo_core.store.history_tree import History
from genmojo_core.store.project import Project, info_of
from genmojo_core.store.project_log import ROOT
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import ObjectInfo, Touched


def begun(path: Path) -> Project:
    project = Project.create(path, info_of(24, annotations.SIZE, "demo"), person="Ada")
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    project.do(edit_tracks.add_track(project.annotation, 1, 1))
    return project


def key(project: Project, frame: int) -> int:
    project.do(keys.set_key(project.annotation, 1, frame, (float(frame), 20.0)))
    return project.log.head


def test_a_branch_that_was_left_is_listed_and_can_be_gone_to(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    fork = project.log.head
    left = key(project, 5)
    digest = project.annotation.digest()
    project.undo()
    now = key(project, 9)
    history = History(project.log)
    assert history.line(ROOT)[-1] == now and left not in history.line(ROOT)
    assert history.branches(fork, set(history.line(ROOT))) == [left]
    assert history.states[left].ahead and not history.states[now].ahead and history.before_jump is None
    project.go_to(left)
    assert project.annotation.digest() == digest
    assert History(project.log).before_jump == now
    project.close()
    project = Project.open(tmp_path / "p.genmojo")
    history = History(project.log)
    assert history.head == left and history.line(ROOT)[-1] == left and history.before_jump == now
    assert project_file.verify(project.path) == []
    project.close()


def test_an_answer_of_a_machine_belongs_to_its_deed_but_not_past_a_name(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    rng = np.random.default_rng(0)
    step = project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    project.do(annotations.solution(project.annotation, 1, np.arange(24), rng), step=step)
    history = History(project.log)
    assert len(history.states) == 4
    assert history.states[history.head].row is not None and history.states[history.head].row.frame == 5
    step = project.do(keys.set_key(project.annotation, 1, 9, (10.0, 20.0)))
    project.checkpoint("between")
    project.do(annotations.solution(project.annotation, 1, np.arange(24), rng), step=step)
    history = History(project.log)
    assert len(history.states) == 6 and [s.names for s in history.states.values() if s.names] == [("between",)]
    project.close()


def test_listeners_are_told_once_of_a_long_way_and_of_all_that_changed_on_it(tmp_path: Path) -> None:
    """A window paints after every word of a change: told of each edit it stood still for seconds."""
    project = begun(tmp_path / "p.genmojo")
    first = project.log.head
    reader = Project.open(tmp_path / "p.genmojo", person="Bob")
    told: list[tuple[set[int], int, int, str]] = []
    followed: list[Touched] = []
    project.annotation.listeners.append(
        lambda t: told.append((set(t.tracks), t.first, t.last, project.annotation.digest()))
    )
    reader.annotation.listeners.append(followed.append)
    before = project.annotation.digest()
    for frame in (5, 9, 14):
        key(project, frame)
    project.do(edit_tracks.add_track(project.annotation, 1, 2))
    last, after = project.log.head, project.annotation.digest()
    told.clear()
    project.go_to(first)
    project.go_to(last)
    assert told == [({1, 2}, 5, 14, before), ({1, 2}, 5, 14, after)]
    project.wait()
    news = project_news.read(reader.path, len(reader.log), reader.log.chain)
    assert news is not None
    reader.follow(news)
    assert len(followed) == 1 and followed[0].tracks == {1, 2} and (followed[0].first, followed[0].last) == (5, 14)
    assert reader.annotation.digest() == after
    project.close()


@pytest.mark.parametrize("seed", range(3))
def test_every_state_of_a_random_history_is_reached_from_every_other(tmp_path: Path, seed: int) -> None:
    project = begun(tmp_path / "p.genmojo")
    rng = np.random.default_rng(seed)
    first = project.log.head
    digests = {first: project.annotation.digest()}
    for _ in range(60):
        if rng.random() < 0.3:
            states = [seq for seq in History(project.log).states if seq >= first]
            project.go_to(states[rng.integers(len(states))])
        project.do(annotations.random_edit(project.annotation, rng))
        digests[project.log.head] = project.annotation.digest()
    history = History(project.log)
    assert set(digests) <= set(history.states)
    for seq in rng.permutation(list(digests)):
        project.go_to(int(seq))
        assert project.annotation.digest() == digests[int(seq)]
    listed, waiting = set(), [history.line(ROOT)]
    while waiting:
        line = waiting.pop()
        listed |= set(line)
        waiting += [history.line(b, branch=True) for seq in line for b in history.branches(seq, set(line))]
    assert listed == set(history.states)
    project.close()
