"""Memory of this process and this machine, without a further package."""

from __future__ import annotations

import os
import sys
from pathlib import Path

_MB = 1 << 20


def memory() -> dict[str, float]:
    """rss_mb and peak_mb of this process, available_mb and total_mb of the machine or container; 0 where unknown."""
    rss = peak = available = total = 0.0
    status = _table(Path("/proc/self/status"))
    if status:
        rss, peak = status.get("VmRSS", 0) / 1024, status.get("VmHWM", 0) / 1024
        machine = _table(Path("/proc/meminfo"))
        total, available = machine.get("MemTotal", 0) / 1024, machine.get("MemAvailable", 0) / 1024
        limit = _number(Path("/sys/fs/cgroup/memory.max"))
        used = _number(Path("/sys/fs/cgroup/memory.current"))
        if limit and used and limit / _MB < total:
            cached = _cached(Path("/sys/fs/cgroup/memory.stat"))
            total, available = limit / _MB, min(available, (limit - used + cached) / _MB)
    elif sys.platform != "win32":
        import resource

        unit = 1 if sys.platform == "darwin" else 1024
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / _MB
        rss = peak
        total = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / _MB
        available = total
    return {"rss_mb": rss, "peak_mb": peak, "available_mb": available, "total_mb": total}


def _table(path: Path) -> dict[str, float]:
    """ "Name:  123 kB" lines as numbers."""
    try:
        lines = path.read_text().splitlines()
    except OSError:
        return {}
    rows = {}
    for line in lines:
        name, _, rest = line.partition(":")
        words = rest.split()
        if len(words) == 2 and words[0].isdigit():
            rows[name] = float(words[0])
    return rows


def _number(path: Path) -> float:
    try:
        text = path.read_text().strip()
    except OSError:
        return 0.0
    return float(text) if text.isdigit() else 0.0


def _cached(path: Path) -> float:
    """Bytes of files in memory, which the kernel gives back when asked."""
    try:
        rows = dict(line.split() for line in path.read_text().splitlines())
    except (OSError, ValueError):
        return 0.0
    return float(rows.get("inactive_file", 0))
