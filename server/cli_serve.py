"""`seed serve`: take the port, open the service, answer until a signal says stop."""

from __future__ import annotations

import asyncio
import errno
import gc
import signal
import socket
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

import uvicorn

from server.app import create_app
from server.errors import ServiceError
from server.service import Service, opened
from server.settings import Settings
from server.store_process import StoreProcess, WriterEnded

LARGEST_MESSAGE = 64 * 1024
"""Bytes of a WebSocket message; a larger one closes the connection with 1009. Ours are below 300."""
SHORTEST_TOKEN, LONGEST_TOKEN = 32, 200
"""Characters of an owner's token that somebody else made."""
GRACE = 3
"""Seconds that requests which are still being answered get when the service ends."""
GIL_S = 0.0005
"""Seconds that a thread may compute before another gets its turn. Python's own 5 ms would be waited for at every
message of a fan-out, because each send gives the interpreter up, while the store reads."""

GC = (5_000, 20, 50)
"""Thresholds of the garbage collector. It stands everything still while it goes through what hundreds of connections
keep alive; little of a service lies in cycles, so that happens every few minutes instead of every few seconds."""


async def run_server(settings: Settings, writer: StoreProcess, *, announce: Callable[[str], None]) -> None:
    """Serve until SIGINT or SIGTERM. The port is taken first: a second start fails before it touches the database.

    Raises:
        ServiceError: the port or the data directory can't be had. StoreError: the database can't be used.
    """
    sys.setswitchinterval(GIL_S)
    gc.freeze()
    gc.set_threshold(*GC)
    listener = _listen(settings.host, settings.port)
    with listener:
        async with opened(settings, elsewhere=writer) as service:
            server = Server(config(create_app(settings, service), settings))
            address = _url(settings.host, listener.getsockname()[1]) + settings.root_path
            server.on_ready = lambda: announce(f"SEED is ready: {address}")
            server.on_end = service.hub.brake
            if settings.login:
                await _let_the_owner_in(service, settings, address, announce)
            await server.serve(sockets=[listener])
    if writer.died:
        raise WriterEnded


async def _let_the_owner_in(
    service: Service, settings: Settings, address: str, announce: Callable[[str], None]
) -> None:
    """By the token that a file holds, or, at the first start, by a new one that is told and can be used once."""
    people = service.store.people
    if settings.owner_token_file is None:
        if not await people.has_owner():
            announce(f"The owner's way in, told and good for once: {address}/join#{await people.owner_token()}")
        elif await people.old_way_in():
            announce(
                "The owner's token of an earlier version never ends, and may stand in an old log: "
                "seed owner-token ends it, and makes a way in that is good for once"
            )
        return
    try:
        given = settings.owner_token_file.read_text("utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        raise ServiceError(
            503, f"SEED_OWNER_TOKEN_FILE can't be read: {error}", remedy="name a text file that holds the owner's token"
        ) from error
    if not SHORTEST_TOKEN <= len(given) <= LONGEST_TOKEN:
        raise ServiceError(
            503,
            f"SEED_OWNER_TOKEN_FILE holds a token of {len(given)} characters",
            remedy=f"put {SHORTEST_TOKEN} to {LONGEST_TOKEN} random characters there, e.g. by openssl rand -hex 32",
        )
    await people.own_by(given)


def config(app: object, settings: Settings) -> uvicorn.Config:
    """How uvicorn runs the app; tests run it the same way."""
    return uvicorn.Config(
        app,  # type: ignore[arg-type]  # uvicorn's own ASGI types and Starlette's differ in name only
        lifespan="on",
        log_config=None,
        access_log=settings.log_level == "debug",
        ws="websockets-sansio",
        ws_max_size=LARGEST_MESSAGE,
        ws_per_message_deflate=False,  # JPEGs don't shrink, and small events cost more than they save
        ws_ping_interval=settings.ping_interval,
        ws_ping_timeout=settings.ping_interval,
        timeout_graceful_shutdown=GRACE,
        server_header=False,
        forwarded_allow_ips=settings.trusted_proxies,
    )


class Server(uvicorn.Server):
    """Uvicorn, but a signal ends it in order: the original raises it again, which would kill us before clean-up."""

    on_ready: Callable[[], None] = staticmethod(lambda: None)
    on_end: Callable[[], None] = staticmethod(lambda: None)
    """Called when a signal comes, before requests get their grace."""

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """End, but see to what can't wait first."""
        self.on_end()
        super().handle_exit(sig, frame)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start to listen, then say so."""
        await super().startup(sockets)
        if self.started:
            self.on_ready()

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Handle SIGINT and SIGTERM while serving; a second one cuts the grace short."""
        loop = asyncio.get_running_loop()
        caught = (signal.SIGINT, signal.SIGTERM)
        for number in caught:
            loop.add_signal_handler(number, self.handle_exit, number, None)
        try:
            yield
        finally:
            for number in caught:
                loop.remove_signal_handler(number)


def _listen(host: str, port: int) -> socket.socket:
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    except socket.gaierror as error:
        raise ServiceError(
            503, f"there is no address {host!r} to listen on: {error.strerror}", remedy="use --host 127.0.0.1"
        ) from error
    listener = socket.socket(family, kind, protocol)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind(address)
        listener.listen()
    except OSError as error:
        listener.close()
        if error.errno == errno.EADDRINUSE:
            message = f"port {port} of {host} is in use"
            remedy = (
                f"open http://{host}:{port} if SEED runs there already, or choose another: seed serve --port {port + 1}"
            )
        elif error.errno == errno.EACCES:
            message, remedy = f"port {port} needs privileges", "choose one above 1023: seed serve --port 8000"
        else:
            message, remedy = f"can't listen on {host}:{port}: {error.strerror}", "use --host 127.0.0.1 --port 8000"
        raise ServiceError(503, message, remedy=remedy) from error
    return listener


def _url(host: str, port: int) -> str:
    shown = "127.0.0.1" if host in ("0.0.0.0", "::") else host
    return f"http://[{shown}]:{port}" if ":" in shown else f"http://{shown}:{port}"
