"""Why a worker is gone, in words a person can act on.

Evidence, strongest first: the report the worker left (`exit.json`), the exit code (where the window is its parent),
the trace of the fault handler (`fault.log`), the memory of its last heartbeats.
"""

from __future__ import annotations

import signal
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from genmojo_studio import translate
from genmojo_studio.translate import mark, told, tr
from genmojo_studio.worker import runs

Kind = Literal["input", "exception", "memory", "killed", "segfault", "hang", "start", "version"]
_SHORT_OF_MEMORY = 0.08  # share of the machine's memory that was left at the last heartbeat
_TAIL = 4000  # characters of a log


@dataclass(frozen=True)
class DeathReport:
    """What happened to a worker.

    Args:
        kind: class of the end. title: one sentence. advice: what to do, plain words. detail: trace or log, may be "".
        step: last step it told of. checkpoint: the run can be resumed. final: False while it may come back (hang).
        run_dir: its folder.
    """

    kind: Kind
    title: str
    advice: str
    detail: str = ""
    step: int = 0
    checkpoint: bool = False
    final: bool = True
    run_dir: str = ""


ADVICE: dict[Kind, str] = {
    "input": mark("Correct this and start again."),
    "exception": mark("This is a fault of the program; please report it with the details."),
    "memory": mark("Close other programs, or choose a smaller size, fewer Gaussians per object or the draft preset."),
    "killed": mark("Another program or the system ended it; if nobody did so on purpose, memory may have run out."),
    "segfault": mark("This is a fault in compiled code; please report it with the details."),
    "hang": mark("Wait if the machine was asleep or very busy; else end it and resume from the last checkpoint."),
    "start": mark("Look at the details; reinstalling the program may help."),
    "version": mark("Let the run finish or end it, then start it again with this version of the program."),
}


def classify(
    run_dir: str | Path, exit_code: int | None, beat: Mapping[str, Any], started: bool, pid: int | None
) -> DeathReport:
    """The report on a worker that has ended without finishing.

    Args:
        exit_code: as `Popen.returncode` (negative: signal), None where the window is not its parent.
        beat: its last heartbeat ({} if none came). started: it ever said hello; one that took the run's lock and ended
            before a window could listen had started too. pid: of the worker, None if unknown.
    """
    folder = Path(run_dir)
    left = runs.read_json(folder / runs.EXIT)
    if pid is not None and left.get("pid") != pid:
        left = {}
    fault = _tail(folder / runs.FAULT)
    log = _tail(folder / runs.LOG)
    if left.get("kind") in ("input", "exception", "memory"):
        detail = str(left.get("detail", ""))
        return _report(left["kind"], translate.fault(str(left.get("title", ""))), detail, folder, beat)
    crashed = _signal(exit_code) in ("SIGSEGV", "SIGBUS", "SIGILL", "SIGFPE", "SIGABRT")
    windows_fault = exit_code in (0xC0000005, -1073741819)
    if crashed or windows_fault or "Fatal Python error" in fault:
        name = _signal(exit_code) or tr("an access violation")
        title = tr("The optimiser crashed in compiled code ({name}).").format(name=name)
        return _report("segfault", title, fault or log, folder, beat)
    if _memory_was_short(beat):
        rss = float(beat.get("rss_mb", 0)) / 1024
        title = tr("The system ended the optimiser when memory ran out; it used {gb:.1f} GB.").format(gb=rss)
        return _report("memory", title, log, folder, beat)
    if exit_code in (None, 0) or exit_code < 0:
        name = _signal(exit_code)
        by = tr("The optimiser was ended from outside by {name}.").format(name=name)
        return _report("killed", by if name else tr("The optimiser was ended from outside."), log, folder, beat)
    if not started and (pid is None or runs.read_json(folder / runs.LOCK).get("pid") != pid):
        title = tr("The optimiser could not start (exit code {code}).").format(code=exit_code)
        return _report("start", title, log, folder, beat)
    title = tr("The optimiser ended with exit code {code}.").format(code=exit_code)
    return _report("exception", title, fault or log, folder, beat)


def hung(run_dir: str | Path, beat: Mapping[str, Any], silent: float, phase: str) -> DeathReport:
    """The report on a worker that gives no sign of life; `silent`: seconds without heartbeat or without progress."""
    title = tr("The optimiser has not answered for {seconds:.0f} s.")
    if phase:
        title = tr("The optimiser has not answered for {seconds:.0f} s while {phase}.")
    title = title.format(seconds=silent, phase=told(phase))
    report = _report("hang", title, "", Path(run_dir), beat)
    return DeathReport(**{**report.__dict__, "final": False})


def _report(kind: Kind, title: str, detail: str, folder: Path, beat: Mapping[str, Any]) -> DeathReport:
    """With the advice of its kind and what can be resumed."""
    resumable = (folder / "checkpoint.json").is_file()
    step = max(int(beat.get("step", 0)), runs.steps_told(runs.read_events(folder)))  # a heartbeat is up to 1 s old
    advice = tr(ADVICE[kind])
    if resumable and kind != "hang":
        advice += " " + tr("The run can be resumed from its last checkpoint.")
    return DeathReport(kind, title, advice, detail, step, resumable, True, str(folder))


def _memory_was_short(beat: Mapping[str, Any]) -> bool:
    total = float(beat.get("total_mb", 0))
    return total > 0 and float(beat.get("available_mb", total)) < _SHORT_OF_MEMORY * total


def _signal(exit_code: int | None) -> str:
    """ "SIGKILL" for -9; "" for anything that is no signal."""
    if exit_code is None or exit_code >= 0:
        return ""
    try:
        return signal.Signals(-exit_code).name
    except ValueError:
        return f"signal {-exit_code}"


def _tail(path: Path) -> str:
    """The end of a text file, "" where there is none."""
    try:
        return path.read_text("utf-8", "replace")[-_TAIL:].strip()
    except OSError:
        return ""
