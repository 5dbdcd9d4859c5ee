"""Studies over HTTP: read as they are now, whoever writes them."""

from __future__ import annotations

from pathlib import Path

import pytest

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
        assert (curve["algorithm"], curve["seeds"], curve["x"]) == ("seed", 2, [0, 25])
        assert curve["mean"] == [0, 1]
        assert curve["sem"] == [0, 1]  # of 2 and 0
        assert [(each["algorithm"], each["y"]) for each in scenario["paper"]][:3] == [
            ("seed", [6]),
            ("seed", [9]),
            ("seed", [12]),
        ]
        evaluate(folder, "first_subgoal-seed-11", [6], "running")
        (scenario,) = (await at.http.get(address)).json()["scenarios"]
        assert scenario["curves"][0]["mean"] == [0, 1, 5]


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


async def test_a_study_that_cannot_be_read_says_why(tmp_path: Path) -> None:
    broken = tmp_path / "data" / "studies" / "broken"
    broken.mkdir(parents=True)
    (broken / "study.json").write_text('{"plan": 1}')
    (broken.parent / "notes").mkdir()
    async with serving(tmp_path / "data") as at:
        (summary,) = (await at.http.get("/api/v1/studies")).json()
        assert "can't be read" in summary["problem"]
        answer = await at.http.get("/api/v1/studies/broken")
        assert answer.status_code == 422
        assert "versions" in answer.json()["remedy"]
