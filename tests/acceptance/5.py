"""Issue 5, "Shown by": the annotator's figures, each row measured by programs of their own.

    xvfb-run -s "-screen 0 1920x1080x24" python tests/acceptance/5.py --work DIR [--only data-cross-optical] [--again]

Results are kept in DIR/results, so an interrupted run goes on where it stopped; --again measures anew. Scenes for the
`scene` seeds are DIR/CLIP.h5; the first row that needs one makes it (`standard`, minutes). The rows of the widgets need
a display and leave screenshots of the four steps in DIR. Three seeds in the rows of the annotators, one elsewhere.
"""

from __future__ import annotations

import json
import re
import shutil
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from table import ROOT, Bench, Check, Rows, main

sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

import injected_errors  # noqa: E402
import simulated_annotator  # noqa: E402

from genmojo_core.store.npz import write_tracks  # noqa: E402
from genmojo_core.trackers.evidence import scene_of  # noqa: E402
from genmojo_core.trackers.seeding import SceneSeeder  # noqa: E402
from genmojo_core.trackers.solver import SolveRequest, TrackSolver  # noqa: E402
from genmojo_core.tracks.supervision import said_by_people  # noqa: E402
from genmojo_core.tracks.suspicion import assess, queue  # noqa: E402

CLIPS, SEEDS = ("blender-cross", "blender-trio"), ("optical", "scene")


def scene(bench: Bench, clip: str) -> Path:
    """The clip's optimised scene, made if it is not there."""
    return _optimised(bench, clip, bench.work / f"{clip}.h5")


def _optimised(bench: Bench, clip: str, path: Path, *more: str) -> Path:
    """A scene, unless it is there; where a run was interrupted it goes on."""
    run = path.with_suffix(".run")
    if not path.exists():
        again = ["--resume"] if any(run.glob("*checkpoint*")) else []
        source = str(bench.data / clip)
        bench.python("-m", "genmojo_core.cli.main", "optimize", source, "-o", str(path), "--run-dir", str(run), *again,
                     *more)  # fmt: skip
    return path


def data(bench: Bench, name: str, seeds: str) -> list[Check]:
    """The simulated annotator without a window, frames held as the app holds them; three seeds, all tracks together."""
    clip, truth = simulated_annotator.full_hd(bench.data / name), simulated_annotator.truth_of(bench.data / name)
    seeder = SceneSeeder(scene(bench, name)) if seeds == "scene" else None
    reports = [simulated_annotator.Person(clip, truth, seeder, seed).run() for seed in range(3)]
    keys, errors, seconds = (np.concatenate([getattr(r, name) for r in reports])
                             for name in ("keys", "errors", "solve_seconds"))  # fmt: skip
    right = float(np.mean([r.right_states for r in reports]))
    checks = _goals(float(np.median(keys)), float(np.median(errors)), right, float(np.median(seconds)))
    return [*checks, *(Check(f"keys, seed {seed}", float(np.median(r.keys))) for seed, r in enumerate(reports))]


def widgets(bench: Bench, name: str, seeds: str) -> list[Check]:
    """The scripted annotator at the real widgets at 1920 x 1080; three seeds, all tracks together."""
    more = ["--scene", str(scene(bench, name))] if seeds == "scene" else []
    runs = [_driven(bench, name, f"{name}-{seeds}", [*more, "--seed", str(seed)]) for seed in range(3)]
    keys, errors = (np.concatenate([run[part] for run in runs]) for part in ("keys_per_track", "errors"))
    right, solved, waited, seconds = (float(np.mean([run[part] for run in runs]))
                                      for part in ("oa", "solve_seconds", "solve_wait", "seconds"))  # fmt: skip
    checks = _goals(float(np.median(keys)), float(np.median(errors)), right, solved)
    return [*checks, Check("solved after s", waited), Check("p90 px", float(np.quantile(errors, 0.9))),
            Check("seconds in all", seconds),
            *(Check(f"seed {seed}: {part}", run[part]) for part in ("keys", "error", "oa")
              for seed, run in enumerate(runs))]  # fmt: skip


def walk(bench: Bench) -> list[Check]:
    """gold-fish has no truth: keys, seconds and screenshots only."""
    found = _driven(bench, "gold-fish", "gold-fish", [])
    return [
        Check("tracks", found["tracks"]),
        Check("keys per track", found["keys"]),
        Check("frames accepted with Enter", found["enters"]),
        Check("seconds in all", found["seconds"]),
    ]


def _driven(bench: Bench, name: str, shots: str, more: list[str]) -> dict:
    home = str(bench.work / "home")
    said = bench.python("tests/acceptance/annotator_driver.py", str(bench.data / name), "--shots",
                        str(bench.work / shots), *more, XDG_CONFIG_HOME=home, XDG_DATA_HOME=home)  # fmt: skip
    return json.loads(said.strip().splitlines()[-1])


def _goals(keys: float, error: float, right: float, seconds: float) -> list[Check]:
    return [
        Check("keys per track", keys, 6, at_most=True),
        Check("error px", error, 1.5, at_most=True),
        Check("OA %", 100 * right, 95),
        Check("solve CPU s", seconds, 0.7, at_most=True),
    ]


def suspicion(bench: Bench) -> list[Check]:
    """Share of injected errors in the first fifth of the queue, six random sets per clip."""
    return [Check(f"{name} % in the first fifth", 100 * _found(bench, name), 90) for name in CLIPS]


def _found(bench: Bench, name: str) -> float:
    clip, truth = simulated_annotator.full_hd(bench.data / name, 270), simulated_annotator.truth_of(bench.data / name)
    solver, shares = TrackSolver(clip), []
    for seed in range(6):
        rng = np.random.default_rng(seed)
        annotation = injected_errors.annotated(truth, rng, points=12)
        errors = injected_errors.inject(annotation, rng, 8)
        evidence = {}
        for owner in annotation.chosen_objects():
            evidence |= solver.evidence(SolveRequest.of(annotation, owner.id))
        spots = queue(annotation, assess(annotation, scene_of(clip), evidence))
        shares.append(injected_errors.found_share(spots, errors)[0])
    return float(np.mean(shares))


def frame_step(bench: Bench) -> list[Check]:
    """From the key to a painted frame at 1080p."""
    said = bench.python("tests/benchmarks/frame_step.py", XDG_CONFIG_HOME=str(bench.work / "home"))
    wall = dict(re.findall(r"^(.*?) +wall p50 +[\d.]+ p95 +([\d.]+) ms", said, re.M))
    ratio = float(re.findall(r"ratio of medians \(CPU\): ([\d.]+)", said)[-1])
    return [
        Check("cached p95 ms", float(wall["25 tracks, cached"]), 16, at_most=True),
        Check("uncached p95 ms", float(wall["25 tracks, uncached"]), 33, at_most=True),
        Check("5,000 tracks x 10,000 frames, times", ratio, 1.10, at_most=True),
    ]


def acknowledgement(bench: Bench) -> list[Check]:
    """From an edit in the window to the word that it is on the disk."""
    said = bench.python("tests/benchmarks/acknowledgement.py", XDG_CONFIG_HOME=str(bench.work / "home"))
    made, told, late = (float(v) for v in re.findall(r"(\d+) edits, (\d+) acknowledged: .* p99 ([\d.]+)", said)[-1])
    return [Check("p99 ms", late, 200, at_most=True), Check("edits never acknowledged", made - told, 0, at_most=True)]


def loop(bench: Bench, name: str) -> list[Check]:
    """What a person said goes into the optimiser (as "Solve from scene" hands it over): the scene's tracks profit."""
    source = bench.data / name
    person = simulated_annotator.Person(simulated_annotator.full_hd(source), simulated_annotator.truth_of(source))
    person.run()
    said = said_by_people(person.annotation)
    if said is None:
        raise RuntimeError("the simulated annotator placed nothing")
    given = bench.work / f"{name}.said.npz"
    write_tracks(said, given)
    found = {}
    for title, more in (("without", []), ("with", ["--tracks", str(given)])):
        path = _optimised(
            bench,
            name,
            bench.work / f"loop-{title}.h5",
            "--preset",
            "draft",
            "--budget",
            "600s",
            "--ignore",
            "tracks",
            *more,
        )
        scores = bench.python("-m", "genmojo_core.cli.main", "evaluate", str(path), str(source), "--json")
        found[title] = json.loads(scores)
    for title in found:
        (bench.work / f"loop-{title}.h5").unlink()  # done: another time it is measured anew
        shutil.rmtree(bench.work / f"loop-{title}.run", ignore_errors=True)
    checks = [Check(f"{key} {title}", found[title][key]) for key in ("ate", "oa") for title in found]
    return [*checks, Check("ate with / without", found["with"]["ate"] / found["without"]["ate"], 1.0, at_most=True)]


def tests(bench: Bench, expected: int, *what: str) -> list[Check]:
    """Tests that check a promise at its full size."""
    said = bench.python("-m", "pytest", "-q", *what, ends=(0, 1))
    passed, failed = (re.findall(rf"(\d+) {word}", said) for word in ("passed", "failed"))
    return [Check("passed", float(passed[-1]) if passed else 0.0, expected),
            Check("failed", float(failed[-1]) if failed else 0.0, 0, at_most=True)]  # fmt: skip


def _annotators() -> Rows:
    made: Rows = {}
    kinds: tuple[tuple[str, Callable, str], ...] = (("data", data, "without a window"), ("widgets", widgets, "widgets"))
    for kind, row, title in kinds:
        for clip in CLIPS:
            for seeds in SEEDS:
                key = f"{kind}-{clip.split('-')[1]}-{seeds}"
                made[key] = (f"{clip}, {seeds} seeds, {title}", partial(row, name=clip, seeds=seeds))
    return made


ROWS: Rows = {
    **_annotators(),
    "gold-fish": ("gold-fish, widgets", walk),
    "queue": ("injected errors", suspicion),
    "frame-step": ("frame steps", frame_step),
    "acknowledgement": ("an edit is on the disk", acknowledgement),
    **{f"loop-{clip.split('-')[1]}": (f"{clip}, draft, with and without what a person said", partial(loop, name=clip))
       for clip in CLIPS},
    "seeks": ("10,000 random seeks, ten files", lambda b: tests(b, 10, "tests/clip/test_random_frames.py", "-k",
                                                                "ten_thousand")),
    "kills": ("200 kill -9", lambda b: tests(b, 1, "tests/store/test_project_crash.py", "-k", "two_hundred")),
    "histories": ("50 x 1,000 edits undone and redone", lambda b: tests(b, 50, "tests/store/test_project.py", "-m",
                                                                        "slow")),
    "keyboard": ("every control by keyboard, seen to have it", lambda b: tests(b, 12,
                                                                               "tests/ui/annotate/test_keyboard.py")),
    "mean-user": ("keys at random, files gone, read only, closed meanwhile", lambda b: tests(
        b, 18, "tests/ui/annotate/test_mean_user.py")),
    "seed-dialog": ("CoTracker stand-in, Solve from scene", lambda b: tests(b, 4,
                                                                            "tests/ui/annotate/test_seed_dialog.py")),
}  # fmt: skip


if __name__ == "__main__":
    sys.exit(main(ROWS, __doc__, "5"))
