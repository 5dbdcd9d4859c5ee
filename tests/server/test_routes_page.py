"""The web page: served where it is built, explained where it isn't; and the probes beside it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.server.serving import serving
from tests.server.test_errors import check_problem


async def test_without_a_built_page_the_service_says_how_to_build_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("server.app.STATIC", tmp_path / "nothing")
    async with serving(tmp_path / "data") as live:
        answer = await live.http.get("/")
        assert answer.status_code == 503
        assert "make run" in answer.text
        assert (await live.http.get("/ready")).json() == {"ready": True, "checks": {"store": "ok", "workers": "ok"}}


async def test_the_page_answers_at_its_own_addresses(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = tmp_path / "static"
    (page / "assets").mkdir(parents=True)
    (page / "index.html").write_text("<title>SEED</title>")
    (page / "assets" / "index-1a2b.js").write_text("export {}")
    (tmp_path / "secret.txt").write_text("between us")
    monkeypatch.setattr("server.app.STATIC", page)
    async with serving(tmp_path / "data") as live:
        for address in ("/", "/experiments/7", "/anything"):
            answer = await live.http.get(address)
            assert (answer.status_code, answer.text) == (200, "<title>SEED</title>")
            assert answer.headers["cache-control"] == "no-cache"
        assert (await live.http.head("/")).status_code == 200
        script = await live.http.get("/assets/index-1a2b.js")
        assert script.headers["content-type"].startswith("text/javascript")
        assert "immutable" in script.headers["cache-control"]
        check_problem(await live.http.get("/assets/index-gone.js"), 404)
        check_problem(await live.http.post("/"), 405)
        assert "between us" not in (await live.http.get("/..%2fsecret.txt")).text


async def test_the_api_page_needs_nothing_but_the_service(tmp_path: Path) -> None:
    async with serving(tmp_path / "data") as live:
        page = await live.http.get("/docs")
        assert page.status_code == 200
        addresses = re.findall(r'(?:src|href)="([^"]+)"', page.text)
        assert any(a.endswith(".js") for a in addresses)
        assert any(a.endswith(".css") for a in addresses)
        for address in addresses:
            assert address.startswith("/")
            assert (await live.http.get(address)).status_code == 200
