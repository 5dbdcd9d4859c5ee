"""`seed study` as a person uses it: a process, its folder, its exit code; killed, and gone on with."""

from __future__ import annotations

import csv
import json
import signal
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from agent.study.records import EVALUATIONS, Folder
from server.cli import app
from tests.live import wait_for
from tests.server.test_cli import begun

TINY = (
    "study", "paper-sim", "--adapter", "kinematic", "--tasks", "first_subgoal", "--algorithms", "seed-recommended",
    "--seeds", 2, "--budget", 16, "--evaluations", 8, "--rollouts", 1, "--jobs", 1,
)  # fmt: skip


FIRST, SECOND = "first_subgoal-seed-recommended-10", "first_subgoal-seed-recommended-11"


def measured(folder: Path) -> dict[str, list[list[str]]]:
    """Run -> the rows of its evaluations, without the clock."""
    found = {}
    for path in sorted(folder.glob(f"runs/*/{EVALUATIONS}")):
        with path.open(newline="") as file:
            found[path.parent.name] = [row[:-1] for row in csv.reader(file)]
    return found


def evaluations(folder: Path) -> int:
    """How many the first run has."""
    return len(Folder(folder).rows(FIRST))


def wrong(arguments: Sequence[object], *words: str) -> None:
    """The command ends as one with wrong arguments, in this process: others cost seconds each."""
    done = CliRunner().invoke(app, [str(each) for each in arguments])
    assert done.exit_code == 2, done.output
    for word in ("error:", "remedy:", *words):
        assert word in done.output, done.output


def told(arguments: Sequence[object]) -> dict[str, Any]:
    """What the command prints for programs, from this process; its runs have processes of their own all the same."""
    done = CliRunner().invoke(app, [*map(str, arguments), "--json"])
    assert done.exit_code == 0, done.output
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def test_a_killed_study_goes_on_to_the_same_numbers(tmp_path: Path) -> None:
    whole, killed = tmp_path / "data" / "studies" / "paper-sim", tmp_path / "killed"
    all_told = told([*TINY, "--data-dir", tmp_path / "data"])
    assert (all_told["runs"], all_told["finished"], all_told["failed"]) == (2, 2, 0)
    assert all_told["folder"] == str(whole)
    (result,) = all_told["results"]
    assert (result["task"], result["algorithm"], result["seeds"]) == ("first_subgoal", "seed-recommended", 2)
    assert result["reached"] == 16
    assert 0 <= result["successes"]["iqm"] <= 16
    expected = measured(whole)
    assert [row[0] for row in expected["first_subgoal-seed-recommended-10"][1:]] == [str(n) for n in range(9)]
    for name in ("first_subgoal.png", "first_subgoal.svg"):
        assert (whole / "figures" / name).stat().st_size > 5000
    table = (whole / "table.md").read_text("utf-8")
    assert "Budget 16 decisions a run (the paper's figure goes to 250); 2 seeds; kinematic adapter" in table
    assert "| 6, 9, 12 |" not in table  # the paper's SEED is not our recommended preset
    assert len((whole / "results.csv").read_text().splitlines()) == 3

    again = ("study", "paper-sim", "--out", killed, "--resume")
    # ended in order after two evaluations, killed after three more
    for begin, rows, number in ((TINY, 2, signal.SIGTERM), (again, 5, signal.SIGKILL)):
        process = begun(*begin, "--out", killed)
        try:
            wait_for(lambda rows=rows: evaluations(killed) >= rows, f"{rows} evaluations", timeout=90)  # type: ignore[misc]
            process.send_signal(number)
            _, said = process.communicate(timeout=60)
        finally:
            process.kill()
            process.communicate()
        if number is signal.SIGTERM:
            assert process.returncode == 130, said
            assert "Traceback" not in said
            assert f"seed study paper-sim --resume --out {killed}" in said.replace("\n", "")
            states = {Folder(killed).progress(run, live=False).state for run in (FIRST, SECOND)}
            assert states & {"interrupted", "waiting"}
            assert "of 2 finished" in (killed / "table.md").read_text("utf-8")
    wait_for(lambda: not Folder(killed).live, "the killed study's lock to be free")

    wrong([*TINY, "--out", killed], "holds a study already", "--resume")
    wrong([*again, "--seeds", 3], "--seeds", "planned already")
    assert told([*again, "--jobs", 2])["results"] == all_told["results"]
    assert measured(killed) == expected


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--algorithms", "seed,dqn"), ("--algorithms", "dqn", "maple-aff")),
        (("--tasks", "juggling"), ("--tasks", "juggling", "first_subgoal")),
        (("--budget", "0"), ("--budget", "'0'", "1 or more")),
        (("--budget", "reaching=many"), ("--budget", "reaching=20000")),
        (("--budget", "juggling=5"), ("--budget", "juggling", "reaching")),
        (("--adapter", "ur5"), ("ur5", "kinematic")),
        (("--tasks", "first_subgoal", "--algorithms", "sac"), ("skills only", "leave out sac")),
        (("--resume",), ("no study", "--out")),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, options: tuple[str, ...], words: tuple[str, ...]) -> None:
    wrong(["study", "paper-sim", "--out", tmp_path / "study", *options], *words)
    assert not list(tmp_path.glob("study/*.json"))


def test_an_ablation_takes_one_ingredient_away_at_a_time(tmp_path: Path) -> None:
    out = tmp_path / "study"
    options = ["--adapter", "kinematic", "--seeds", 1, "--budget", 2, "--evaluations", 1, "--rollouts", 1]
    wrong(["study", "ablation", "--without", "luck", *options, "--out", out], "--without", "luck", "recall")
    done = told(["study", "ablation", "--without", "nothing,recall", *options, "--jobs", 1, "--out", out])
    assert [each["algorithm"] for each in done["results"]] == ["nothing", "recall"]
    settings = [run.contestant.settings for run in Folder(out).plan().runs]
    assert {name for name in settings[0] if settings[0][name] != settings[1].get(name)} == {"recall"}
    assert "the paper's figure" not in (out / "table.md").read_text("utf-8")


def test_an_ablation_also_goes_step_by_step_from_the_paper_to_the_preset(tmp_path: Path) -> None:
    out = tmp_path / "study"
    options = ["--ladder", "--adapter", "kinematic", "--seeds", 1, "--budget", 1, "--evaluations", 1, "--rollouts", 1]
    wrong(["study", "ablation", "--without", "recall", *options, "--out", out], "--without", "--ladder")
    done = told(["study", "ablation", *options, "--out", out])
    assert [done["results"][at]["algorithm"] for at in (0, -1)] == ["paper", "trainer_reliability"]
    wrong(["study", "ablation", "--resume", "--ladder", "--out", out], "--ladder", "--resume")


def test_folders_of_something_else_are_left_alone(tmp_path: Path) -> None:
    thesis = tmp_path / "thesis" / "chapter.tex"
    thesis.parent.mkdir()
    thesis.write_text("mine")
    wrong([*TINY, "--out", thesis.parent], "no empty folder")
    assert [each.name for each in thesis.parent.iterdir() if not each.name.startswith(".")] == ["chapter.tex"]
    wrong(["study", "imitation", "--out", thesis.parent], "no empty folder")
    with Folder(tmp_path / "busy").worked_on():
        wrong(["study", "composition", "--out", tmp_path / "busy"], "another process works on")
    for arguments in (TINY, ("study", "composition")):
        wrong([*arguments, "--out", thesis], "--out", "can't be written to")
        wrong([*arguments, "--out", thesis / "below"], "--out", "can't be written to")
    assert thesis.read_text() == "mine"
    other = tmp_path / "other"
    other.mkdir()
    (other / "study.json").write_text('{"plan": {"name": "another"}}')
    wrong(["study", "paper-sim", "--resume", "--out", other], "can't be read")


def test_a_killed_study_of_a_claim_goes_on_with_the_rows_that_are_left(tmp_path: Path) -> None:
    out = tmp_path / "study"
    command = ["study", "imitation", "--seeds", 1, "--rollouts", 2, "--jobs", 1, "--out", out]

    def states() -> dict[str, str]:
        folder = Folder(out)
        return {run.id: folder.progress(run.id, live=False).state for run in folder.plan().runs}

    with begun(*command) as study:
        wait_for(
            lambda: out.joinpath("study.json").exists() and [*states().values()].count("finished") >= 3, "a row", 120
        )
        study.send_signal(signal.SIGKILL)
    wait_for(lambda: not Folder(out).live, "the killed study's lock to be free")
    finished = [name for name, state in states().items() if state == "finished"]
    assert 3 <= len(finished) < 24, "a row has three runs, and there are eight rows"
    kept = {name: (out / "runs" / name / EVALUATIONS).stat().st_mtime_ns for name in finished}
    wrong(["study", "imitation", "--resume", "--seeds", 2, "--out", out], "--seeds", "planned already")
    done = told(["study", "imitation", "--resume", "--jobs", 1, "--out", out])
    assert (done["runs"], done["finished"], done["failed"]) == (24, 24, 0)
    assert {name: (out / "runs" / name / EVALUATIONS).stat().st_mtime_ns for name in finished} == kept
    assert {run.decisions for run in (Folder(out).rows(name)[-1] for name in states())} == {40}
    assert "| Two toys, two orders, two places |" in (out / "table.md").read_text("utf-8")


def test_the_list_names_every_task_and_algorithm() -> None:
    listed = CliRunner().invoke(app, ["study", "list"])
    assert listed.exit_code == 0
    for word in ("paper-sim", "first_subgoal", "seed-recommended", "ablation", "grounded_actor", "composition"):
        assert word in listed.stdout
