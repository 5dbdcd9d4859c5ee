"""One simulated Franka with two blocks for the tests of a module, and an adapter that drives it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from robot_adapters.franka import FrankaSettings
from robot_adapters.franka.adapter import FrankaAdapter
from tests.live import PLUGINS
from tests.simulators.franka import SimulatedFranka
from tests.simulators.session import UNHURRIED

BLOCKS = {"block_a": 0.02, "block_b": 0.025}
TABLE = -0.112
APART = {"block_a": [0.50, 0.08, TABLE + 0.02], "block_b": [0.60, -0.06, TABLE + 0.025]}


@pytest.fixture(scope="session", autouse=True)
def _onlooker() -> None:
    """Make the double for cameras known, as a service does by PYTHONPATH."""
    if str(PLUGINS) not in sys.path:
        sys.path.insert(0, str(PLUGINS))


@pytest.fixture(scope="module")
def arm() -> Iterator[SimulatedFranka]:
    """A simulated arm at a table with two blocks; time waits for who drives it."""
    with SimulatedFranka(table=TABLE, blocks=BLOCKS) as simulated:
        yield simulated


Build = Callable[..., FrankaAdapter]


@pytest.fixture
def build(arm: SimulatedFranka) -> Iterator[Build]:
    """Makes adapters for the arm, and closes them; everything that went wrong is put right first."""
    made: list[FrankaAdapter] = []

    def make(**settings: object) -> FrankaAdapter:
        arm.tell(user_stop=False, plug=True, slippery=False, lock_step=True, heal=True, place=APART)
        given = {
            "host": arm.host,
            "realtime": False,
            "dead_man": UNHURRIED,
            "eyes": "onlooker",
            "eyes_settings": {"host": arm.host},
        }
        made.append(FrankaAdapter("stacking", FrankaSettings.model_validate(given | settings)))
        return made[-1]

    yield make
    for adapter in made:
        adapter.close()


def never() -> bool:
    """No stop."""
    return False


def nothing() -> None:
    """No hook."""


def errors(arm: SimulatedFranka, block: str, at: tuple[float, ...]) -> float:
    """M between a block and where it should be, in the table's plane."""
    return float(np.linalg.norm(np.array(arm.truth()["blocks"][block][:2]) - np.array(at[:2])))
