"""The adapter keeps the contract of every adapter, for all of its tasks."""

from __future__ import annotations

from robot_adapters import registry
from robot_adapters.contract import AdapterContract
from tests.robot_adapters.robosuite.conftest import shared


class SharedContract(AdapterContract):
    """The contract with the adapter that the other tests of this folder use too."""

    adapter_name = "robosuite"

    @classmethod
    def setup_class(cls) -> None:
        """Take the adapter."""
        cls.task = registry.task(cls.task_name)
        cls.adapter = shared(cls.task_name)

    @classmethod
    def teardown_class(cls) -> None:
        """Leave it open for the next."""


class TestRobosuiteReaching(SharedContract):
    task_name = "reaching"


class TestRobosuiteStacking(SharedContract):
    task_name = "stacking"


class TestRobosuiteSweeping(SharedContract):
    task_name = "sweeping"


class TestRobosuiteCollectingToy(SharedContract):
    task_name = "collecting_toy"


class TestRobosuiteCookingHotdog(SharedContract):
    task_name = "cooking_hotdog"


def test_every_task_of_the_adapter_is_held_to_the_contract() -> None:
    held = {contract.task_name for contract in SharedContract.__subclasses__()}
    assert held == set(registry.adapter("robosuite").tasks)
