"""The kinematic adapter keeps the contract of every adapter."""

from robot_adapters.contract import AdapterContract


class TestStacking(AdapterContract):
    adapter_name = "kinematic"
    task_name = "stacking"


class TestReaching(AdapterContract):
    adapter_name = "kinematic"
    task_name = "reaching"


class TestSweeping(AdapterContract):
    adapter_name = "kinematic"
    task_name = "sweeping"


class TestCollectingToy(AdapterContract):
    adapter_name = "kinematic"
    task_name = "collecting_toy"


class TestCookingHotdog(AdapterContract):
    adapter_name = "kinematic"
    task_name = "cooking_hotdog"


class TestPaced(AdapterContract):
    """Skills that take their time keep it too."""

    adapter_name = "kinematic"
    task_name = "stacking"
    settings = {"step_seconds": 0.0005}  # noqa: RUF012  the base class declares it


class TestWithoutCameras(AdapterContract):
    adapter_name = "kinematic"
    task_name = "stacking"
    settings = {"draw": False}  # noqa: RUF012  the base class declares it
