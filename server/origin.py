"""Who may talk to the service: Host and Origin checks, body limit and protective headers, as one ASGI middleware.

On loopback nobody signs in, so a browser's same-origin rule is the lock. Two ways around it are closed here: a foreign
name that resolves to this machine (DNS rebinding: Host check) and a foreign page that sends requests (Origin check).
"""

from __future__ import annotations

import ipaddress
from urllib.parse import urlsplit

from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.errors import ServiceError, problem, response
from server.schemas_problems import Problem
from server.settings import Settings

SAFE_METHODS = {"GET", "HEAD", "OPTIONS"}
LOOPBACK_NAMES = {"localhost", "127.0.0.1", "::1"}
_DEFAULT_PORTS = {"http": ":80", "https": ":443"}
DRAIN_LIMIT = 32 * 1024 * 1024
"""Bytes of a refused body that are read and thrown away, so that the client gets to read the answer."""

PROTECTIVE_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),  # a page that frames ours could steal clicks, and clicks move a robot
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"referrer-policy", b"no-referrer"),
)


CONTENT_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; font-src 'self'; media-src 'self' blob:; worker-src 'self' blob:; manifest-src 'self'; "
    "base-uri 'self'; form-action 'self'; frame-ancestors 'none'"
)
"""Styles may be inline: charts and the 3-D view place things so. Scripts may not, and nothing comes from elsewhere."""
SWAGGER_POLICY = CONTENT_POLICY.replace("script-src 'self'", "script-src 'self' 'unsafe-inline'")
"""Swagger's page starts itself by an inline script; it shows nothing that anybody has written."""


class RemoteNotAllowed(ServiceError):
    """The service was asked to listen where strangers can reach it."""


def check_bind(settings: Settings) -> None:
    """Refuse to listen, without a login, where others reach the service: on their network, or behind a proxy.

    Raises:
        RemoteNotAllowed: says how to publish the service safely.
    """
    if settings.login:
        return
    published = [name for name in settings.allowed_hosts if _name(name) not in LOOPBACK_NAMES]
    if not settings.loopback:
        what = f"{settings.host} can be reached by others"
    elif published:
        what = f"SEED_ALLOWED_HOSTS names {published[0]}, under which others reach the service"
    else:
        return
    raise RemoteNotAllowed(
        403,
        f"{what}, and there is no login: whoever reaches the port can move the robot",
        remedy="set SEED_LOGIN=1: the service then asks everybody who they are (docs/people.md); or reach it through a "
        f"tunnel (ssh -L {settings.port}:127.0.0.1:{settings.port} thismachine)",
    )


def is_loopback(address: str) -> bool:
    """Whether whoever calls from there sits at this machine."""
    try:
        number = ipaddress.ip_address(address)
    except ValueError:
        return address in LOOPBACK_NAMES
    mapped = number.ipv4_mapped if isinstance(number, ipaddress.IPv6Address) else None
    return (mapped or number).is_loopback


class Guard:
    """ASGI middleware: refuses foreign hosts, foreign origins and bodies that are too large."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self.app = app
        self.settings = settings

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request or WebSocket handshake."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = {name: value.decode("latin-1") for name, value in scope["headers"]}
        refused = self._refusal(scope, headers)
        if scope["type"] == "websocket":
            # the denial is an HTTP answer to the handshake (ASGI extension websocket.http.response)
            await (response(refused)(scope, receive, send) if refused else self.app(scope, receive, send))
            return
        limit = self.settings.max_body_bytes
        if refused is None and _declared_length(headers) > limit:
            refused = too_large(limit)
        if refused is not None:
            await _drain(receive)
            await response(refused, {"connection": "close"})(scope, receive, _protected(send, CONTENT_POLICY))
            return
        swagger = scope["path"].endswith("/docs")
        policy = SWAGGER_POLICY if swagger else CONTENT_POLICY
        await self.app(scope, _limited(receive, limit), _protected(send, policy))

    def _refusal(self, scope: Scope, headers: dict[bytes, str]) -> Problem | None:
        host = headers.get(b"host", "")
        if not self._known_host(host):
            return problem(
                403,
                f"the service doesn't answer under the name {host!r}",
                remedy="open it as http://127.0.0.1 with its port, or add the name to SEED_ALLOWED_HOSTS",
                slug="foreign-host",
            )
        origin = headers.get(b"origin")
        unsafe = scope["type"] == "websocket" or scope["method"] not in SAFE_METHODS
        if unsafe and origin is not None and not self._known_origin(origin, host, scope["scheme"]):
            return problem(
                403,
                f"a page of {origin!r} may not act here",
                remedy="open the service under its own address; where a proxy in front keeps its port to itself, "
                "add name:port to SEED_ALLOWED_HOSTS",
                slug="foreign-origin",
            )
        return None

    def _known_host(self, host: str) -> bool:
        name = _name(host)
        if name in LOOPBACK_NAMES or name in {_name(allowed) for allowed in self.settings.allowed_hosts}:
            return True
        # rebinding needs a name; an address in numbers is safe where everybody is asked who they are
        return self.settings.login and _is_address(name)

    def _known_origin(self, origin: str, host: str, scheme: str) -> bool:
        """A page of another port is a stranger's, although the cookie goes there too: `SameSite` knows no ports.

        scheme: by what the service was reached; a proxy that doesn't say so makes https look like http.
        """
        try:
            page = urlsplit(origin)
        except ValueError:
            return False
        default = _DEFAULT_PORTS.get(page.scheme)
        if default is None or page.netloc == "" or (scheme in ("https", "wss") and page.scheme != "https"):
            return False
        # a name without its port stands for a page only where a proxy says another one to us
        named = (a for a in self.settings.allowed_hosts if _name(a) != a or _name(a) != _name(host))
        ours = {each.strip().lower().removesuffix(default) for each in (host, *named)}
        return page.netloc.lower().removesuffix(default) in ours


def too_large(limit: int) -> Problem:
    """The answer to a body above the limit."""
    return problem(413, f"the body is larger than {limit} bytes", remedy="send a smaller body")


class BodyTooLarge(HTTPException):
    """Raised while reading a body of undeclared length; FastAPI lets an HTTPException through its body parser."""

    def __init__(self) -> None:
        super().__init__(413)


def _limited(receive: Receive, limit: int) -> Receive:
    total = 0

    async def limited() -> Message:
        nonlocal total
        message = await receive()
        total += len(message.get("body", b""))
        if total > limit:
            if message.get("more_body"):
                await _drain(receive)
            raise BodyTooLarge
        return message

    return limited


async def _drain(receive: Receive) -> None:
    """Read and forget: a client that is still sending when we close would see a reset instead of the answer."""
    dropped = 0
    while dropped < DRAIN_LIMIT:
        message = await receive()
        dropped += len(message.get("body", b""))
        if message["type"] != "http.request" or not message.get("more_body"):
            return


def _protected(send: Send, policy: str) -> Send:
    headers = (*PROTECTIVE_HEADERS, (b"content-security-policy", policy.encode()))

    async def protected(message: Message) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *headers]}
        await send(message)

    return protected


def _declared_length(headers: dict[bytes, str]) -> int:
    declared = headers.get(b"content-length", "0")
    return int(declared) if declared.isascii() and declared.isdigit() else 0


def _name(host: str) -> str:
    """`Example.org:80` -> example.org; `[::1]:80` -> ::1."""
    host = host.strip().lower()
    if host.startswith("["):
        return host[1:].partition("]")[0]
    return host.rpartition(":")[0] if ":" in host else host


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
