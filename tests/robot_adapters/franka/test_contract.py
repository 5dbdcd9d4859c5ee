"""The contract of every adapter, kept by the Franka's on the simulated arm; somebody lays the blocks out."""

from __future__ import annotations

from typing import ClassVar

import pytest

from robot_adapters.contract import AdapterContract
from tests.robot_adapters.franka.conftest import APART, BLOCKS, TABLE
from tests.simulators.franka import SimulatedFranka
from tests.simulators.session import UNHURRIED

pytestmark = pytest.mark.simulated_arm


class OnTheArm(AdapterContract):
    adapter_name = "franka"
    task_name = "stacking"
    backend: ClassVar[str]
    lab: ClassVar[SimulatedFranka]

    @classmethod
    def setup_class(cls) -> None:
        cls.lab = SimulatedFranka(table=TABLE, blocks=BLOCKS)
        cls.lab.tell(place=APART)
        host = cls.lab.host
        eyes = {"eyes": "onlooker", "eyes_settings": {"host": host}}
        cls.settings = {"host": host, "backend": cls.backend, "realtime": False, "dead_man": UNHURRIED, **eyes}
        super().setup_class()

    @classmethod
    def teardown_class(cls) -> None:
        super().teardown_class()
        cls.lab.close()

    def setup_method(self) -> None:
        self.lab.tell(heal=True, place=APART)
        super().setup_method()


class TestFrankaRs(OnTheArm):
    backend = "franka_rs"


@pytest.mark.long
class TestFranky(OnTheArm):
    backend = "franky"
