"""The wheel that a user installs holds page and migrations, and serves them; the container's files are sound."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from scripts.check_dockerfile import Dockerfile
from tests.live import ROOT, LiveService


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of this source tree, built as pip builds it."""
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)],
        cwd=ROOT,
        check=True,
        capture_output=True,
    )
    (built,) = folder.glob("*.whl")
    return built


def test_the_wheel_holds_page_migrations_and_nothing_of_the_workshop(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert "server/static/index.html" in names
    assert any(name.startswith("server/static/assets/") and name.endswith(".js") for name in names)
    assert [name for name in names if name.startswith("server/migrations/versions/") and name.endswith(".py")]
    roots = {name.split("/")[0] for name in names}
    assert roots == {"agent", "robot_adapters", "server", next(r for r in roots if r.endswith(".dist-info"))}


def test_the_installed_wheel_serves_the_page(wheel: Path, tmp_path: Path) -> None:
    installed = tmp_path / "site"
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", str(installed), str(wheel)]
    subprocess.run(pip, check=True, capture_output=True)
    live = LiveService(tmp_path / "data", PYTHONPATH=str(installed))
    try:
        live.start()
        page = live.http.get("/")
        assert page.status_code == 200
        assert '<div id="root">' in page.text
        where = subprocess.run(
            [sys.executable, "-c", "import server; print(server.__file__)"],
            env={"PYTHONPATH": str(installed)},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        assert where.startswith(str(installed))
        live.stop()
    finally:
        live.sweep()
        live.http.close()


def test_the_image_runs_unprivileged_and_says_whether_it_is_healthy() -> None:
    last = Dockerfile.read(ROOT / "Dockerfile").stages[-1]
    assert last.value("USER") not in {None, "root", "0"}
    assert "/health" in (last.value("HEALTHCHECK") or "")
    assert "seed" in (last.value("CMD") or "")


def test_compose_publishes_on_loopback_only() -> None:
    published = re.findall(r'- "(\S*:8000)"', (ROOT / "compose.yaml").read_text("utf-8"))
    assert published == ["127.0.0.1:8000:8000"]
