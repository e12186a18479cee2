"""The worker's end of the line: a local socket on a thread of its own that also gives the heartbeat.

Messages for windows are queued and sent by that thread, so that no window, however slow, holds up the optimisation; one
that falls too far behind is disconnected and may come back. The thread outlives a shortage of memory: windows then
still hear what became of the run.
"""

from __future__ import annotations

import os
import selectors
import shutil
import socket
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from genmojo_core.errors import GenmojoError
from genmojo_studio.worker.protocol import BEAT_SECONDS, VERSION, Decoder, encode

_BEHIND = 64 << 20  # bytes a window may be behind
_HELLO_SECONDS = 10.0
_FLUSH_SECONDS = 2.0
_RESERVE = 4 << 20  # bytes given back when memory is short, for the last messages
_BREATH = 0.05  # seconds before the thread tries again then


class _Window:
    """One connection."""

    def __init__(self, sock: socket.socket) -> None:
        self.socket = sock
        self.decoder = Decoder()
        self.out = bytearray()
        self.known = False
        self.since = time.monotonic()


class Link:
    """Listens for windows; use as a context manager.

    Args:
        token: windows have to give it. hello: makes the answer to a window's hello; it must not `tell`.
        beat: makes the heartbeat.
        heard: gets every command, on the link's thread.
    """

    def __init__(
        self, token: str, hello: Callable[[], dict[str, Any]], beat: Callable[[], dict[str, Any]],
        heard: Callable[[dict[str, Any]], None],
    ) -> None:  # fmt: skip
        self._token, self._hello, self._beat, self._heard = token, hello, beat, heard
        self._folder: Path | None = None
        self._listener, self.address = self._listening()
        self._windows: list[_Window] = []
        self._lock = threading.Lock()
        self._selector = selectors.DefaultSelector()
        self._wake_in, self._wake_out = socket.socketpair()
        self._wake_out.setblocking(False)
        self._wake_in.setblocking(False)
        self._ending = threading.Event()
        self._reserve = bytearray(_RESERVE)
        self._next_beat = time.monotonic()
        self._until: float | None = None
        self._thread = threading.Thread(target=self._serve, name="genmojo-link", daemon=True)

    def __enter__(self) -> Link:
        self._selector.register(self._listener, selectors.EVENT_READ)
        self._selector.register(self._wake_out, selectors.EVENT_READ)
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        """Send what is queued, for a moment, and close."""
        self._ending.set()
        self._wake()
        self._thread.join(_FLUSH_SECONDS + 1.0)
        for window in self._windows:
            window.socket.close()
        for end in (self._listener, self._wake_in, self._wake_out):
            end.close()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def tell(self, message: dict[str, Any]) -> None:
        """Queue a message for all windows; from any thread."""
        data = encode(message)
        with self._lock:
            for window in self._windows:
                if window.known:
                    window.out += data
        self._wake()

    def leave(self, seconds: float) -> None:
        """Wait until everything queued has left, for some seconds at most."""
        until = time.monotonic() + seconds
        while any(window.out for window in list(self._windows)) and time.monotonic() < until:
            time.sleep(0.002)

    def _listening(self) -> tuple[socket.socket, str]:
        """A local socket: a Unix one in a folder of its own, on Windows the loopback interface (with the token)."""
        if sys.platform == "win32" or not hasattr(socket, "AF_UNIX"):
            listener = socket.create_server(("127.0.0.1", 0))
            address = f"tcp:127.0.0.1:{listener.getsockname()[1]}"
        else:
            self._folder = Path(tempfile.mkdtemp(prefix="genmojo-"))  # mode 0700; run folders have too long names
            path = self._folder / "socket"
            listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
            listener.bind(os.fspath(path))
            listener.listen(8)
            address = f"unix:{path}"
        listener.setblocking(False)
        return listener, address

    def _wake(self) -> None:
        try:
            self._wake_in.send(b"w")
        except OSError:  # full: it wakes up anyway; closed: over
            return

    def _serve(self) -> None:
        """The thread. What cannot be done for want of memory is left out: a window finds events in their file."""
        over = False
        while not over:
            try:
                over = self._turn()
            except MemoryError:
                self._reserve = bytearray()
                time.sleep(_BREATH)

    def _turn(self) -> bool:
        """Accept, read, write, beat; True when it is over."""
        for key, mask in self._selector.select(max(0.0, min(self._next_beat - time.monotonic(), BEAT_SECONDS))):
            self._serve_one(key, mask)
        now = time.monotonic()
        if now >= self._next_beat:
            self._next_beat = now + BEAT_SECONDS
            self.tell({"type": "beat", **self._beat()})
        for window in list(self._windows):
            self._send(window)
            if not window.known and now - window.since > _HELLO_SECONDS:
                self._drop(window)
        if not self._ending.is_set():
            return False
        self._until = self._until or now + _FLUSH_SECONDS
        return now > self._until or not any(w.out for w in self._windows)

    def _serve_one(self, key: selectors.SelectorKey, mask: int) -> None:
        if key.fileobj is self._listener:
            try:
                sock, _ = self._listener.accept()
            except OSError:  # it hung up again already
                return
            sock.setblocking(False)
            window = _Window(sock)
            with self._lock:
                self._windows.append(window)
            self._selector.register(sock, selectors.EVENT_READ, window)
        elif key.fileobj is self._wake_out:
            self._wake_out.recv(4096)
        elif mask & selectors.EVENT_READ:
            self._read(key.data)

    def _read(self, window: _Window) -> None:
        """What a window says; one that is gone or talks nonsense is dropped."""
        try:
            data = window.socket.recv(1 << 16)
            messages = window.decoder.feed(data) if data else []
        except BlockingIOError:
            return
        except (OSError, GenmojoError):
            data, messages = b"", []
        if not data:
            self._drop(window)
            return
        for message in messages:
            if message["type"] == "hello":
                self._greet(window, message)
            elif window.known and message["type"] == "command":
                self._heard(message)

    def _greet(self, window: _Window, message: dict[str, Any]) -> None:
        """Let a window in, or tell it why not."""
        if message.get("token") != self._token:
            self._drop(window)
            return
        if message.get("version") != VERSION:
            window.out += encode({"type": "refused", "version": VERSION})
            return
        with self._lock:  # what is told from now on comes after the hello, what was told before is in it
            window.out += encode({"type": "hello", "version": VERSION, **self._hello()})
            window.known = True

    def _send(self, window: _Window) -> None:
        """As much as the window takes now."""
        try:
            with self._lock:
                if window.out:
                    sent = window.socket.send(window.out)
                    del window.out[:sent]
                behind = len(window.out)
        except BlockingIOError:
            behind = len(window.out)
        except OSError:
            self._drop(window)
            return
        if behind > _BEHIND:
            self._drop(window)
            return
        wanted = selectors.EVENT_READ | (selectors.EVENT_WRITE if behind else 0)
        if self._selector.get_key(window.socket).events != wanted:
            self._selector.modify(window.socket, wanted, window)

    def _drop(self, window: _Window) -> None:
        with self._lock:
            if window not in self._windows:
                return
            self._windows.remove(window)
        self._selector.unregister(window.socket)
        window.socket.close()
