"""`--set` on the command line: which field of an experiment a setting becomes, and what is no setting."""

from __future__ import annotations

import pytest

from server.cli_set import settings_from


def test_settings_become_fields_of_an_experiment() -> None:
    changes = [
        "teacher.noise=0.1",
        "algorithm.batch_size=32",
        "adapter.draw=false",
        "adapter.stepping=native",
        "adapter.layout.x=[0.5, 0.6]",
        "adapter.layout.y=[0, 0.1]",
        "teacher.noise=0.2",
    ]
    assert settings_from(changes) == {
        "teacher_settings": {"noise": 0.2},
        "settings": {"batch_size": 32},
        "adapter_settings": {"draw": False, "stepping": "native", "layout": {"x": [0.5, 0.6], "y": [0, 0.1]}},
    }
    assert settings_from([]) == {}


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        (["noise=0.1"], "PART.NAME=VALUE"),
        (["teacher.noise"], "PART.NAME=VALUE"),
        (["teacher.=1"], "PART.NAME=VALUE"),
        (["adapter.layout..x=1"], "PART.NAME=VALUE"),
        (["=1"], "PART.NAME=VALUE"),
        (["robot.speed=1"], "algorithm, adapter, teacher"),
        (["adapter.layout=1", "adapter.layout.x=[0, 1]"], "has a value already"),
    ],
)
def test_what_is_no_setting_is_told(changes: list[str], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        settings_from(changes)
