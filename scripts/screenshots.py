"""Takes the pictures in docs/screenshots: every page, by day and by night, on a desk and on a phone.

`make screenshots` starts a service of its own on robosuite with a login, judges a few proposals as the task's rule
would, has a noisy teacher judge some experiments on a table without physics, runs a small study, invites people, and
looks. A new page of the console is added to PAGES. Look at the pictures before you commit them.
"""

from __future__ import annotations

import argparse
import itertools
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import httpx
import numpy as np
from playwright.sync_api import Browser, Page, sync_playwright

from robot_adapters.base import SkillCall
from robot_adapters.registry import task as task_by_name

OUT = Path(__file__).parent.parent / "docs" / "screenshots"
SIZES = {"desk": (1440, 900), "phone": (390, 844)}
THEMES = ("dark", "light")
QUALITY = 80
FLAGS = ("--no-sandbox", "--disable-dev-shm-usage", "--disable-background-networking", "--disable-component-update")
SEED = (sys.executable, "-c", "from server.cli import app; app()")
TASK = "stacking"
CLICKS = 14
TAUGHT = (60, 120, 180)
"""Labels of a teacher before each evaluation."""
STUDY = "first-subgoal"
PATIENCE = 300.0
ALL_LOADED = """() => [...document.images].every((image) => {
    const at = image.getBoundingClientRect()
    return image.complete || at.top > innerHeight || at.left > innerWidth || at.right < 0
})"""
"""Whether every picture in sight has come."""


def _as_it_is(page: Page) -> None:
    page.wait_for_load_state("networkidle")
    page.locator("h1").first.wait_for()
    page.wait_for_function("() => !document.querySelector('.skeleton[role=status]')")


def _ready(page: Page) -> None:
    page.wait_for_selector("[data-ready]", timeout=PATIENCE * 1000)
    page.wait_for_function(ALL_LOADED)


def _with_everything(page: Page) -> None:
    _ready(page)
    for key in "gwd":
        page.keyboard.press(key)
    page.wait_for_selector("[data-testid=scene][data-ready=true]")
    page.get_by_test_id("operator").locator("summary").click()
    page.evaluate("scrollTo(0, 0)")


def _charted(page: Page) -> None:
    _as_it_is(page)
    page.wait_for_selector(".plot .uplot")


def _seen(page: Page) -> None:
    _as_it_is(page)
    page.wait_for_function(ALL_LOADED)


def _settings(page: Page) -> None:
    _as_it_is(page)
    page.get_by_test_id("part-settings").locator("summary").click()


def _asked(page: Page) -> None:
    page.wait_for_selector("[data-testid=critic-picture]", timeout=PATIENCE * 1000)
    _seen(page)


def _operating(page: Page) -> None:
    _ready(page)
    panel = page.get_by_test_id("operator")
    panel.locator("summary").click()
    page.get_by_test_id("gripper-at").wait_for()
    panel.scroll_into_view_if_needed()


def _asked_for_a_name(page: Page) -> None:
    _as_it_is(page)
    page.locator("[name=name]").fill("Ann")


def _studied(page: Page) -> None:
    _as_it_is(page)
    page.wait_for_selector("[data-testid=study-chart] canvas")
    page.wait_for_function(ALL_LOADED)


def _considered(page: Page) -> None:
    _ready(page)
    page.locator("[data-chosen=false] [data-testid=choice]").first.hover()
    page.get_by_test_id("considered-overlay").first.wait_for(state="attached")


def _past(page: Page) -> None:
    _ready(page)
    page.get_by_test_id("past").nth(1).click()
    _as_it_is(page)


PAGES: dict[str, tuple[str, Callable[[Page], None]]] = {
    "experiments": ("/", _as_it_is),
    "trainer": ("/experiments/1", _ready),
    "trainer-tools": ("/experiments/1", _with_everything),
    "trainer-choices": ("/experiments/1", _considered),
    "trainer-past": ("/experiments/1", _past),
    "operator": ("/experiments/1", _operating),
    "practice": ("/experiments/1/practice", _seen),
    "new": ("/experiments/new?from=2", _settings),
    "results": ("/experiments/2/results", _charted),
    "compare": (
        "/compare?experiment=2&experiment=3&experiment=4&experiment=5&measure=successes&by=algorithm&by=preset",
        _charted,
    ),
    "gallery": ("/experiments/2/gallery?purpose=training", _seen),
    "episode": ("/experiments/2/episodes/3", _seen),
    "critic": ("/experiments/2/critic", _asked),
    "cameras": ("/experiments/1/cameras", _as_it_is),
    "studies": ("/studies", _as_it_is),
    "study": (f"/studies/{STUDY}", _studied),
    "people": ("/people", _as_it_is),
    "sign-in": ("/join", _asked_for_a_name),
}
"""Name -> path, and what makes it ready to be looked at."""


@contextmanager
def service(folder: Path) -> Iterator[httpx.Client]:
    """A service of its own that asks who is there, and its owner's way in."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    settings = {"SEED_PORT": str(port), "SEED_DATA_DIR": str(folder), "SEED_CREATE_FIRST_EXPERIMENT": "false"}
    environment = os.environ | settings | {"SEED_LOGIN": "1"}
    token = subprocess.run([*SEED, "owner-token"], env=environment, check=True, capture_output=True, text=True).stdout
    process = subprocess.Popen([*SEED, "serve"], env=environment)
    try:
        carried = {"Authorization": f"Bearer {token.strip()}"}
        with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60, headers=carried) as http:
            _until(lambda: _answers(http), "the service")
            yield http
    finally:
        process.terminate()
        process.wait(timeout=60)


def _answers(http: httpx.Client) -> bool:
    try:
        return http.get("/ready").status_code == httpx.codes.OK
    except httpx.TransportError:
        return False


def _until(condition: Callable[[], bool], what: str) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f"{what} isn't there after {PATIENCE:g} s")
        time.sleep(0.1)


def judge(http: httpx.Client) -> None:
    """Start an experiment, and judge its first proposals by the task's own rule."""
    body = {"name": "Stack two blocks", "task": TASK, "adapter": "robosuite", "algorithm": "seed"}
    http.post("/api/v1/experiments", json=body).raise_for_status()
    http.post("/api/v1/experiments/1/start").raise_for_status()
    task = task_by_name(TASK)
    names = {spec.name: [p.name for p in spec.parameters] for spec in task.skills}
    for number in itertools.count(1):
        _until(partial(_open, http, number), f"proposal {number}")
        if number > CLICKS:
            return
        proposal = http.get("/api/v1/experiments/1/proposals?limit=1").json()["items"][0]
        call = SkillCall(proposal["skill"], tuple(proposal["parameters"][p] for p in names[proposal["skill"]]))
        click = {"click_id": f"picture-{number:04}", "value": task.judge(np.array(proposal["state"]), call)}
        http.post(f"/api/v1/proposals/{proposal['id']}/feedback", json=click).raise_for_status()


def teach(http: httpx.Client) -> None:
    """Experiments that a noisy teacher judged: two seeds of each of two presets, evaluated once."""
    for preset, seed in itertools.product(("recommended", "paper_sim"), (0, 1)):
        body = {
            "name": f"Sweep the cube, {preset}",
            "task": "sweeping",
            "adapter": "kinematic",
            "preset": preset,
            "settings": {"hidden_size": 64},
            "teacher": "noisy",
            "seed": seed,
            "tags": ["sweep", preset],
        }
        made = http.post("/api/v1/experiments", json=body).raise_for_status().json()["id"]
        address = f"/api/v1/experiments/{made}"
        for labels in TAUGHT:
            http.post(f"{address}/{'start' if labels == TAUGHT[0] else 'resume'}").raise_for_status()
            _until(partial(_counted, http, address, labels), f"label {labels}")
            http.post(f"{address}/pause").raise_for_status()
            _until(partial(_idle, http, address), "the pause")
            http.post(f"{address}/evaluate", json={"rollouts": 10}).raise_for_status()
            _until(partial(_evaluated, http, address), "the evaluation")
        if seed == 0:
            http.post(f"{address}/finish").raise_for_status()


def study(folder: Path) -> subprocess.Popen[bytes]:
    """Begin a small study in the data directory, in a process of its own."""
    small = ("--seeds", "2", "--budget", "24", "--evaluations", "3", "--rollouts", "3", "--adapter", "kinematic")
    chosen = ("--tasks", "first_subgoal", "--algorithms", "seed,maple-aff", "--out", str(folder / "studies" / STUDY))
    return subprocess.Popen([*SEED, "study", "paper-sim", *small, *chosen], stderr=subprocess.DEVNULL)


def invite(http: httpx.Client) -> str:
    """Let a trainer and a viewer in; the token of another invitation, not yet used."""
    token = ""
    for name, role, note in (("Ann", "trainer", "the lab course"), ("Vic", "viewer", "visitors"), ("", "trainer", "")):
        body = {"role": role, "note": note, "uses": 5, "hours": 24}
        token = http.post("/api/v1/invitations", json=body).raise_for_status().json()["token"]
        if name:
            http.post("/api/v1/sign-in", json={"token": token, "name": name, "bearer": True}).raise_for_status()
    return token


def _counted(http: httpx.Client, address: str, labels: int) -> bool:
    return bool(http.get(address).json()["counters"]["feedback"] >= labels)


def _idle(http: httpx.Client, address: str) -> bool:
    return bool(http.get(address).json()["phase"] == "idle")


def _evaluated(http: httpx.Client, address: str) -> bool:
    newest = http.get(f"{address}/evaluations?limit=1").json()["items"][0]
    return newest["ended_at"] is not None and _idle(http, address)


def _open(http: httpx.Client, number: int) -> bool:
    items = http.get("/api/v1/experiments/1/proposals?limit=1").json()["items"]
    return bool(items) and items[0]["number"] == number and items[0]["closed_at"] is None


def look(browser: Browser, http: httpx.Client, invitation: str, names: list[str]) -> None:
    """Take every picture of these pages."""
    url = str(http.base_url)
    owner = http.headers["Authorization"].removeprefix("Bearer ")
    for name, theme, (size, (width, height)) in itertools.product(names, THEMES, SIZES.items()):
        path, prepare = PAGES[name]
        context = browser.new_context(
            viewport={"width": width, "height": height}, color_scheme="dark" if theme == "dark" else "light"
        )
        page = context.new_page()
        page.add_init_script("""localStorage.setItem("seed.judging", '{"toured": true}')""")
        if name == "sign-in":
            path += f"#{invitation}"
        else:
            context.request.post(f"{url}/api/v1/sign-in", data={"token": owner})
        page.goto(url + path)
        prepare(page)
        target = OUT / f"{name}-{size}-{theme}.jpg"
        page.screenshot(path=target, type="jpeg", quality=QUALITY, animations="disabled")
        print(target.relative_to(OUT.parent.parent))
        context.close()


def main() -> None:
    """Parse the command line, start, judge, look."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", nargs="*", help=f"one or more of: {', '.join(PAGES)}; none: all")
    names = parser.parse_args().page or list(PAGES)
    if unknown := set(names) - set(PAGES):
        parser.error(f"no page named {', '.join(sorted(unknown))}")
    OUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, service(Path(folder)) as http, sync_playwright() as playwright:
        studying = study(Path(folder))
        judge(http)
        teach(http)
        invitation = invite(http)
        if studying.wait():
            raise SystemExit("the study failed")
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(FLAGS))
        look(browser, http, invitation, names)
        browser.close()


if __name__ == "__main__":
    main()
