"""Pages of other ports, and people of other machines: what a cookie or the lack of a login would let in."""

from __future__ import annotations

from pathlib import Path

import httpx
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus
from websockets.typing import Origin

from server.doors import COOKIE
from tests.server.serving import Serving, event, serving
from tests.server.test_errors import check_problem
from tests.server.test_people import House, experiment, house

PROXIED = {"X-Forwarded-For": "127.0.0.1", "X-Forwarded-Proto": "https"}
"""What a proxy of this machine that speaks TLS says."""
REFUSED = {
    "another port": ("https://lab.example:8888", "lab.example", PROXIED),
    "another port, where the service has one too": ("https://lab.example:8888", "lab.example:8443", PROXIED),
    "no port, where the service has one": ("https://lab.example", "lab.example:8443", PROXIED),
    "plain HTTP": ("http://lab.example", "lab.example", PROXIED),
    "the port of plain HTTP": ("https://lab.example:80", "lab.example", PROXIED),
    "another name": ("https://lab.example.evil.example", "lab.example", PROXIED),
    "no address": ("https://[lab.example", "lab.example", PROXIED),
    "a file": ("file://lab.example", "lab.example", PROXIED),
}
TAKEN = {
    "the same": ("https://lab.example", "lab.example", PROXIED),
    "a port that goes without saying": ("https://lab.example", "lab.example:443", PROXIED),
    "the same with a port": ("https://lab.example:8443", "lab.example:8443", PROXIED),
    "a proxy that keeps its port to itself": ("https://other.example:9443", "other.example", PROXIED),
    "a proxy that names another host": ("https://lab.example", "127.0.0.1:8000", PROXIED),
    "a proxy that doesn't say that it speaks TLS": ("https://lab.example", "lab.example", {}),
}
# origin of a page, Host that the proxy passes on, what else it says


async def _try(live: Serving, cookie: str, here: int, case: tuple[str, str, dict[str, str]]) -> tuple[int, int]:
    """Status of a verb by REST, and of a stream's handshake (101: open), with the operator's cookie."""
    origin, host, said = case
    headers = {"Origin": origin, "Host": host, "Cookie": cookie} | said
    path = f"/api/v1/experiments/{here}"
    posted = await live.http.post(f"{path}/pause", headers=headers)
    port = httpx.URL(live.url).port
    stream = connect(
        f"ws://{host}{path}/stream",
        host="127.0.0.1",
        port=port,
        additional_headers={"Cookie": cookie} | said,
        origin=Origin(origin),
    )
    try:
        async with stream as page:
            await event(page, "snapshot")
    except InvalidStatus as refused:
        return posted.status_code, refused.response.status_code
    return posted.status_code, 101


async def test_a_page_of_another_port_of_the_same_name_acts_by_nobody_s_cookie(tmp_path: Path) -> None:
    async with house(tmp_path, allowed_hosts="lab.example, other.example:9443") as home:
        here = await experiment(home)
        answer = await home.live.http.post("/api/v1/sign-in", json={"token": home.owner_token})
        cookie = f"{COOKIE}={answer.cookies[COOKIE]}"
        home.live.http.cookies.clear()
        for why, case in REFUSED.items():
            assert await _try(home.live, cookie, here, case) == (403, 403), why
        for why, case in TAKEN.items():
            # 409: an experiment that was never started can't be paused
            assert await _try(home.live, cookie, here, case) == (409, 101), why


async def test_without_a_login_a_proxy_lets_nobody_in_but_who_sits_at_this_machine(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        here = await live.experiment()
        for address in ("203.0.113.9", "2001:db8::9", "10.0.0.7"):
            told = {"X-Forwarded-For": address}
            refused = check_problem(await live.http.post(f"/api/v1/experiments/{here}/start", headers=told), 403)
            assert refused.type == "/problems/no-login"
            assert "SEED_LOGIN=1" in str(refused.remedy)
            assert (await live.http.get("/", headers=told)).status_code == 403
            with pytest.raises(InvalidStatus) as denied:
                async with live.stream(here, additional_headers=told):
                    pass
            assert denied.value.response.status_code == 403
        for address in ("127.0.0.1", "::1", "127.8.0.1"):
            answer = await live.http.get(f"/api/v1/experiments/{here}", headers={"X-Forwarded-For": address})
            assert answer.json()["lifecycle"] == "created"


async def test_with_a_login_a_proxy_s_visitors_are_asked_who_they_are(tmp_path: Path) -> None:
    async with house(tmp_path) as home:
        answer: httpx.Response = await home.owner.get("/api/v1/me", headers={"X-Forwarded-For": "203.0.113.9"})
        assert answer.json()["name"] == "owner"


async def test_strangers_behind_a_proxy_are_counted_by_the_address_that_it_names(tmp_path: Path) -> None:
    def told(*addresses: str) -> dict[str, str]:
        return {"X-Forwarded-For": ", ".join(addresses)}

    async def asked(home: House, headers: dict[str, str]) -> int:
        answer: httpx.Response = await home.live.http.get("/api/v1/experiments", headers=headers)
        return answer.status_code

    async with house(tmp_path / "trusted", rate_limit="5/hour") as home:
        # whatever a stranger writes before it, the address that counts is the one that the proxy has added
        many = [await asked(home, told(f"198.51.100.{n}", "203.0.113.9")) for n in range(6)]
        assert many == [401] * 5 + [429]
        assert await asked(home, told("203.0.113.10")) == 401, "another one behind the same proxy"
        assert (await home.owner.get("/api/v1/me", headers=told("203.0.113.9"))).status_code == 200
    async with house(tmp_path / "unknown", rate_limit="5/hour", trusted_proxies="192.0.2.1") as home:
        many = [await asked(home, told(f"198.51.100.{n}")) for n in range(6)]
        assert many == [401] * 5 + [429], "nobody whom we don't know says who asks"
