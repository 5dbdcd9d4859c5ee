"""The catalogue over HTTP, and what it says to a wrong experiment."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.server.serving import EXPERIMENT, serving
from tests.server.test_errors import check_problem

WRONG: list[tuple[dict[str, Any], str, str]] = [
    ({"task": "juggling"}, "task", "stacking"),
    ({"adapter": "ur5"}, "adapter", "kinematic"),
    ({"algorithm": "dqn"}, "algorithm", "seed"),
    ({"preset": "fast"}, "preset", "paper_sim"),
    ({"teacher": "mother"}, "teacher", "synthetic"),
    ({"settings": {"batchsize": 1}}, "settings.batchsize", "batch_size"),
    ({"settings": {"batch_size": "many"}}, "settings.batch_size", ""),
    ({"settings": {"batch_size": 0}}, "settings.batch_size", ""),
    ({"settings": {"batch_size": 1.5}}, "settings.batch_size", ""),
    ({"settings": {"batch_size": None}}, "settings.batch_size", ""),
    ({"settings": {"learning_rate": -1}}, "settings.learning_rate", ""),
    ({"settings": []}, "settings", ""),
    ({"adapter_settings": {"gravity": 1}}, "adapter_settings.gravity", ""),
    ({"teacher_settings": {"noise": 0.1}}, "teacher_settings", "synthetic"),
    ({"teacher": "noisy", "teacher_settings": {"nois": 0.1}}, "teacher_settings.nois", "noise"),
    ({"teacher": "noisy", "teacher_settings": {"noise": 1.1}}, "teacher_settings.noise", "noise"),
    ({"teacher": "delayed", "teacher_settings": {"delay": -1}}, "teacher_settings.delay", ""),
    ({"teacher": "skipping", "teacher_settings": {"skip_within": "far"}}, "teacher_settings.skip_within", ""),
    ({"adapter_settings": {"layout": {"block_a_x": [0.5, 0.6]}}}, "adapter_settings.layout.block_a_x", "x, y"),
    ({"adapter_settings": {"layout": {"x": [0.6, 0.5]}}}, "adapter_settings.layout.x", "x, y"),
    ({"adapter_settings": {"layout": {"x": [0.6]}}}, "adapter_settings.layout.x.1", "x, y"),
    ({"adapter_settings": {"layout": {"x": "wide"}}}, "adapter_settings.layout.x", "x, y"),
    ({"adapter_settings": {"layout": {"x": [0.5, 0.5], "y": [0, 0]}}}, "adapter_settings.layout", "x, y"),
    ({"adapter_settings": {"layout": [0.5, 0.6]}}, "adapter_settings.layout", ""),
    ({"adapter": "robosuite", "adapter_settings": {"layout": {"z": [0, 1]}}}, "adapter_settings.layout.z", "x, y"),
    (
        {"task": "sweeping", "adapter_settings": {"layout": {"x": [0.5, 0.6]}}},
        "adapter_settings.layout.x",
        "toy_y",
    ),
    ({"aggregation": "loudest"}, "aggregation", ""),
    ({"mode": "fly"}, "mode", ""),
    ({"seed": -1}, "seed", ""),
    ({"seed": 1.5}, "seed", ""),
    ({"seed": True}, "seed", ""),
    ({"name": ""}, "name", ""),
    ({"name": "x" * 200}, "name", ""),
    ({"name": None}, "name", ""),
    ({"feedback_timeout": 0}, "feedback_timeout", ""),
    ({"owner": "me"}, "owner", ""),
]


async def test_the_catalogue_lists_what_an_experiment_may_name(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        tasks = {t["name"]: t for t in (await live.http.get("/api/v1/tasks")).json()}
        adapters = {a["name"]: a for a in (await live.http.get("/api/v1/adapters")).json()}
        algorithms = {a["name"]: a for a in (await live.http.get("/api/v1/algorithms")).json()}
        assert {"reaching", "stacking"} <= set(tasks)
        assert [f["size"] for f in tasks["stacking"]["state"]]
        assert sum(f["size"] for f in tasks["stacking"]["state"]) == 6  # the paper's vector
        assert sum(f["size"] for f in tasks["reaching"]["state"]) == 4
        assert {"reaching", "stacking"} <= set(adapters["kinematic"]["tasks"])
        assert adapters["kinematic"]["simulated"] is True
        assert {"recommended", "paper_sim", "paper_real"} <= set(algorithms["seed"]["presets"])
        described = algorithms["seed"]["settings_schema"]["properties"]
        assert all(field["description"] for field in described.values())
        teachers = {t["name"]: t for t in (await live.http.get("/api/v1/teachers")).json()}
        assert {"synthetic", "noisy", "skipping", "delayed"} <= set(teachers)
        for teacher in teachers.values():
            assert all(field["description"] for field in teacher["settings_schema"]["properties"].values())
        defaults = {
            n: {k: f["default"] for k, f in t["settings_schema"]["properties"].items()} for n, t in teachers.items()
        }
        assert set(defaults["synthetic"].values()) == {0.0}
        assert defaults["noisy"]["noise"] > 0
        assert defaults["skipping"]["skip_within"] > 0
        assert defaults["delayed"]["delay"] > 0
        kinds = (("tasks", tasks), ("adapters", adapters), ("algorithms", algorithms), ("teachers", teachers))
        for kind, names in kinds:
            for name, body in names.items():
                assert (await live.http.get(f"/api/v1/{kind}/{name}")).json() == body


async def test_a_wrong_experiment_is_told_which_field_and_what_to_do(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        for change, field, known in WRONG:
            told = check_problem(await live.http.post("/api/v1/experiments", json=EXPERIMENT | change), 422)
            assert field in [f.field for f in told.fields], (change, told)
            assert known in told.remedy, (change, told)
        missing = check_problem(await live.http.post("/api/v1/experiments", json={}), 422)
        assert {f.field for f in missing.fields} == {"name", "task"}
        not_finite = '{"name": "x", "task": "stacking", "adapter": "kinematic", "settings": {"learning_rate": NaN}}'
        headers = {"Content-Type": "application/json"}
        check_problem(await live.http.post("/api/v1/experiments", content=not_finite, headers=headers), 422)
        assert (await live.http.get("/api/v1/experiments")).json()["items"] == []


async def test_settings_are_resolved_from_defaults_preset_and_body(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        body = EXPERIMENT | {"preset": "paper_real", "settings": {"batch_size": 32}}
        stored = (await live.http.post("/api/v1/experiments", json=body)).json()
        preset = (await live.http.get("/api/v1/algorithms/seed")).json()["presets"]["paper_real"]
        assert stored["settings"] == stored["settings"] | preset | {"batch_size": 32}
        schema = (await live.http.get("/api/v1/algorithms/seed")).json()["settings_schema"]
        assert set(stored["settings"]) == set(schema["properties"])
        taught = EXPERIMENT | {"teacher": "noisy", "teacher_settings": {"skip_within": 0.01}}
        taught["adapter_settings"] = {"layout": {"y": [-0.1, 0.1]}}
        stored = (await live.http.post("/api/v1/experiments", json=taught)).json()
        settings = {"noise": 0.1, "skip_within": 0.01, "delay": 0.0, "delay_spread": 0.0}
        assert stored["teacher_settings"] == settings
        assert stored["adapter_settings"]["layout"] == {"y": [-0.1, 0.1]}
        assert (await live.http.get(f"/api/v1/experiments/{stored['id']}")).json() == stored


def test_the_catalogue_loads_neither_torch_nor_a_simulator() -> None:
    program = (
        "import sys; from server import catalogue; from server.schemas import ExperimentCreate;"
        "catalogue.check(ExperimentCreate(name='x', task='stacking', preset='paper_sim', teacher='synthetic'));"
        "print([m for m in ('torch', 'mujoco', 'robosuite') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


async def test_a_task_tells_its_scene_and_where_the_state_has_each_place(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        tasks = {task["name"]: task for task in (await live.http.get("/api/v1/tasks")).json()}
    for name in ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog"):
        scene = tasks[name]["scene"]
        for thing in scene["objects"]:
            told = thing["fixed"] or thing["state_at"] is not None or thing["slides_at"] is not None
            assert told, f"{name}: nothing tells where {thing['name']} is"
        low, high = scene["workspace"]
        assert all(a < b for a, b in zip(low, high, strict=True))
    stacking = {thing["name"]: thing for thing in tasks["stacking"]["scene"]["objects"]}
    assert (stacking["block_a"]["state_at"], stacking["block_b"]["state_at"]) == (0, 3)
    toy = next(thing for thing in tasks["sweeping"]["scene"]["objects"] if thing["name"] == "toy")
    assert toy["state_size"] == 2
    drawer = next(thing for thing in tasks["collecting_toy"]["scene"]["objects"] if thing["name"] == "drawer")
    assert (drawer["slides_at"], len(drawer["parts"])) == (3, 6)
    assert tasks["reaching"]["scene"]["gripper_at"] == 0
