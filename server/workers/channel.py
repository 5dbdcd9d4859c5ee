"""The child's side of its pipes: framed messages, a stop latch, and frames of which the newest wins.

A message is `[u32 big-endian length][bytes]`. Commands and replies are JSON; a frame is what a browser gets:
`[u32 big-endian header length][JSON header][JPEG]`.
"""

from __future__ import annotations

import argparse
import faulthandler
import json
import logging
import math
import select
import signal
import socket
import struct
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

LENGTH = struct.Struct(">I")
STOP = struct.Struct(">I")
"""The number of a stop, ascending; a re-arm names the newest stop that it lifts, so neither can overtake the other."""

ATTENDED = 0
"""The number that is no stop: an operator attends the robot still."""
FORSAKEN = 2**32 - 1
"""Nor is this one: nobody attends it any more. Silence says the same, only later."""

log = logging.getLogger(__name__)


class Channel:
    """Framed messages over a stream socket, for one thread."""

    def __init__(self, sock: socket.socket) -> None:
        self._socket = sock

    def poll(self, timeout: float | None) -> bool:
        """Whether a message, or the end, is there within `timeout` seconds (None: wait for it)."""
        return bool(select.select([self._socket], [], [], timeout)[0])

    def receive(self) -> bytes | None:
        """The next message; None once the other side is gone."""
        head = self._exactly(LENGTH.size)
        return None if head is None else self._exactly(LENGTH.unpack(head)[0])

    def send(self, payload: bytes) -> None:
        """Write one message.

        Raises:
            BrokenPipeError: the other side is gone.
        """
        self._socket.sendall(LENGTH.pack(len(payload)) + payload)

    def _exactly(self, size: int) -> bytes | None:
        parts = bytearray()
        while len(parts) < size:
            try:
                part = self._socket.recv(size - len(parts))
            except ConnectionResetError:
                return None
            if not part:
                return None
            parts += part
        return bytes(parts)


class FrameSender:
    """Writes frames without ever waiting: a frame that comes while the last one is still on its way is dropped."""

    def __init__(self, sock: socket.socket) -> None:
        sock.setblocking(False)
        self._socket = sock
        self._rest = b""

    def send(self, header: Mapping[str, Any], jpeg: bytes) -> None:
        """Send one picture, or drop it."""
        self._flush()
        if self._rest:
            return
        head = json.dumps(header).encode()
        self._rest = LENGTH.pack(LENGTH.size + len(head) + len(jpeg)) + LENGTH.pack(len(head)) + head + jpeg
        self._flush()

    def _flush(self) -> None:
        while self._rest:
            try:
                self._rest = self._rest[self._socket.send(self._rest) :]
            except BlockingIOError:
                return
            except (BrokenPipeError, ConnectionResetError):
                self._rest = b""  # the server is gone; the stop channel says so where it matters


class StopLatch:
    """A stop that stays until it is re-armed. The server's end of the channel closing is a stop too: for good.

    The channel is read whenever the question is asked, on the asking thread: a listener beside it would first have to
    win Python's lock from the very motion that it wants to end.
    """

    def __init__(self, sock: socket.socket) -> None:
        sock.setblocking(False)
        self._channel = sock
        self._pending = b""
        self._newest = 0
        self._lifted = 0
        self._orphaned = False
        self._attended_at = -math.inf

    def forsaken(self, seconds: float) -> bool:
        """Whether for so long nobody said that the robot is attended, or somebody that it isn't any more."""
        self._read()
        return time.monotonic() - self._attended_at > seconds

    def stopped(self) -> bool:
        """Whether motion is forbidden now."""
        self._read()
        return self._orphaned or self._newest > self._lifted

    def rearm(self, upto: int) -> None:
        """Lift every stop up to number `upto`; a later one, even one still on its way, stays."""
        self._lifted = max(self._lifted, upto)

    def _read(self) -> None:
        while not self._orphaned:
            try:
                data = self._channel.recv(64)
            except BlockingIOError:
                return
            except OSError:
                data = b""
            if not data:
                self._orphaned = True
            self._pending += data
            while len(self._pending) >= STOP.size:
                number = STOP.unpack(self._pending[: STOP.size])[0]
                if number == ATTENDED:
                    self._attended_at = time.monotonic()
                elif number == FORSAKEN:
                    self._attended_at = -math.inf
                else:
                    self._newest = max(self._newest, number)
                self._pending = self._pending[STOP.size :]


@dataclass(frozen=True)
class Pipes:
    """What a child is born with."""

    commands: Channel
    stop: socket.socket
    frames: socket.socket


def open_pipes(name: str) -> Pipes:
    """Take over the inherited descriptors named on the command line; set up signals, logging and crash traces."""
    parser = argparse.ArgumentParser(prog=name)
    for channel in ("commands", "stop", "frames"):
        parser.add_argument(f"--{channel}", type=int, required=True)
    arguments = parser.parse_args()
    # Ctrl-C reaches the whole process group; the server decides when its workers end
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    faulthandler.enable()
    logging.basicConfig(stream=sys.stderr, level=logging.INFO, format=f"%(asctime)s {name} %(levelname)s %(message)s")
    return Pipes(
        Channel(socket.socket(fileno=arguments.commands)),
        socket.socket(fileno=arguments.stop),
        socket.socket(fileno=arguments.frames),
    )


class Refusal(Exception):
    """A command that was understood and is refused; nothing has changed. `remedy` says what to do."""

    def __init__(self, message: str, *, remedy: str) -> None:
        super().__init__(message)
        self.remedy = remedy


Handler = Callable[..., Mapping[str, Any]]


def answer(request: Mapping[str, Any], handlers: Mapping[str, Handler]) -> Mapping[str, Any]:
    """Run one request `{"id", "command", "arguments"}` and make its reply.

    An error with a remedy is told as it is. Any other exception is a bug: its trace goes to the log, the caller hears
    of it, and the process stays up, because the caller is the one to decide whether its state can be trusted.
    """
    try:
        result = handlers[request["command"]](**request["arguments"])
    except Exception as error:  # the boundary of the process: everything becomes a reply
        remedy = getattr(error, "remedy", None)
        if remedy is None:
            log.exception("command %s failed", request["command"])
            remedy = "see the trace in the server's log, and report it"
        return {
            "id": request["id"],
            "error": {"kind": type(error).__name__, "message": str(error) or repr(error), "remedy": remedy},
        }
    return {"id": request["id"], "result": result}
