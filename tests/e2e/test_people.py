"""Behind a real nginx with TLS, under a sub-path, exactly as docs/people.md says: invited, judging, and let out."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, expect

from tests.e2e.test_pages import accessible, fits
from tests.e2e.trainer import START_MS
from tests.live import ROOT, LiveService, free_port, wait_for

PAGE = (ROOT / "docs" / "people.md").read_text("utf-8")
CONFIGURATION = """
daemon off; pid {folder}/pid; error_log {folder}/error.log; worker_processes 1;
events {{ worker_connections 256; }}
http {{
    access_log {folder}/access.log;
    client_body_temp_path {folder}/body; proxy_temp_path {folder}/proxy; fastcgi_temp_path {folder}/fastcgi;
    uwsgi_temp_path {folder}/uwsgi; scgi_temp_path {folder}/scgi;
    {map}
    server {{
        listen 127.0.0.1:{port} ssl;
        ssl_certificate {folder}/cert.pem; ssl_certificate_key {folder}/key.pem;
        {location}
    }}
}}
"""


@dataclass
class Published:
    """The service as the world sees it."""

    url: str
    service: LiveService
    folder: Path

    @property
    def owner_link(self) -> str:
        """What the first start has printed, at the address of the proxy; good for once."""
        (token,) = re.findall(r"/seed/join#(\S+)", self.service.log())
        return f"{self.url}/join#{token}"

    def another_link(self) -> str:
        """What the owner makes who has lost the first."""
        command = [sys.executable, "-c", "from server.cli import app; app()", "owner-token", "--data-dir"]
        told = subprocess.run([*command, self.service.data_dir], check=True, capture_output=True, text=True)
        return f"{self.url}/join#{told.stdout.strip()}"


@pytest.fixture(scope="module")
def published(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Published]:
    """Nginx in front of a service that asks who is there."""
    nginx = shutil.which("nginx") or "/usr/sbin/nginx"
    folder, port = tmp_path_factory.mktemp("nginx"), free_port()
    service = LiveService(
        tmp_path_factory.mktemp("service") / "data",
        SEED_LOGIN="1",
        SEED_ROOT_PATH="/seed",
        SEED_ALLOWED_HOSTS="localhost",
    )
    certificate = ("-subj", "/CN=localhost", "-keyout", folder / "key.pem", "-out", folder / "cert.pem")
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", *certificate],
        check=True,
        capture_output=True,
    )
    (location,) = re.findall(r"```nginx\n(.*?)```", PAGE, re.DOTALL)
    (upgrade,) = re.findall(r"`(map .*?})`", PAGE, re.DOTALL)
    (folder / "nginx.conf").write_text(
        CONFIGURATION.format(
            folder=folder,
            port=port,
            map=upgrade,
            location=location.replace("127.0.0.1:8000", f"127.0.0.1:{service.port}"),
        )
    )
    proxy = subprocess.Popen([nginx, "-p", str(folder), "-c", str(folder / "nginx.conf")])
    try:
        service.start()
        wait_for((folder / "pid").exists, "nginx to start")
        yield Published(f"https://localhost:{port}/seed", service, folder)
    finally:
        proxy.terminate()
        proxy.wait()
        service.sweep()
        service.http.close()


@pytest.fixture
def visitor(browser: Browser, published: Published) -> Iterator[Callable[[], tuple[Page, list[str]]]]:
    """Opens browsers of their own; what their pages complain of, is kept."""
    contexts: list[BrowserContext] = []

    def open_page() -> tuple[Page, list[str]]:
        context = browser.new_context(ignore_https_errors=True, reduced_motion="reduce")
        contexts.append(context)
        page, complaints = context.new_page(), list[str]()

        def note(told: ConsoleMessage) -> None:
            if told.type == "error":
                complaints.append(told.text)

        page.on("console", note)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        return page, complaints

    yield open_page
    for context in contexts:
        context.close()


def test_somebody_is_invited_judges_and_is_let_out(
    published: Published, visitor: Callable[[], tuple[Page, list[str]]]
) -> None:
    owner, complaints = visitor()
    owner.goto(published.owner_link)
    expect(owner.get_by_test_id("sign-in")).to_be_enabled()
    assert "#" not in owner.url  # the token is in no history
    owner.get_by_test_id("sign-in").click()
    owner.get_by_test_id("to-people").click()
    (cookie,) = owner.context.cookies()
    assert (cookie["path"], cookie["secure"], cookie["httpOnly"]) == ("/seed", True, True)
    experiment = owner.evaluate(
        """async () => (await (await fetch("api/v1/experiments", {method: "POST",
        headers: {"Content-Type": "application/json"}, body: JSON.stringify(
        {name: "together", task: "stacking", adapter: "kinematic", algorithm: "scripted"})})).json()).id"""
    )
    owner.evaluate("id => fetch(`api/v1/experiments/${id}/start`, {method: 'POST'})", experiment)
    owner.get_by_label("Only experiment").fill(str(experiment))
    owner.get_by_test_id("invite").click()
    link = owner.get_by_test_id("link").inner_text()
    assert link.startswith(f"{published.url}/join#")
    accessible(owner)

    ann, complaints_of_ann = visitor()
    ann.set_viewport_size({"width": 390, "height": 844})
    ann.goto(link)
    expect(ann.get_by_label("Your name")).to_be_visible()
    fits(ann)
    accessible(ann)
    ann.get_by_label("Your name").fill("Ann")
    ann.get_by_test_id("sign-in").click()
    ann.get_by_role("link", name="together").first.click()
    expect(ann).to_have_url(f"{published.url}/experiments/{experiment}")
    expect(ann.get_by_test_id("views")).to_have_attribute("data-ready", "true", timeout=START_MS)
    ann.keyboard.press("3")
    query = "SELECT value, name FROM feedback JOIN trainer ON trainer.id = trainer_id"
    assert [tuple(row) for row in wait_for(lambda: published.service.rows(query), "the click")] == [(-1, "Ann")]

    row = owner.get_by_test_id("person").filter(has_text="Ann")
    expect(row).to_contain_text(f"on-line in experiment {experiment}", timeout=START_MS)
    assert complaints == complaints_of_ann == []
    row.get_by_test_id("let-out").click()
    owner.get_by_test_id("let-out-yes").click()
    expect(row).to_contain_text("let out")
    expect(ann.get_by_test_id("sign-in")).to_be_visible()

    with owner.expect_download() as audit:
        owner.get_by_test_id("audit").click()
    decisions = audit.value.path().read_text("utf-8")
    assert [action for action in re.findall(r",(\w+),\"", decisions) if action in {"clicked", "revoked"}] == [
        "clicked",
        "revoked",
    ]
    token = link.partition("#")[2]
    for log in (published.service.log(), *(file.read_text("utf-8") for file in published.folder.glob("*.log"))):
        assert token not in log


def test_a_viewer_sees_everything_and_judges_nothing(
    published: Published, visitor: Callable[[], tuple[Page, list[str]]]
) -> None:
    owner, _ = visitor()
    owner.goto(published.another_link())
    owner.get_by_test_id("sign-in").click()
    owner.get_by_test_id("to-people").click()
    owner.get_by_label("Role", exact=True).select_option("viewer")
    owner.get_by_test_id("invite").click()
    viewer, _ = visitor()
    viewer.goto(owner.get_by_test_id("link").inner_text())
    viewer.get_by_label("Your name").fill("Vic")
    viewer.get_by_test_id("sign-in").click()
    viewer.get_by_role("link", name="together").first.click()
    expect(viewer.get_by_test_id("activity")).to_contain_text("viewer", timeout=START_MS)
    expect(viewer.get_by_test_id("views")).to_have_attribute("data-proposal-id", re.compile("."), timeout=START_MS)
    viewer.keyboard.press("1")
    expect(viewer.get_by_text("judge nothing").last).to_be_visible()
    assert (
        published.service.rows("SELECT name FROM feedback JOIN trainer ON trainer.id = trainer_id WHERE name = 'Vic'")
        == []
    )
    viewer.goto(f"{published.url}/people")
    expect(viewer.get_by_role("heading", name="There is no such page")).to_be_visible()
