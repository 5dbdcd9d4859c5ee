"""Settings: from the environment, checked, and all of them documented."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from server.errors import ServiceError
from server.origin import check_bind
from server.settings import Settings, documentation

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_the_settings_page_lists_every_setting() -> None:
    page = (DOCS / "settings.md").read_text("utf-8")
    assert page == documentation(), (
        "docs/settings.md is out of step: write it anew with "
        "python -c 'from server.settings import documentation; print(documentation(), end=str())' > docs/settings.md"
    )


def test_every_setting_says_what_it_means() -> None:
    assert not [name for name, field in Settings.model_fields.items() if not field.description]


def test_settings_come_from_the_environment_and_arguments_win(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SEED_PORT", "9000")
    monkeypatch.setenv("SEED_ALLOWED_HOSTS", "a.example, B.example ,")
    assert Settings().port == 9000
    assert Settings(port=9001).port == 9001
    assert Settings().allowed_hosts == ("a.example", "b.example")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("PORT", "70000"),
        ("PORT", "http"),
        ("LOG_LEVEL", "loud"),
        ("CHECKPOINT_EVERY", "0"),
        ("LOGIN", "perhaps"),
    ],
)
def test_a_wrong_value_is_an_error_that_names_its_setting(
    monkeypatch: pytest.MonkeyPatch, name: str, value: str
) -> None:
    monkeypatch.setenv(f"SEED_{name}", value)
    with pytest.raises(ValidationError) as refused:
        Settings()
    assert refused.value.errors()[0]["loc"] == (name.lower(),)


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.1.5", "robot.lab.example"])
def test_an_address_that_others_reach_is_refused_without_a_login(host: str) -> None:
    with pytest.raises(ServiceError) as refused:
        check_bind(Settings(host=host))
    assert "ssh -L" in refused.value.remedy
    assert "SEED_LOGIN=1" in refused.value.remedy
    check_bind(Settings(host=host, login=True))


def test_a_name_under_which_others_reach_it_is_refused_without_a_login() -> None:
    for names in ("lab.example", "localhost, lab.example:8443"):
        with pytest.raises(ServiceError, match=r"lab\.example") as refused:
            check_bind(Settings(allowed_hosts=names))
        assert "SEED_LOGIN=1" in refused.value.remedy
        check_bind(Settings(allowed_hosts=names, login=True))
    check_bind(Settings(allowed_hosts="localhost:8443"))


@pytest.mark.parametrize("host", ["127.0.0.1", "127.0.0.2", "localhost", "::1"])
def test_loopback_needs_no_permission(host: str) -> None:
    check_bind(Settings(host=host))
