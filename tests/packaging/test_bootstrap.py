"""The two commands: what a person meets on a fresh, an odd or a broken machine. Nothing here uses the network.

A copy of the script is run in a folder of its own, where `.venv/bin/python` is a small shell script that plays pip.
Not covered: a real installation (done by .ci/run itself) and Windows paths.
"""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(os.name == "nt", reason="the stand-ins are shell scripts")

PIP = """#!/bin/sh
case "$1 $2 $3" in
  "-c "*) exit 0 ;;
  "-m pip install") echo "$@" >> "{calls}"; printf '%s\\n' "{says}"; exit {code} ;;
  *) echo "$@" >> "{calls}"; exit {other} ;;
esac
"""


def load() -> ModuleType:
    spec = importlib.util.spec_from_file_location("bootstrap", ROOT / "packaging" / "bootstrap.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


bootstrap = load()


def write_program(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    root = tmp_path / "a checkout"
    (root / "packaging").mkdir(parents=True)
    for name in ("bootstrap.py", "constraints.txt", "debian-packages.txt"):
        shutil.copy(ROOT / "packaging" / name, root / "packaging" / name)
    shutil.copy(ROOT / "pyproject.toml", root / "pyproject.toml")
    return root


def fake_pip(root: Path, says: str = "", code: int = 0, other: int = 0) -> Path:
    """An environment whose pip only says something; returns the file that lists how it was called."""
    calls = root / "calls.txt"
    calls.touch()
    write_program(root / ".venv/bin/python", PIP.format(calls=calls, says=says, code=code, other=other))
    return calls


def run(root: Path, *arguments: str, path: str | None = None) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PATH": path or os.environ["PATH"]}
    environment.pop("GENMOJO_TORCH_INDEX", None)
    return subprocess.run([sys.executable, str(root / "packaging/bootstrap.py"), *arguments], cwd=root, text=True,
                          capture_output=True, env=environment, stdin=subprocess.DEVNULL, timeout=120)  # fmt: skip


def the_sentence(result: subprocess.CompletedProcess[str]) -> str:
    """Last line on stderr, after checking that no traceback was shown."""
    assert "Traceback" not in result.stderr
    return result.stderr.strip().splitlines()[-1]


def test_old_python_is_refused_in_one_sentence() -> None:
    script = str(ROOT / "packaging/bootstrap.py")
    code = f"import runpy, sys; sys.version_info = (3, 9, 2); runpy.run_path({script!r})"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.returncode == 1
    assert result.stderr == "bootstrap: Python 3.11 or newer is needed, this is 3.9.\n"


def test_second_run_does_nothing(checkout: Path) -> None:
    calls = fake_pip(checkout)
    assert run(checkout, "install", "--no-system-packages").returncode == 0
    first = calls.read_text()
    assert "-c packaging/constraints.txt -e ." in first
    again = run(checkout, "install", "--no-system-packages")
    assert (again.returncode, again.stderr, calls.read_text()) == (0, "", first)


def test_install_after_test_keeps_the_test_tools(checkout: Path) -> None:
    """The demo after the tests must not install anew, and a changed requirement must keep the extras."""
    calls = fake_pip(checkout)
    run(checkout, "test", "--no-system-packages")
    assert ".[" in calls.read_text() and "dev" in calls.read_text()
    calls.write_text("")
    run(checkout, "install", "--no-system-packages")
    assert calls.read_text() == ""
    (checkout / "packaging/constraints.txt").write_text("torch==2.13.0\nnumpy<3\n")
    run(checkout, "install", "--no-system-packages")
    assert "dev" in calls.read_text()


def test_interrupted_installation_is_taken_up_again(checkout: Path) -> None:
    calls = fake_pip(checkout, says="ERROR: killed", code=1)
    assert run(checkout, "install", "--no-system-packages").returncode == 3
    assert not (checkout / ".venv/genmojo-stamp.json").exists()
    fake_pip(checkout)
    assert run(checkout, "install", "--no-system-packages").returncode == 0
    assert len(calls.read_text().splitlines()) == 2
    assert json.loads((checkout / ".venv/genmojo-stamp.json").read_text())["parts"] in ([], ["cuda"])


def test_damaged_stamp_means_install_again(checkout: Path) -> None:
    calls = fake_pip(checkout)
    (checkout / ".venv/genmojo-stamp.json").write_text('{"parts": 3}')
    assert run(checkout, "install", "--no-system-packages").returncode == 0
    assert calls.read_text()


@pytest.mark.parametrize(
    ("says", "expected"),
    [
        ("WARNING: Retrying: Temporary failure in name resolution\nERROR: No matching distribution found for numba",
         "cannot reach its package index"),
        ("ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device", "disk is full"),
        ("ERROR: No matching distribution found for torch==2.13.0", "has torch==2.13.0 for this Python"),
        ("error: subprocess-exited-with-error", "subprocess-exited-with-error"),
        ("", "pip failed"),
    ],
)  # fmt: skip
def test_broken_pip_is_told_in_one_sentence(checkout: Path, says: str, expected: str) -> None:
    fake_pip(checkout, says=says, code=1)
    result = run(checkout, "install", "--no-system-packages")
    assert result.returncode == 3
    assert expected in the_sentence(result)


def test_cpu_build_that_no_index_has_names_the_variable(checkout: Path) -> None:
    calls = fake_pip(checkout, says="ERROR: No matching distribution found for torch==2.13.0+cpu", code=1)
    result = run(checkout, "install", "--cpu", "--no-system-packages")
    assert "torch==2.13.0+cpu" in calls.read_text()
    assert result.returncode == 3
    assert "GENMOJO_TORCH_INDEX" in the_sentence(result)


def test_file_in_the_way_of_the_environment(checkout: Path) -> None:
    (checkout / ".venv").write_text("mine")
    result = run(checkout, "install", "--no-system-packages")
    assert result.returncode == 2
    assert "is a file" in the_sentence(result)
    assert (checkout / ".venv").read_text() == "mine"


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs a folder that nobody can write")
def test_unwritable_folder(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """The folder of a process takes no new file, not even from root."""
    monkeypatch.setattr(bootstrap, "digest", lambda place: "x")
    monkeypatch.setattr(bootstrap, "Path", lambda _: Path("/proc/self/packaging/bootstrap.py"))
    monkeypatch.setattr(bootstrap.shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(1, 0, 10**12))
    assert bootstrap.main(["install", "--no-system-packages"]) in (2, 3)
    shown = capsys.readouterr().err
    assert "Traceback" not in shown and ".venv" in shown.splitlines()[-1]


def test_unknown_command_is_refused(checkout: Path) -> None:
    result = run(checkout, "frobnicate")
    assert result.returncode == 2
    assert "demo" in the_sentence(result)


def test_failing_tests_fail_the_command(checkout: Path) -> None:
    fake_pip(checkout, other=1)
    assert run(checkout, "test", "--no-system-packages").returncode == 1


def test_pytest_arguments_are_passed_on(checkout: Path) -> None:
    calls = fake_pip(checkout)
    assert run(checkout, "test", "--no-system-packages", "tests/effects", "-k", "plan").returncode == 0
    assert calls.read_text().splitlines()[-1] == "-m pytest -m not slow and not gpu tests/effects -k plan"


def test_demo_passes_the_exit_code_on(checkout: Path) -> None:
    fake_pip(checkout)
    missing = run(checkout, "demo", "--no-system-packages")
    assert missing.returncode == 3 and "genmojo" in the_sentence(missing)
    write_program(checkout / ".venv/bin/genmojo", '#!/bin/sh\necho "$@"\nexit 130\n')
    result = run(checkout, "demo", "--no-system-packages", "--json")
    assert (result.returncode, result.stdout) == (130, "demo --json\n")


# ---- Debian packages ------------------------------------------------------------------------------------------------


def fake_debian(root: Path, listing: str, apt: str, sudo: str = "exit 1") -> tuple[str, Path]:
    """A PATH whose dpkg-query, apt-get and sudo are stand-ins, and the file that lists how apt-get was called."""
    calls = root / "apt.txt"
    calls.touch()
    write_program(root / "bin/dpkg-query", f"#!/bin/sh\ncat <<'X'\n{listing}\nX\n")
    write_program(root / "bin/apt-get", f'#!/bin/sh\necho "$@" >> "{calls}"\n{apt}\n')
    write_program(root / "bin/sudo", f"#!/bin/sh\n{sudo}\n")
    return f"{root / 'bin'}:{os.environ['PATH']}", calls


def test_missing_packages_are_installed_after_an_update(checkout: Path) -> None:
    if os.geteuid() != 0:
        pytest.skip("only root installs packages without sudo")
    fake_pip(checkout)
    listing = "\n".join(f"ii |{name}|" for name in ("libegl1", "libgl1", "libxkbcommon0", "libfontconfig1"))
    path, calls = fake_debian(checkout, listing + "\nii |libglib2.0-0t64|libglib2.0-0 (= 2.80)\nrc |libdbus-1-3|", "")
    assert run(checkout, "install", path=path).returncode == 0
    assert calls.read_text().splitlines() == ["update", "install -y --no-install-recommends libdbus-1-3"]


def test_failing_apt_is_told_and_the_rest_goes_on(checkout: Path) -> None:
    if os.geteuid() != 0:
        pytest.skip("only root installs packages without sudo")
    fake_pip(checkout)
    path, _ = fake_debian(checkout, "", 'echo "E: Could not get lock"; exit 100')
    result = run(checkout, "install", path=path)
    assert result.returncode == 0
    assert "E: Could not get lock" in result.stderr and "apt-get install -y" in result.stderr


def test_without_rights_the_exact_line_is_printed(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path, calls = fake_debian(checkout, "", "")
    monkeypatch.setenv("PATH", path)
    monkeypatch.setattr(bootstrap.os, "geteuid", lambda: 1000)
    bootstrap.install_debian_packages(bootstrap.Place(checkout), "A")
    shown = capsys.readouterr().err
    assert "sudo apt-get install -y --no-install-recommends libegl1 libgl1 " in shown and "xvfb" not in shown
    assert calls.read_text() == ""


def test_password_free_sudo_is_used(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bootstrap.os, "geteuid", lambda: 1000)
    path, _ = fake_debian(checkout, "", "", sudo="exit 0")
    monkeypatch.setenv("PATH", path)
    assert bootstrap.root_prefix() == ["sudo", "-n"]


def test_venv_is_added_where_python_lacks_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Debian's python3 comes without ensurepip, so a bare machine needs one package more."""
    monkeypatch.setattr(bootstrap, "has_module", lambda name: name != "ensurepip")
    missing = bootstrap.missing_packages("A libegl1\nB xvfb\n", "A", {"libegl1"})
    assert missing == [f"python3.{sys.version_info[1]}-venv"]


def test_package_list_has_both_groups_and_no_doubles() -> None:
    rows = [
        line.split() for line in (ROOT / "packaging/debian-packages.txt").read_text().splitlines() if line[0] != "#"
    ]
    names = [name for _, name in rows]
    assert {group for group, _ in rows} == {"A", "B"} and len(names) == len(set(names)) and "xvfb" in names


def test_pinned_torch_is_within_the_declared_range() -> None:
    from packaging.specifiers import SpecifierSet

    pinned = next(x for x in (ROOT / "packaging/constraints.txt").read_text().splitlines() if x.startswith("torch=="))
    declared = next(x for x in (ROOT / "pyproject.toml").read_text().splitlines() if '"torch>=' in x)
    assert pinned.removeprefix("torch==") in SpecifierSet(declared.strip().strip('",').removeprefix("torch"))
