"""`seed robot`: what a real robot needs before the service drives it: its cameras, their calibration, printed tags."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robot_adapters.base import AdapterError, Array, Unavailable
from robot_adapters.registry import task as task_by_name
from server.cli_ending import FAILED, INTERRUPTED, USAGE, give_up, stderr
from server.cli_robot_check import check
from server.settings import Settings

if TYPE_CHECKING:
    from robot_adapters.franka.perception.calibrating import Session, Step

app = typer.Typer(help="Set up a real robot: check it, print tags, calibrate its cameras.", no_args_is_help=True)

AsJson = Annotated[bool, typer.Option("--json", help="print one JSON object as the last line")]
DataDir = Annotated[Path | None, typer.Option(help="directory of the data [default: data, or SEED_DATA_DIR]")]
CameraSources = Annotated[
    list[str],
    typer.Option(
        "--camera",
        metavar="NAME=SOURCE",
        help="a camera: left=realsense:SERIAL, right=opencv:2, or a recording (.db3, .bag, .mp4, a folder); "
        "may be given again",
    ),
]


app.command("check")(check)


@app.command()
def board(out: Annotated[Path, typer.Argument(help="where to write it: .pdf, .svg or .png")]) -> None:
    """Write the calibration board, to be printed at 100 % on A4 or Letter."""
    from robot_adapters.franka.perception.printing import board_sheet  # noqa: PLC0415  matplotlib takes a moment

    _said(lambda: board_sheet(out))


@app.command()
def tags(
    out: Annotated[Path, typer.Argument(help="where to write them: .pdf, .svg or .png")],
    task: Annotated[str | None, typer.Option(help="the task whose objects are tagged")] = None,
    file: Annotated[str, typer.Option(help="a tag file of your own [default: the one that comes with SEED]")] = "",
    fixed: Annotated[int, typer.Option(min=0, max=80, help="so many tags for what never moves")] = 0,
    size: Annotated[float, typer.Option(min=10, max=140, help="their width, mm")] = 50,
) -> None:
    """Write a task's tags, or tags to notice moved cameras by, to be printed at 100 %."""
    from robot_adapters.franka.perception import printing, tagging  # noqa: PLC0415
    from robot_adapters.franka.perception.moved import FIXED_FROM  # noqa: PLC0415

    if (task is None) == (fixed == 0):
        give_up("say what to print", "give either --task stacking or --fixed 4", USAGE)
    if task is None:
        _said(lambda: printing.fixed_sheet(out, range(FIXED_FROM, FIXED_FROM + fixed), size / 1000))
    else:
        name = task
        _said(lambda: printing.tag_sheet(out, tagging.load(task_by_name(name), file)))


@app.command()
def calibrate(  # noqa: PLR0917  Typer makes an option of each
    camera: CameraSources,
    host: Annotated[str, typer.Option(help="address of the arm, which people guide by hand")] = "172.16.0.2",
    backend: Annotated[str, typer.Option(help="franka_rs, franky or deoxys")] = "franka_rs",
    poses: Annotated[Path | None, typer.Option(help="a recorded session: JSON with the hand of each picture")] = None,
    square: Annotated[float, typer.Option(min=5, max=200, help="edge of a chess square as printed, mm")] = 36.0,
    wanted: Annotated[int, typer.Option(min=8, max=60, help="poses to take of each camera")] = 15,
    data_dir: DataDir = None,
    as_json: AsJson = False,
) -> None:
    """Find out where the cameras are: put the board into the hand, and guide the arm through different poses.

    The arm is only listened to, never moved. docs/franka-cameras.md shows how.
    """
    from robot_adapters.franka.perception import calibrating  # noqa: PLC0415
    from robot_adapters.franka.perception.board import Board  # noqa: PLC0415
    from robot_adapters.franka.perception.camera import open_camera  # noqa: PLC0415
    from robot_adapters.franka.perception.watching import Watch  # noqa: PLC0415

    sources = _sources(camera)
    started = time.monotonic()
    where = (data_dir or Settings().data_dir) / "calibration"
    watches: dict[str, Watch] = {}
    try:
        recorded = calibrating.read_poses(poses) if poses is not None else None
        for name, source in sources.items():
            watches[name] = Watch(name, lambda source=source: open_camera(source))  # type: ignore[misc]
        session = calibrating.Session(watches, Board(square / 1000), wanted)
        with stderr.status("Opening the cameras ...") as status:

            def told(step: calibrating.Step) -> None:
                counts = ", ".join(f"{name} {count}/{session.wanted}" for name, count in step.taken.items())
                status.update(f"[bold]{counts}[/]  {step.said}")

            if recorded is not None:
                session.replay(recorded, told)
            else:
                hand = _hand(host, backend)
                stderr.print("Press the enabling button and guide the arm. Poses are taken by themselves.")
                _take_poses(session, hand, told)
            status.update("Calculating ...")
            results = session.results or session.solve()
        if recorded is None:
            typer.prompt("Take the board away and the arm out of the picture, then press Enter", default="", err=True)
        files = session.store(sources, where)
    except AdapterError as error:
        give_up(str(error), error.remedy, FAILED)
    except KeyboardInterrupt:
        give_up("interrupted; nothing was stored", "start it again", INTERRUPTED)
    finally:
        for watch in watches.values():
            watch.close()
    summary = {
        "cameras": {
            name: {
                "error_mm": round(result.error * 1000, 2),
                "poses": result.used,
                "left_out": result.left_out,
                "file": str(file),
            }
            for (name, result), file in zip(results.items(), files, strict=True)
        },
        "seconds": round(time.monotonic() - started, 1),
    }
    _tell_result(summary, session.disagreement(), calibrating.GOOD, as_json)


def _take_poses(session: Session, hand: Callable[[], Array], told: Callable[[Step], None]) -> None:
    """Until they say where every camera is: what was taken isn't thrown away because more are wanting."""
    from robot_adapters.franka.perception.hand_eye import NotEnough  # noqa: PLC0415

    while not session.results:
        while not (step := session.step(hand)).done:
            told(step)
        try:
            session.solve()
        except NotEnough as error:
            stderr.print(f"{error}: {error.remedy}")


def _tell_result(summary: dict[str, Any], apart: float | None, good: float, as_json: bool) -> None:
    if apart is not None:
        summary["cameras_apart_mm"] = round(apart * 1000, 2)
    if as_json:
        typer.echo(json.dumps(summary))
        return
    for name, result in summary["cameras"].items():
        verdict = "good" if result["error_mm"] <= good * 1000 else "usable; more poses, and a stiffer board, help"
        left_out = f", {result['left_out']} left out because they contradict the rest" if result["left_out"] else ""
        typer.echo(f"{name}: {result['error_mm']} mm ({verdict}), {result['poses']} poses{left_out}: {result['file']}")
    if apart is not None:
        typer.echo(f"the cameras place the board {summary['cameras_apart_mm']} mm apart")


def _hand(host: str, backend: str) -> Callable[[], Array]:
    """Where the arm's hand is, (4, 4) base frame: it is read only."""
    import numpy as np  # noqa: PLC0415

    from robot_adapters.franka import FrankaSettings, connecting  # noqa: PLC0415

    if backend not in connecting.BACKENDS:
        give_up(f"there is no backend {backend!r}", "use one of: " + ", ".join(connecting.BACKENDS), USAGE)
    arm = connecting.backend(FrankaSettings.model_validate({"host": host, "backend": backend, "realtime": False}))

    def pose() -> Array:
        state = arm.state()
        found = np.eye(4)
        found[:3, :3], found[:3, 3] = state.rotation, state.position
        return found

    return pose


def _sources(given: list[str]) -> Mapping[str, str]:
    """Camera -> source."""
    sources: dict[str, str] = {}
    for text in given:
        name, equals, source = text.partition("=")
        if not equals or not source or not name.isidentifier():
            give_up(f"--camera {text}: no NAME=SOURCE", "write e.g. --camera left=realsense:SERIAL", USAGE)
        if name in sources:
            give_up(f"--camera {name} is given twice", "give each camera a name of its own", USAGE)
        sources[name] = source
    return sources


def _said(work: Callable[[], list[Path]]) -> None:
    try:
        files = work()
    except AdapterError as error:
        give_up(str(error), error.remedy, FAILED if isinstance(error, Unavailable) else USAGE)
    for file in files:
        typer.echo(str(file))
