"""The window's end of the local socket: messages out, messages in as signals."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtNetwork import QAbstractSocket, QLocalSocket, QTcpSocket

from genmojo_core.errors import GenmojoError
from genmojo_studio.worker.protocol import Decoder, encode

_CONNECT_MS = 500


class Line(QObject):
    """One connection to a worker.

    Signals: message(dict) for each that comes; closed() when the other side is gone.
    """

    message = Signal(dict)
    closed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._socket: QLocalSocket | QTcpSocket | None = None
        self._decoder = Decoder()
        self.more = False  # further messages wait behind the one being told

    @property
    def is_open(self) -> bool:
        """True while connected."""
        return self._socket is not None

    def open(self, address: str) -> bool:
        """Connect to "unix:PATH" or "tcp:HOST:PORT"; False if nobody listens."""
        self.close()
        kind, _, rest = address.partition(":")
        self._decoder = Decoder()
        if kind == "tcp":
            tcp = QTcpSocket(self)
            host, _, port = rest.rpartition(":")
            tcp.connectToHost(host, int(port))
            if tcp.waitForConnected(_CONNECT_MS):
                tcp.setSocketOption(QAbstractSocket.SocketOption.LowDelayOption, 1)
                self._socket = tcp
        else:
            local = QLocalSocket(self)
            local.connectToServer(rest)
            if local.waitForConnected(_CONNECT_MS):
                self._socket = local
        if self._socket is None:
            return False
        self._socket.readyRead.connect(self._read)
        self._socket.disconnected.connect(self._on_disconnected)
        return True

    def send(self, message: dict[str, Any]) -> None:
        """Send a message; it is lost if the other side is gone, which `closed` tells."""
        if self._socket is not None:
            self._socket.write(encode(message))
            self._socket.flush()

    def drain(self) -> None:
        """Read what came before the other side closed."""
        if self._socket is not None:
            self._read()

    def close(self) -> None:
        """Hang up."""
        if self._socket is None:
            return
        old, self._socket = self._socket, None
        old.readyRead.disconnect(self._read)
        old.disconnected.disconnect(self._on_disconnected)
        old.abort()
        old.deleteLater()

    def _read(self) -> None:
        """Everything that has come; a side that talks nonsense is hung up on."""
        if self._socket is None:
            return
        try:
            messages = self._decoder.feed(bytes(self._socket.readAll().data()))
        except GenmojoError:
            self.close()
            self.closed.emit()
            return
        for i, message in enumerate(messages):
            self.more = i + 1 < len(messages)
            self.message.emit(message)
        self.more = False

    def _on_disconnected(self) -> None:
        self._read()
        self.close()
        self.closed.emit()
