"""The HTTP application: routes, errors, guards, health and the web page."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import secrets
from collections.abc import AsyncIterator
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path

from fastapi import Depends, FastAPI, Request, Response
from fastapi.responses import FileResponse, HTMLResponse, JSONResponse
from fastapi_offline import FastAPIOffline
from starlette.convertors import Convertor, register_url_convertor

from server import errors
from server.access import authorised
from server.openapi import describe
from server.origin import Guard
from server.routes import (
    attendance,
    catalogue,
    experiments,
    feedback,
    guiding,
    history,
    incidents,
    people,
    practice,
    proposals,
    quality,
    records,
    results,
    stream,
    studies,
    trust,
)
from server.schemas_problems import Health, Readiness
from server.service import Service, create_first, opened
from server.settings import Settings

API = "/api/v1"
STATIC = Path(__file__).parent / "static"
NOT_BUILT = """<!doctype html><html lang="en"><title>SEED: the page is not built</title>
<body style="font-family: sans-serif; max-width: 40rem; margin: 4rem auto">
<h1>The web page has not been built</h1>
<p>Run <code>make run</code> in the project's directory: it builds the page and starts the service.</p>
<p>The service itself is up: <a href="/docs">its API</a>.</p></body></html>"""


def create_app(settings: Settings | None = None, service: Service | None = None) -> FastAPI:
    """The application; it opens its own service at start unless it is handed a running one."""
    settings = settings or (service.settings if service else Settings())

    @contextlib.asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        if service is not None:
            app.state.service = service
            await create_first(service)
            yield
            return
        async with opened(settings) as own:
            app.state.service = own
            await create_first(own)
            yield

    # its Swagger page comes with its scripts: a lab without the internet reads it too
    app = FastAPIOffline(
        redoc_url=None,
        title="SEED",
        version=version("seed-robot"),
        summary="Train a robot arm by judging the skills it proposes.",
        lifespan=lifespan,
        root_path=settings.root_path,
        dependencies=[Depends(authorised)],
        generate_unique_id_function=lambda route: route.name,
        separate_input_output_schemas=False,
    )
    app.state.boot_id = secrets.token_hex(8)
    for part in (
        catalogue,
        experiments,
        attendance,
        guiding,
        proposals,
        feedback,
        history,
        incidents,
        people,
        records,
        results,
        trust,
        quality,
        practice,
        studies,
        stream,
    ):
        app.include_router(part.router, prefix=API)
    stream.document(app)
    errors.install(app)
    describe(app)
    app.add_middleware(Guard, settings=settings)
    _add_probes(app)
    _add_page(app, settings)
    return app


COMPRESSED = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}
"""Suffixes of the page's files that compressing makes smaller, and their media types."""


def _add_probes(app: FastAPI) -> None:
    @app.get("/health", tags=["probes"])
    async def health() -> Health:
        """The process is up and its event loop turns."""
        return Health(boot_id=app.state.boot_id)

    @app.get("/ready", tags=["probes"], responses={503: {"model": Readiness, "description": "Not ready"}})
    async def ready(request: Request) -> Response:
        """Whether the database answers and the workers that should live do; why not is told to those who are in."""
        running: Service = app.state.service
        readiness = await running.readiness()
        if request.state.principal is None:
            checks = {name: told if told == "ok" else "sign in to see why" for name, told in readiness.checks.items()}
            readiness = readiness.model_copy(update={"checks": checks})
        return JSONResponse(readiness.model_dump(mode="json"), 200 if readiness.ready else 503)


class _PagePath(Convertor[str]):
    """Every address that isn't the API's: an unknown route of the API is an error, not the page."""

    regex = "(?!api(?:/|$)).*"

    def convert(self, value: str) -> str:
        return value

    def to_string(self, value: str) -> str:
        return value


def _add_page(app: FastAPI, settings: Settings) -> None:
    register_url_convertor("page", _PagePath())

    @app.api_route("/{path:page}", methods=["GET", "HEAD"], include_in_schema=False)
    async def page(path: str, request: Request) -> Response:
        """A file of the built page; an address without a suffix is one of the page's own (SPA)."""
        file = None if path == "index.html" else _static(path)
        if file is not None:
            # Vite names what it builds by content hash
            cache = "public, max-age=31536000, immutable" if path.startswith("assets/") else "no-cache"
            return await _file(file, {"Cache-Control": cache, "Vary": "Accept-Encoding"}, request)
        index = _static("index.html")
        if index is None:
            return HTMLResponse(NOT_BUILT, 503)
        if Path(path).suffix:
            raise errors.ServiceError(404, f"the page has no file /{path}", remedy="reload the page")
        # where a proxy publishes the page: everything that it asks for is beside this
        base = f'<head>\n    <base href="{settings.root_path}/" />'
        text = (await asyncio.to_thread(index.read_text, "utf-8")).replace("<head>", base, 1)
        return HTMLResponse(text, headers={"Cache-Control": "no-cache"})


async def _file(file: Path, headers: dict[str, str], request: Request) -> Response:
    """A file of the page, compressed for whoever takes it so: scripts and styles shrink to a third."""
    if file.suffix not in COMPRESSED or "gzip" not in request.headers.get("accept-encoding", ""):
        return FileResponse(file, headers=headers)
    packed = await asyncio.to_thread(_packed_now, file)
    return Response(packed, media_type=COMPRESSED[file.suffix], headers=headers | {"Content-Encoding": "gzip"})


def _packed_now(file: Path) -> bytes:
    return _packed(file, file.stat().st_mtime_ns)


@lru_cache(maxsize=64)
def _packed(file: Path, _: int) -> bytes:
    """Packed once; of a newer build, anew."""
    return gzip.compress(file.read_bytes(), mtime=0)


def _static(path: str) -> Path | None:
    """The file of the built page at this address, if there is one."""
    root = STATIC.resolve()
    try:
        file = (root / path).resolve()
        return file if file.is_relative_to(root) and file.is_file() else None
    except (OSError, ValueError):  # longer than a file name may be, or with a NUL in it
        return None
