"""Issue 4, "Shown by": the window's and the worker's figures, each row measured by programs of their own.

    python tests/acceptance/4.py --work DIR [--only fidelity,frames] [--again] [--data ../shared/data]

Results are kept in DIR/results, so an interrupted table goes on where it stopped; --again measures anew. Screenshots of
the driven windows lie in DIR/xcb_glx and DIR/xcb_egl and are for people to look at. Windows need Xvfb (or a screen);
milliseconds are wall time and say something on free cores only, so the load average stands beside them.
"""

from __future__ import annotations

import json
import re
import sys

from table import ROOT, Bench, Check, Rows, main

SCREEN = "-screen 0 1920x1080x24"
WAYS = ("xcb_glx", "xcb_egl")


def fidelity(bench: Bench) -> list[Check]:
    """The GL renderer against float64 and the optimiser's rasteriser; angles to a camera and back."""
    found = json.loads(bench.python("-m", "tests.benchmarks.splat_fidelity"))
    return [
        Check("against float64 dB", found["float64_db"], 60),
        Check("against the rasteriser dB", found["rasteriser_db"], 45),
        Check("round trip degrees", found["round_trip_degrees"], 1e-6, at_most=True),
    ]


def frames(bench: Bench) -> list[Check]:
    """Milliseconds of a frame at three sizes, on this machine's OpenGL and by the processor's kernels."""
    checks = []
    for line in bench.python("-m", "tests.benchmarks.splat_view").splitlines():
        row = json.loads(line)
        name = f"{row['engine']} {row['gaussians'] // 1000}k"
        limit = 100.0 if row["engine"] == "cpu" else None
        checks += [Check(f"{name} full ms", row["full_ms"]), Check("moving ms", row["moving_ms"], limit, at_most=True)]
    return checks


def surfaces(bench: Bench) -> list[Check]:
    """Windows on GLX and EGL: 50 times out of the dock and back, 5,000 previews."""
    checks = []
    for way in WAYS:
        docks = _window(bench, way, "docks", "50")
        previews = _window(bench, way, "previews", "5000")
        checks += [
            Check(f"{way} black pictures", docks["black"], 0, at_most=True),
            Check("docks MB more", docks["growth_mb"], 12, at_most=True),
            Check("previews MB more", previews["growth_mb"], 8, at_most=True),
        ]
    return checks


def without(bench: Bench) -> list[Check]:
    """Without OpenGL the view draws by the processor and says so."""
    found = _window(bench, "none", "missing")
    drawn = [found[engine][0] == "CpuView" and found[engine][2] > 100 for engine in ("auto", "gl")]
    return [Check("views that draw", sum(drawn), 2)]


def drive(bench: Bench) -> list[Check]:
    """A person's way from a clip to a turntable in the real window, on GLX and EGL."""
    checks = []
    for way in WAYS:
        found = _driven(bench, way, "job", str(bench.data / "crossing"))
        checks += [
            Check(f"{way} first cloud s", found["first_cloud"], 3, at_most=True),
            Check("longest stall ms", found["longest"], 100, at_most=True),
            Check("a stall of 250 ms on purpose is told as ms", found["on_purpose"], 200),
            Check("torch in the window", float(found["torch"]), 0, at_most=True),
            Check("contributors picked", found["picked"], 1),
            Check("pictures at rest against full detail dB", found["at_rest_db"], 45),
            Check("bytes of film", found["film"], 2000),
        ]
    return checks


def previews(bench: Bench) -> list[Check]:
    """From the worker's publishing to the window's snapshot at 50,000 Gaussians."""
    said = bench.python("tests/benchmarks/preview_bus.py", "--gaussians", "50000")
    numbers = re.findall(r'"p95_ms": *([\d.]+)', said)
    if not numbers:
        raise ValueError(f"the benchmark says no p95: {said[-200:]}")
    return [Check("p95 ms", float(numbers[-1]), 50, at_most=True)]


def overhead(bench: Bench) -> list[Check]:
    """What watching costs a run on a core of its own: the worker, previews, orbiting without end."""
    clip = str(bench.data / "crossing")
    found = json.loads(bench.python("tests/benchmarks/worker_overhead.py", clip).strip().splitlines()[-1])
    orbit = _orbiting(bench, clip)["orbiting_over_off"]
    return [
        *_ratio("worker itself", found["off_over_plain"], 1.03),
        *_ratio("previews", found["live_over_off"], 1.03),
        *_ratio("orbiting, own core", orbit, 1.15),
    ]


def shared(bench: Bench) -> list[Check]:
    """Orbiting where window and optimiser share both cores: the governor keeps the cost and tells it."""
    found = _orbiting(bench, str(bench.data / "crossing"), "--shared")
    told = float(found["view"].get("publish_share") or 0.0) + float(found["told"])
    return [*_ratio("orbiting, shared cores", found["orbiting_over_off"], 1.10), Check("cost it tells %", 100 * told),
            Check("frames a second while orbiting", found["fps"], 8)]  # fmt: skip


def _orbiting(bench: Bench, clip: str, *more: str) -> dict:
    said = bench.run("xvfb-run", "-a", sys.executable, "tests/benchmarks/orbit_overhead.py", clip, *more)
    return json.loads(said.strip().splitlines()[-1])


def _ratio(name: str, found: dict, limit: float) -> list[Check]:
    """Wall time is what counts; CPU time and the interval tell how much of it is the machine's noise."""
    wall, cpu = found["wall"], found["cpu"]
    return [
        Check(f"{name}, wall", wall["ratio"], limit, at_most=True),
        Check("from", wall["low"]),
        Check("to", wall["high"]),
        Check("CPU", cpu["ratio"], limit, at_most=True),
    ]


def stalls(bench: Bench) -> list[Check]:
    """Five minutes of a run, looked at and played with all the time: does the window ever not answer?"""
    found = _driven(bench, "xcb_glx", "stalls", "300", str(bench.data / "crossing"))
    return [
        Check("longest ms", found["longest"], 100, at_most=True),
        Check("of stalls over 100 ms, the most it worked ms", max(found["busy"], default=0), 100, at_most=True),
        Check("a stall of 250 ms on purpose is told as ms", found["on_purpose"], 200),
        Check("minutes", found["seconds"] / 60, 5),
        Check("steps", found["steps"]),
        Check("things done", found["done"]),
    ]


def deaths(bench: Bench) -> list[Check]:
    """Every kind of death of the worker, told and resumed; windows closed and killed."""
    found = json.loads(bench.python("tests/benchmarks/deaths.py").strip().splitlines()[-1])
    said = bench.python("-m", "pytest", "-q", "-m", "not gpu", "tests/worker", "tests/crash", ends=(0, 1))
    passed, failed = (re.findall(rf"(\d+) {word}", said) for word in ("passed", "(?:failed|error)"))
    return [
        Check("deaths told and resumed", sum(kind["deaths"] for kind in found.values()), 80),
        Check("told after s at most", max(kind["longest_s"] for kind in found.values()), 2, at_most=True),
        Check("tests passed", float(passed[-1]) if passed else 0.0, 1),
        Check("failed", float(failed[-1]) if failed else 0.0, 0, at_most=True),
    ]


def _driven(bench: Bench, way: str, what: str, *more: str) -> dict:
    """The answer of tests/system/watching.py, whose screenshots go to DIR/<way>."""
    home = str(bench.work / "home" / way)
    said = bench.run("xvfb-run", "-a", "-s", SCREEN, sys.executable, "tests/system/watching.py", str(bench.work / way),
                     what, *more, QT_XCB_GL_INTEGRATION=way, GENMOJO_RUNS=str(bench.work / "runs"),
                     XDG_CONFIG_HOME=home, XDG_DATA_HOME=home)  # fmt: skip
    return json.loads(said.strip().splitlines()[-1])


def _window(bench: Bench, way: str, *arguments: str) -> dict:
    """The answer of tests/view3d/window_program.py on one of Qt's ways to OpenGL."""
    paths = f"{ROOT}:{ROOT / 'tests'}"
    said = bench.run("xvfb-run", "-a", "-s", SCREEN, sys.executable, "tests/view3d/window_program.py", *arguments,
                     QT_XCB_GL_INTEGRATION=way, PYTHONPATH=paths)  # fmt: skip
    found = json.loads(said.strip().splitlines()[-1])
    if "skip" in found:
        raise RuntimeError(found["skip"])
    return found


ROWS: Rows = {
    "fidelity": ("3D view is exact", fidelity),
    "frames": ("frames of the 3D view, 960 x 540", frames),
    "surfaces": ("docks and previews without growth", surfaces),
    "without": ("without OpenGL", without),
    "drive": ("a whole job in the real window", drive),
    "previews": ("publish to window, 50,000 Gaussians", previews),
    "overhead": ("cost of watching, own core", overhead),
    "shared": ("cost of watching, shared cores", shared),
    "stalls": ("five minutes, no stall", stalls),
    "deaths": ("the worker's deaths", deaths),
}


if __name__ == "__main__":
    sys.exit(main(ROWS, __doc__, "4"))
