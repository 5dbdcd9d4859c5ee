"""Studies over HTTP: read as they are now, whoever writes them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from agent.study.evaluations import COLUMNS
from agent.study.figures import write_figures
from agent.study.results import write_results
from tests.server.serving import serving
from tests.server.study_folder import begun, evaluate, plan


async def test_studies_show_up_while_another_process_works_on_them(tmp_path: Path) -> None:
    async with serving(tmp_path / "data") as at:
        assert (await at.http.get("/api/v1/studies")).json() == []
        folder = begun(tmp_path / "data" / "studies" / "mine")
        with folder.worked_on():
            (summary,) = (await at.http.get("/api/v1/studies")).json()
            assert (summary["name"], summary["study"], summary["live"], summary["runs"]) == (
                "mine",
                "paper-sim",
                True,
                4,
            )
            assert summary["done"] == pytest.approx((1 + 0.25) / 4)
            study = (await at.http.get("/api/v1/studies/mine")).json()
            states = {run["id"]: run["state"] for run in study["run_list"]}
            assert states["first_subgoal-seed-11"] == "running"
            assert states["first_subgoal-maple-aff-10"] == "waiting"
        # its process is gone, and didn't say so
        study = (await at.http.get("/api/v1/studies/mine")).json()
        assert study["live"] is False
        run = next(run for run in study["run_list"] if run["id"] == "first_subgoal-seed-11")
        assert (run["state"], run["rate"], run["done"]) == ("interrupted", None, 0.25)
        assert study["versions"]["code"] == "0123456789abcdef"
        assert study["files"] == []


async def test_a_curve_is_the_mean_of_the_seeds_beside_the_papers(tmp_path: Path) -> None:
    async with serving(tmp_path / "data") as at:
        folder = begun(tmp_path / "data" / "studies" / "mine")
        address = "/api/v1/studies/mine"
        (scenario,) = (await at.http.get(address)).json()["scenarios"]
        assert (scenario["axis"], scenario["measure"]) == ("decisions", "successes")
        assert "Budget 100 decisions a run (the paper's figure goes to 250); 2 seeds" in scenario["caption"]
        (curve,) = scenario["curves"]
        # seed 11 has only begun: it doesn't take the curve of seed 10 back to its start
        assert (curve["algorithm"], curve["seeds"], curve["planned"]) == ("seed", 1, 2)
        assert (curve["x"], curve["mean"], curve["sem"]) == ([0, 25, 50, 75, 100], [0, 2, 4, 9, 10], [None] * 5)
        assert "Lines: mean of the seeds" in scenario["caption"]
        assert "bootstrap" not in scenario["caption"]
        assert [(each["algorithm"], each["y"]) for each in scenario["paper"]][:3] == [
            ("seed", [6]),
            ("seed", [9]),
            ("seed", [12]),
        ]
        evaluate(folder, "first_subgoal-seed-11", [6, 7, 8], "finished")
        (scenario,) = (await at.http.get(address)).json()["scenarios"]
        (curve,) = scenario["curves"]
        assert (curve["seeds"], curve["mean"]) == (2, [0, 1, 5, 8, 9])
        assert curve["sem"] == [0, 1, 1, 1, 1]  # half of what the two differ by


async def test_figures_and_tables_can_be_had_and_nothing_else(tmp_path: Path) -> None:
    async with serving(tmp_path / "data") as at:
        folder = begun(tmp_path / "data" / "studies" / "mine")
        write_results(folder, plan())
        write_figures(folder, plan())
        listed = (await at.http.get("/api/v1/studies/mine")).json()["files"]
        assert listed == ["first_subgoal.png", "first_subgoal.svg", "table.md", "results.csv"]
        kinds = {"first_subgoal.png": "image/png", "first_subgoal.svg": "image/svg+xml", "table.md": "text/markdown"}
        for file, kind in kinds.items():
            answer = await at.http.get(f"/api/v1/studies/mine/files/{file}")
            assert answer.status_code == 200
            assert answer.headers["content-type"].startswith(kind)
        for wrong in ("mine/files/study.json", "mine/files/..%2F..%2Fstudy.json", "..%2Fstudies%2Fmine", "other"):
            answer = await at.http.get(f"/api/v1/studies/{wrong}")
            assert answer.status_code == 404, wrong
            assert answer.json()["remedy"]


RUN = "runs/first_subgoal-seed-10"
ROW = ",".join(map(str, [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0]))
"""An evaluation of no rollouts."""


DAMAGED: list[tuple[str, str | dict[str, Any], bool]] = [
    ("study.json", "{", False),
    ("study.json", '{"plan": 1}', False),
    ("study.json", {"created_at": "soon"}, False),
    ("study.json", {"versions": [1]}, False),
    ("study.json", {"plan": {"runs": []}}, False),
    (f"{RUN}/progress.json", "{", False),
    (f"{RUN}/progress.json", '{"seconds": NaN}', False),
    (f"{RUN}/evaluations.csv", f"{','.join(COLUMNS)}\n{ROW}\n", True),
    (f"{RUN}/evaluations.csv", f"{','.join(COLUMNS)}\n{ROW.replace('0', 'many')}\n", True),
]
"""File, what is in it (for JSON: what is changed), and whether the list of studies, which reads no rows, has it."""


async def test_a_damaged_file_is_named_and_hides_no_other_study(tmp_path: Path) -> None:
    studies = tmp_path / "data" / "studies"
    begun(studies / "good")
    (studies / "notes").mkdir()
    for number, (file, content, _) in enumerate(DAMAGED):
        path = begun(studies / f"bad{number}").path / file
        if isinstance(content, dict):
            whole = json.loads(path.read_text())
            content = json.dumps(whole | content | {"plan": whole["plan"] | content.get("plan", {})})  # noqa: PLW2901
        path.write_text(content)
    async with serving(tmp_path / "data") as at:
        problems = {each["name"]: each["problem"] for each in (await at.http.get("/api/v1/studies")).json()}
        assert len(problems) == 1 + len(DAMAGED)
        assert problems["good"] is None
        assert (await at.http.get("/api/v1/studies/good")).status_code == 200
        for number, (file, _, listed) in enumerate(DAMAGED):
            told = f"bad{number}/{file} can't be read"
            answer = await at.http.get(f"/api/v1/studies/bad{number}")
            assert answer.status_code == 422, told
            assert told in answer.json()["detail"]
            assert answer.json()["remedy"]
            assert str(tmp_path) not in answer.text
            problem = problems[f"bad{number}"]
            assert problem is None if listed else told in problem
