"""The two commands: make the environment beside the checkout, then run the demo or the tests in it.

    python3 packaging/bootstrap.py demo        installs what is missing, then `genmojo demo`
    python3 packaging/bootstrap.py test        installs what is missing, then the checks and the tests
    python3 packaging/bootstrap.py install     installs only

Standard library only. Run it as often as you like: what is there is kept, an interrupted installation goes on, and a
stamp, written last, says that it is complete. Every failure is one sentence on stderr. Exit codes: 0 done, 2 something
on this machine to put right first, 3 the installation failed, 130 interrupted; otherwise that of the command it ran.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

MIN_PYTHON = (3, 11)
if sys.version_info < MIN_PYTHON:  # before anything that an older Python cannot run
    sys.exit("bootstrap: Python 3.11 or newer is needed, this is %d.%d." % sys.version_info[:2])  # noqa: UP031

MIN_FREE_BYTES = 3_000_000_000  # the smallest build (CPU) with the test tools takes 2.1 GB
TORCH_INDEX = "GENMOJO_TORCH_INDEX"  # environment variable: package index that holds PyTorch's CPU-only builds
GROUPS = {"install": "A", "demo": "A", "test": "AB"}  # groups of packaging/debian-packages.txt that a command needs
CHECKS = (["ruff", "check", "."], ["ruff", "format", "--check", "."], ["mypy"])


class Fault(Exception):  # noqa: N818 - it is told to people, who know faults
    """Something that stops the installation: one sentence and the exit code that goes with it."""

    def __init__(self, sentence: str, code: int = 3) -> None:
        super().__init__(" ".join(sentence.split()))
        self.code = code


class Place(NamedTuple):
    """Where things are: the checkout's root; everything made lies in its .venv folder."""

    root: Path

    @property
    def venv(self) -> Path:
        """Folder of the virtual environment."""
        return self.root / ".venv"

    @property
    def stamp(self) -> Path:
        """File that says what was installed completely."""
        return self.venv / "genmojo-stamp.json"

    @property
    def log(self) -> Path:
        """Everything pip and venv said in the last installation."""
        return self.venv / "bootstrap.log"

    def program(self, name: str) -> str:
        """Path of a program of the environment, e.g. "python"."""
        windows = os.name == "nt"
        return str(self.venv / ("Scripts" if windows else "bin") / (name + (".exe" if windows else "")))


def main(arguments: list[str]) -> int:
    """Run one command; returns the exit code and never raises for a fault of the machine."""
    options, rest = _parse(arguments)
    place = Place(Path(__file__).resolve().parent.parent)
    try:
        if options.system_packages:
            install_debian_packages(place, GROUPS[options.command])
        install(place, wanted_parts(options.command, cpu=options.cpu))
        if options.command == "demo":
            return run([place.program("genmojo"), "demo", *rest], place)
        return test(place, rest) if options.command == "test" else 0
    except Fault as fault:
        say(str(fault))
        return fault.code
    except OSError as error:
        say(os_sentence(error, str(place.venv)))
        return 2
    except KeyboardInterrupt:
        say("interrupted; run the same command again to go on.")
        return 130


def _parse(arguments: list[str]) -> tuple[argparse.Namespace, list[str]]:
    """Options of this script, and what is left for the command it runs."""
    about = (__doc__ or "").split("\n\n")
    parser = argparse.ArgumentParser(prog="bootstrap.py", description=about[0], epilog=about[2])
    parser.add_argument("command", choices=list(GROUPS), help="further arguments go to the demo or to pytest")
    parser.add_argument("--cpu", action="store_true", help=f"CPU-only build of PyTorch (from ${TORCH_INDEX} if set)")
    parser.add_argument("--no-system-packages", dest="system_packages", action="store_false",
                        help="do not look for missing Debian packages")  # fmt: skip
    return parser.parse_known_args(arguments)


def say(sentence: str) -> None:
    """One line on stderr."""
    sys.stderr.write(f"bootstrap: {sentence}\n")
    sys.stderr.flush()


def run(command: list[str], place: Place) -> int:
    """Run a program of the environment in the checkout and return its exit code."""
    try:
        return subprocess.run(command, cwd=place.root, check=False).returncode
    except FileNotFoundError as error:
        raise Fault(f"{command[0]} is missing; delete {place.venv} and run the same command again.") from error


# ---- the tests ------------------------------------------------------------------------------------------------------


def test(place: Place, arguments: list[str]) -> int:
    """Style and type checks (left out when pytest arguments are given), then pytest; 0 when all of them pass."""
    failed = []
    for check in () if arguments else CHECKS:
        say(" ".join(check))
        if run([place.program("python"), "-m", *check], place):
            failed.append(" ".join(check))
    code = run([*virtual_screen(), *pytest_command(place, arguments)], place)
    if failed:
        say(f"these checks failed: {', '.join(failed)}.")
    return code or (1 if failed else 0)


def pytest_command(place: Place, arguments: list[str]) -> list[str]:
    """The quick tests; later options win, so `-m slow` among the arguments replaces the choice."""
    return [place.program("python"), "-m", "pytest", "-m", "not slow and not gpu", *arguments]


def virtual_screen() -> list[str]:
    """Command prefix that gives the tests an X server of their own, where there is one."""
    if shutil.which("xvfb-run") is None:
        return []
    return ["xvfb-run", "-a", "-s", "-screen 0 1920x1080x24"]


# ---- the environment ------------------------------------------------------------------------------------------------


def wanted_parts(command: str, cpu: bool) -> set[str]:
    """What a command needs beside the base: extras of pyproject.toml, and "cpu" for the CPU-only build of PyTorch."""
    parts = {"dev"} if command == "test" else set()
    if cpu:
        parts.add("cpu")
    elif has_nvidia_gpu():
        parts.add("cuda")
    return parts


def has_nvidia_gpu() -> bool:
    """True on Linux when the driver lists a GPU."""
    folder = Path("/proc/driver/nvidia/gpus")
    try:
        return sys.platform.startswith("linux") and any(folder.iterdir())
    except OSError:
        return False


def digest(place: Place) -> str:
    """Changes when an installation is out of date: requirements, Python, or the checkout was moved."""
    parts = [place.root.joinpath(name).read_bytes() for name in ("pyproject.toml", "packaging/constraints.txt")]
    parts.append(repr((sys.version_info[:3], str(place.root))).encode())
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def install(place: Place, wanted: set[str]) -> None:
    """Bring the environment to the wanted parts; what an earlier run installed stays. Does nothing when complete.

    Raises Fault for network, disk and package faults, OSError when the folder cannot be written.
    """
    if place.venv.exists() and not place.venv.is_dir():
        raise Fault(f"{place.venv} is a file, but the environment's folder belongs there; move it away.", 2)
    before = read_stamp(place)
    parts = wanted | set(before["parts"] if before else [])
    if "cpu" in parts:
        parts.discard("cuda")
    new = {"digest": digest(place), "parts": sorted(parts)}
    if before == new and Path(place.program("python")).exists():
        return
    place.stamp.unlink(missing_ok=True)
    make_venv(place)
    say(f"installing into {place.venv}, which takes a few minutes the first time.")
    if "cpu" in parts:
        install_cpu_torch(place)
    extras = ",".join(sorted(parts - {"cpu"}))
    pip(place, ["-c", "packaging/constraints.txt", "-e", f".[{extras}]" if extras else "."])
    partial = place.stamp.with_suffix(".part")
    partial.write_text(json.dumps(new), encoding="utf-8")
    os.replace(partial, place.stamp)


def read_stamp(place: Place) -> dict[str, Any]:
    """What was installed completely; empty when nothing was or the file is damaged."""
    try:
        stamp = json.loads(place.stamp.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp if isinstance(stamp, dict) and isinstance(stamp.get("parts"), list) else {}


def make_venv(place: Place) -> None:
    """Make the virtual environment, or make it anew when it is of another Python or has no working pip."""
    if venv_works(place):
        return
    if not place.venv.exists() and shutil.disk_usage(place.root).free < MIN_FREE_BYTES:
        raise Fault(f"less than {MIN_FREE_BYTES / 1e9:.0f} GB are free on the disk of {place.root}; free some.", 2)
    say(f"making {place.venv}")
    made = subprocess.run([sys.executable, "-m", "venv", "--clear", str(place.venv)], check=False, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip
    if made.returncode:
        raise Fault(pip_sentence(made.stdout, f"python -m venv failed in {place.venv}"), 2)


def venv_works(place: Place) -> bool:
    """True if the environment's Python is of this version and has pip."""
    code = "import sys, pip; sys.exit(sys.version_info[:2] != (%d, %d))" % sys.version_info[:2]  # noqa: UP031
    try:
        probe = subprocess.run([place.program("python"), "-c", code], check=False, capture_output=True, timeout=120)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return probe.returncode == 0


def install_cpu_torch(place: Place) -> None:
    """The CPU-only build: on Linux it has a name of its own and usually an index of its own, elsewhere it is usual."""
    if not sys.platform.startswith("linux"):
        return
    lines = (place.root / "packaging/constraints.txt").read_text(encoding="utf-8").splitlines()
    pinned = next(line.strip() for line in lines if line.startswith("torch=="))
    index = os.environ.get(TORCH_INDEX)
    try:
        pip(place, [f"{pinned}+cpu", *(["--extra-index-url", index] if index else [])])
    except Fault as fault:
        if "no package index" not in str(fault):
            raise
        raise Fault(
            f"no package index that pip knows has the CPU-only build of {pinned}; set {TORCH_INDEX} to the address of "
            "PyTorch's CPU index (its installation page gives it), or leave out --cpu."
        ) from fault


def pip(place: Place, arguments: list[str]) -> None:
    """Run `pip install`, show what it downloads, keep all it says in the log; raises Fault in one sentence."""
    command = [place.program("python"), "-m", "pip", "install", "--no-input", "--disable-pip-version-check",
               "--progress-bar", "off", *arguments]  # fmt: skip
    process = subprocess.Popen(command, cwd=place.root, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace")  # fmt: skip
    with process, open(place.log, "w", encoding="utf-8") as log:
        for line in process.stdout or ():
            log.write(line)
            words = line.split()
            if line.strip().startswith("Downloading") and words[-1] in ("MB)", "GB)"):
                wheel = words[1].rsplit("/", 1)[-1].split("-")
                say(f"downloading {' '.join(wheel[:2])} {' '.join(words[-2:])}")
            elif line.startswith("Installing collected packages"):
                say(f"unpacking {len(words) - 3} packages")
    if process.returncode:
        text = place.log.read_text(encoding="utf-8", errors="replace")
        raise Fault(pip_sentence(text, f"pip failed (all it said is in {place.log})"))


NETWORK_SIGNS = ("Temporary failure in name resolution", "Name or service not known", "Connection", "Max retries",
                 "Read timed out", "ProxyError", "SSLError", "Network is unreachable", "HTTP error")  # fmt: skip


def pip_sentence(output: str, otherwise: str) -> str:
    """The cause of a failed pip or venv in one sentence, from what it printed."""
    if "No space left on device" in output or "Errno 28" in output or "Disk quota exceeded" in output:
        return "the disk is full; free 3 GB (8 GB for the CUDA build) and run the same command again."
    if any(sign in output for sign in NETWORK_SIGNS):
        return "pip cannot reach its package index; check the network and run the same command again, it goes on."
    if "Permission denied" in output or "Read-only file system" in output:
        return "a file of the environment cannot be written; check who owns the .venv folder."
    if "ensurepip is not" in output or "No module named ensurepip" in output or "No module named venv" in output:
        return f"this Python has no venv module; install {venv_package()} and run the same command again."
    if "No matching distribution found" in output:
        name = output.rsplit("No matching distribution found for", 1)[-1].split()[:1]
        return f"no package index that pip knows has {' '.join(name)} for this Python ({sys.version.split()[0]})."
    errors = [line.strip() for line in output.splitlines() if line.lstrip().lower().startswith("error:")]
    return f"{otherwise}: {errors[-1][6:].strip().rstrip('.')}." if errors else f"{otherwise}."


def os_sentence(error: OSError, where: str) -> str:
    """An operating system error in one sentence."""
    return f"{error.filename or where} cannot be written or read ({error.strerror or error}); check it and try again."


# ---- Debian packages ------------------------------------------------------------------------------------------------


def install_debian_packages(place: Place, groups: str) -> None:
    """Install what is missing when it may; otherwise say which line to run, and go on. Other systems: nothing."""
    if not (sys.platform.startswith("linux") and shutil.which("dpkg-query") and shutil.which("apt-get")):
        return
    listed = (place.root / "packaging/debian-packages.txt").read_text(encoding="utf-8")
    missing = missing_packages(listed, groups, installed_packages())
    if not missing:
        return
    line = f"apt-get install -y --no-install-recommends {' '.join(missing)}"
    prefix = root_prefix()
    if prefix is None:
        say(f"Debian packages are missing; run this and start again if windows do not open: sudo {line}")
        return
    say(f"installing Debian packages: {' '.join(missing)}")
    for command in (["apt-get", "update"], line.split()):
        done = subprocess.run([*prefix, *command], check=False, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})  # fmt: skip
    if done.returncode:
        cause = [text for text in done.stdout.splitlines() if text.startswith("E:")]
        say(f"apt-get failed ({' '.join(cause[:1]) or 'no reason given'}), going on without; run later: {line}")


def missing_packages(listed: str, groups: str, installed: set[str]) -> list[str]:
    """Packages of the wanted groups that are not installed, in the file's order, and venv if this Python lacks it."""
    rows = [line.split() for line in listed.splitlines() if line.strip() and not line.startswith("#")]
    missing = [name for group, name in rows if group in groups and name not in installed]
    if not has_module("ensurepip"):
        missing.append(venv_package())
    return missing


def installed_packages() -> set[str]:
    """Names of all installed Debian packages and of those they stand for (libglib2.0-0t64 provides libglib2.0-0)."""
    form = "${db:Status-Abbrev}|${Package}|${Provides}\n"
    listing = subprocess.run(["dpkg-query", "-W", "-f", form], check=False, capture_output=True, text=True).stdout
    names: set[str] = set()
    for line in listing.splitlines():
        status, _, rest = line.partition("|")
        if status.startswith("ii"):
            package, _, provides = rest.partition("|")
            names |= {package, *(item.split()[0] for item in provides.split(",") if item.strip())}
    return names


def root_prefix() -> list[str] | None:
    """[] as root, ["sudo", "-n"] where sudo asks for no password, None where packages cannot be installed."""
    if os.name == "posix" and os.geteuid() == 0:
        return []
    if shutil.which("sudo") is None:
        return None
    asked = subprocess.run(["sudo", "-n", "true"], check=False, capture_output=True)
    return ["sudo", "-n"] if asked.returncode == 0 else None


def has_module(name: str) -> bool:
    """True if this Python can import a module of that name."""
    import importlib.util

    return importlib.util.find_spec(name) is not None


def venv_package() -> str:
    """Debian's package that completes venv for this Python."""
    return f"python{sys.version_info[0]}.{sys.version_info[1]}-venv"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
