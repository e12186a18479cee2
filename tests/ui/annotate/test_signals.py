"""Why a place is suspicious: the nine signals as bars beside the curves; the seed stays as a second opinion."""

import numpy as np
from annotating import choose_all, place_points, refine

from genmojo_core.tracks import suspicion
from genmojo_core.tracks.suspicion import SIGNALS


def test_bars_tell_the_nine_signals_of_the_point_in_the_frame(workspace, qtbot):
    refine(workspace, 4)
    session = workspace.session
    cells = session.annotation.cells(session.track, np.array([5]))
    cells.xy[:] += 30.0
    session.annotation.write_cells(session.track, np.array([5]), cells)
    session.suspicions = suspicion.assess(session.annotation)
    session.go(5)
    workspace.play.tabs.setCurrentIndex(1)
    bars = workspace.play.graphs.bars
    rows = bars.rows()
    assert len(rows) == len(SIGNALS) + 1
    assert dict(rows)["sudden motion"] > 0.5
    assert rows[-1][1] >= max(value for _, value in rows[:-1])
    assert "sudden motion" in bars.accessibleName()
    before = bars.grab().toImage()
    session.go(15)
    assert dict(bars.rows())["sudden motion"] < 0.3
    assert bars.grab().toImage() != before
    qtbot.wait(50)


def test_the_seed_is_kept_as_the_opinion_that_later_solutions_are_held_to(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=2)
    session, tracker = workspace.session, workspace.work.tracker
    tracker.seed([session.active[0]])
    qtbot.waitUntil(lambda: session.project.history()[-1].kind == "seed", timeout=120_000)
    tracks = [i.id for i in session.annotation.tracks_of(session.active[0])]
    for track in tracks:
        kept = session.annotation.proposals[track]["optical"]
        assert (kept.state > 0).all()
        assert session.project.blob(f"proposal:{track}:optical")
