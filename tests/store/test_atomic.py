"""Files appear whole or not at all, whatever fails."""

from __future__ import annotations

import os

import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.store import atomic


def test_new_and_replaced(tmp_path):
    atomic.write_bytes(tmp_path / "new" / "a", b"one")
    atomic.write_bytes(tmp_path / "new" / "a", b"two")
    assert (tmp_path / "new" / "a").read_bytes() == b"two" and os.listdir(tmp_path / "new") == ["a"]


@pytest.mark.parametrize("name", ["replace", "fsync", "open"])
def test_failing_calls_leave_the_old_file(tmp_path, monkeypatch, name):
    """Full disk, broken disk, busy target: old bytes stay, no temporary stays, one sentence names the file."""
    target = tmp_path / "a"
    target.write_bytes(b"old")

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(f"genmojo_core.store.atomic.os.{name}", fail)
    with pytest.raises(GenmojoError, match="no space left"):
        atomic.write_bytes(target, b"new")
    monkeypatch.undo()
    assert os.listdir(tmp_path) == ["a"]
    assert target.read_bytes() == (b"new" if name == "open" else b"old")  # the folder's fsync comes after the rename


def test_an_exception_of_the_writer_leaves_nothing(tmp_path):
    with pytest.raises(KeyboardInterrupt), atomic.staged(tmp_path / "a") as part:
        part.write_bytes(b"half")
        raise KeyboardInterrupt
    assert os.listdir(tmp_path) == []


def test_links_stay_links(tmp_path):
    (tmp_path / "real").write_bytes(b"1")
    (tmp_path / "link").symlink_to(tmp_path / "real")
    atomic.write_bytes(tmp_path / "link", b"2")
    assert (tmp_path / "link").is_symlink() and (tmp_path / "real").read_bytes() == b"2"


def test_busy_target_is_waited_for(tmp_path, monkeypatch):
    """Windows: a scanner holds the file for a moment."""
    real, calls = os.replace, []

    def busy(part, target):
        calls.append(part)
        if len(calls) < 3:
            error = PermissionError(13, "busy")
            error.winerror = 32
            raise error
        real(part, target)

    monkeypatch.setattr(atomic.os, "replace", busy)
    atomic.write_bytes(tmp_path / "a", b"x")
    assert len(calls) == 3 and (tmp_path / "a").read_bytes() == b"x"


def test_check_writable(tmp_path):
    atomic.check_writable(tmp_path / "not" / "yet" / "a.h5")
    assert os.listdir(tmp_path) == []
    (tmp_path / "file").write_bytes(b"")
    for bad in (tmp_path, tmp_path / "file" / "a.h5", "/proc/none/a.h5"):
        with pytest.raises(GenmojoError) as caught:
            atomic.check_writable(bad)
        assert caught.value.code == "io"
