"""A network cable between a browser and the service that a test can pull: nothing passes, and nobody is told."""

from __future__ import annotations

import contextlib
import socket
import threading

from tests.live import free_port


class Cable:
    """Forwards TCP from a port of its own. What was connected when it is pulled stays silent for good."""

    def __init__(self, target: int) -> None:
        self.port = free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self._target = target
        self._pulled = threading.Event()
        self._listener: socket.socket | None = None
        self._ends: list[socket.socket] = []
        self.plug_in()

    def plug_in(self) -> None:
        """New connections get through from now on."""
        self._pulled = threading.Event()
        self._listener = socket.create_server(("127.0.0.1", self.port))
        threading.Thread(target=self._accept, args=(self._listener, self._pulled), daemon=True).start()

    def pull(self) -> None:
        """Nothing gets through: open connections are neither served nor closed, new ones are refused."""
        self._pulled.set()
        assert self._listener is not None
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def close(self) -> None:
        """End everything."""
        self.pull()
        for end in self._ends:
            end.close()

    def _accept(self, listener: socket.socket, pulled: threading.Event) -> None:
        while not pulled.is_set():
            try:
                near, _ = listener.accept()
                far = socket.create_connection(("127.0.0.1", self._target))
            except OSError:
                return
            self._ends += [near, far]
            for source, sink in ((near, far), (far, near)):
                threading.Thread(target=self._carry, args=(source, sink, pulled), daemon=True).start()

    def _carry(self, source: socket.socket, sink: socket.socket, pulled: threading.Event) -> None:
        with contextlib.suppress(OSError):
            while data := source.recv(65536):
                if pulled.is_set():  # lost on its way, as is whatever comes after it, an end included
                    return
                sink.sendall(data)
            if not pulled.is_set():
                sink.shutdown(socket.SHUT_WR)
