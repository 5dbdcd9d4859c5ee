"""The adapter keeps the contract of every adapter, for both of its tasks."""

from __future__ import annotations

from robot_adapters.contract import AdapterContract


class TestRobosuiteReaching(AdapterContract):
    adapter_name = "robosuite"
    task_name = "reaching"


class TestRobosuiteStacking(AdapterContract):
    adapter_name = "robosuite"
    task_name = "stacking"
