"""The command line as a person uses it: a process, its output, its exit code."""

from __future__ import annotations

import json
import os
import signal
import socket
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx

from tests.live import wait_for

COMMAND = [sys.executable, "-c", "from server.cli import app; app(prog_name='seed')"]
CLICKS = "SELECT count(*) FROM feedback JOIN trainer ON trainer.id = trainer_id WHERE kind = 'teacher'"
KINEMATIC = ["--task", "reaching", "--adapter", "kinematic", "--seed", "3"]


def environment(**settings: str) -> dict[str, str]:
    return os.environ | {"OMP_NUM_THREADS": "1", "SEED_CREATE_FIRST_EXPERIMENT": "false", "COLUMNS": "200"} | settings


def seed(*arguments: object, **settings: str) -> subprocess.CompletedProcess[str]:
    """Run `seed` to its end."""
    command = [*COMMAND, *map(str, arguments)]
    return subprocess.run(
        command, env=environment(**settings), capture_output=True, text=True, timeout=180, check=False
    )


def begun(*arguments: object, **settings: str) -> subprocess.Popen[str]:
    """Start `seed`, in a session of its own."""
    return subprocess.Popen(
        [*COMMAND, *map(str, arguments)],
        env=environment(**settings),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def url_of(process: subprocess.Popen[str]) -> str:
    """The URL that `seed serve` prints when it is ready."""
    assert process.stdout is not None
    line = process.stdout.readline()
    assert "http://" in line, (line, process.stderr and process.stderr.read())
    return line.split()[-1]


def rows(data_dir: Path, query: str) -> list[tuple[Any, ...]]:
    with closing(sqlite3.connect(f"file:{data_dir / 'seed.db'}?mode=ro", uri=True)) as connection:
        return connection.execute(query).fetchall()


def refused(done: subprocess.CompletedProcess[str], code: int, *words: str) -> None:
    """It ended with this code, a message, a remedy, and no traceback."""
    assert done.returncode == code, done.stderr
    assert "Traceback" not in done.stderr
    assert "error:" in done.stderr
    assert "remedy:" in done.stderr
    for word in words:
        assert word in done.stderr, done.stderr


def test_serve_prints_its_url_and_ends_in_order_by_either_signal(tmp_path: Path) -> None:
    for number in (signal.SIGINT, signal.SIGTERM):
        process = begun("serve", "--port", 0, "--data-dir", tmp_path)
        try:
            url = url_of(process)
            assert httpx.get(f"{url}/ready").status_code == 200
            if number is signal.SIGINT:
                refused(seed("serve", "--port", 0, "--data-dir", tmp_path), 2, "another process", "--data-dir")
                refused(seed("train", *KINEMATIC, "--data-dir", tmp_path), 2, "another process")
            process.send_signal(number)
            assert process.wait(timeout=30) == 0
            assert "Traceback" not in (process.stderr.read() if process.stderr else "")
        finally:
            process.kill()
            process.communicate()


def test_serve_says_when_its_port_is_in_use_and_touches_nothing(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        data = tmp_path / "data"
        refused(seed("serve", "--port", port, "--data-dir", data), 2, f"port {port}", "in use", f"--port {port + 1}")
        assert not data.exists()


def test_serve_refuses_addresses_and_settings_that_are_wrong(tmp_path: Path) -> None:
    refused(seed("serve", "--host", "0.0.0.0", "--data-dir", tmp_path), 2, "no login", "ssh -L", "SEED_LOGIN")
    refused(seed("serve", "--host", "no.such.host.invalid", "--data-dir", tmp_path, SEED_LOGIN="1"), 2)
    refused(seed("serve", "--port", "70000", "--data-dir", tmp_path), 2, "port")
    refused(seed("serve", SEED_LOG_LEVEL="loud", SEED_DATA_DIR=str(tmp_path)), 2, "SEED_LOG_LEVEL")


def test_the_owner_s_token_of_a_file_opens_the_service_and_a_short_one_is_refused(tmp_path: Path) -> None:
    secret = tmp_path / "owner_token"
    serve = ("serve", "--host", "0.0.0.0", "--port", 0, "--data-dir", tmp_path / "data")
    settings = {"SEED_LOGIN": "1", "SEED_OWNER_TOKEN_FILE": str(secret)}
    refused(seed(*serve, **settings), 2, "SEED_OWNER_TOKEN_FILE")
    secret.write_text("0123456789", "utf-8")
    refused(seed(*serve, **settings), 2, "10 characters")
    secret.write_text("the-token-of-the-owner-of-this-laboratory\n", "utf-8")
    process = begun(*serve, **settings)
    try:
        url = url_of(process)  # no other way in is told
        assert "join" not in url
        bearer = {"Authorization": f"Bearer {secret.read_text('utf-8').strip()}"}
        assert httpx.get(f"{url}/api/v1/me", headers=bearer).json()["role"] == "owner"
        assert httpx.get(f"{url}/api/v1/experiments").status_code == 401
    finally:
        process.terminate()
        process.communicate()


def test_serve_says_what_is_wrong_with_its_database(tmp_path: Path) -> None:
    data = tmp_path / "data"
    process = begun("serve", "--port", 0, "--data-dir", data)
    url_of(process)
    process.terminate()
    process.communicate()

    read_only = f"sqlite:///file:{data / 'seed.db'}?mode=ro&uri=true"
    refused(
        seed("serve", "--port", 0, "--data-dir", data, SEED_DATABASE_URL=read_only), 2, "can't be written", "writable"
    )
    mysql = seed("serve", "--port", 0, "--data-dir", data, SEED_DATABASE_URL="mysql://nowhere/x")
    refused(mysql, 2, "mysql", "postgresql://")

    with closing(sqlite3.connect(data / "seed.db", isolation_level=None)) as connection:
        connection.execute("UPDATE alembic_version SET version_num = '9999'")
    before = (data / "seed.db").read_bytes()
    refused(seed("serve", "--port", 0, "--data-dir", data), 2, "9999", "backups")
    assert (data / "seed.db").read_bytes() == before

    (data / "seed.db").write_bytes(b"this is no database" * 1000)
    refused(seed("serve", "--port", 0, "--data-dir", data), 2)

    file = tmp_path / "file"
    file.write_text("x")
    refused(seed("serve", "--port", 0, "--data-dir", file), 2, "data directory", "--data-dir")


def test_train_refuses_unknown_names_and_wrong_values(tmp_path: Path) -> None:
    where = ("--data-dir", tmp_path)
    refused(seed("train", "--task", "juggling", "--adapter", "kinematic", *where), 2, "juggling", "stacking")
    refused(seed("train", "--adapter", "ur5", *where), 2, "ur5", "kinematic")
    refused(seed("train", *KINEMATIC, "--algorithm", "dqn", *where), 2, "dqn", "seed")
    refused(seed("train", *KINEMATIC, "--teacher", "mother", *where), 2, "mother", "synthetic")
    noisy = ("train", *KINEMATIC, "--teacher", "noisy", *where)
    refused(seed(*noisy, "--set", "teacher.noise=2"), 2, "teacher_settings.noise")
    refused(seed(*noisy, "--set", "adapter.layout.w=[0.1,0.2]"), 2, "adapter_settings.layout.w", "x, y, z")
    refused(seed(*noisy, "--set", "noise=0.1"), 2, "PART.NAME=VALUE")
    refused(seed(*noisy, "--resume", 77, "--set", "teacher.noise=0.1"), 2, "--resume")
    refused(seed("train", "--resume", 77, *where), 2, "77")
    refused(seed("evaluate", 77, *where), 2, "77")
    assert seed("train", "--feedback", "0", *where).returncode == 2
    assert seed("fly").returncode == 2
    assert rows(tmp_path, "SELECT * FROM experiment") == []


def test_train_ends_with_a_stored_evaluation_and_one_json_line(tmp_path: Path) -> None:
    done = seed("train", *KINEMATIC, "--feedback", 12, "--evaluate", 2, "--json", "--data-dir", tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout.splitlines()[-1])
    assert list(summary) == [
        "experiment",
        "feedback",
        "executions",
        "low_level_steps",
        "successes",
        "success_rate",
        "violations",
        "seconds",
    ]
    assert summary["feedback"] == 12
    assert _clicks(tmp_path) == 12
    ((rollouts, successes),) = rows(tmp_path, "SELECT rollouts, successes FROM evaluation")
    assert rollouts == 2
    assert summary["success_rate"] == successes / rollouts

    more = seed("evaluate", summary["experiment"], "--rollouts", 1, "--json", "--data-dir", tmp_path)
    assert more.returncode == 0, more.stderr
    assert json.loads(more.stdout.splitlines()[-1])["rollouts"] == 1
    assert rows(tmp_path, "SELECT count(*) FROM evaluation") == [(2,)]


def test_settings_of_every_part_can_be_set(tmp_path: Path) -> None:
    changes = ("teacher.noise=1", "algorithm.hidden_size=16", "adapter.draw=false", "adapter.layout.x=[0.45,0.65]")
    given = [word for change in changes for word in ("--set", change)]
    amount = ("--feedback", 10, "--evaluate", 0, "--json", "--data-dir", tmp_path)
    done = seed("train", *KINEMATIC, "--teacher", "noisy", *given, *amount)
    assert done.returncode == 0, done.stderr
    stored = rows(tmp_path, "SELECT settings, adapter_settings, teacher_settings FROM experiment")
    learner, adapter, teacher = map(json.loads, stored[0])
    assert learner["hidden_size"] == 16
    assert (adapter["draw"], adapter["layout"]) == (False, {"x": [0.45, 0.65]})
    assert teacher["noise"] == 1
    # always the wrong way round: what is bad, and most of what a beginner proposes is, was called good
    ((good, executed),) = rows(tmp_path, "SELECT good, executions FROM experiment")
    assert good >= 8
    assert executed == good


def test_ctrl_c_pauses_training_and_it_goes_on_from_there(tmp_path: Path) -> None:
    process = begun("train", *KINEMATIC, "--feedback", 100_000, "--data-dir", tmp_path)
    try:
        assert process.stdout is not None
        wait_for(lambda: _clicks(tmp_path) >= 3, "three clicks of the teacher", timeout=90)
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130, told
    assert "Traceback" not in told
    assert "--resume 1" in told
    assert rows(tmp_path, "SELECT lifecycle FROM experiment") == [("paused",)]
    stored = _clicks(tmp_path)
    wanted = stored + 5
    done = seed("train", "--resume", 1, "--feedback", wanted, "--evaluate", 0, "--json", "--data-dir", tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout.splitlines()[-1])
    assert (summary["feedback"], summary["success_rate"]) == (wanted, None)
    assert _clicks(tmp_path) == wanted


def _clicks(data_dir: Path) -> int:
    try:
        ((count,),) = rows(data_dir, CLICKS)
    except sqlite3.OperationalError:  # not created yet
        return 0
    return int(count)


def test_training_without_graphics_says_what_to_install(tmp_path: Path) -> None:
    # GLFW needs a display; a machine without one is what this stands for
    arguments = ("train", "--task", "reaching", "--adapter", "robosuite", "--feedback", 2, "--data-dir", tmp_path)
    refused(seed(*arguments, MUJOCO_GL="glfw", DISPLAY="", WAYLAND_DISPLAY=""), 3, "MUJOCO_GL", "apt-get install")
    assert rows(tmp_path, "SELECT lifecycle FROM experiment") == [("failed",)]
    assert rows(tmp_path, "SELECT * FROM feedback") == []


def test_check_tells_authors_what_it_finds() -> None:
    sound = seed("check", "reaching")
    assert sound.returncode == 0, sound.stdout + sound.stderr
    assert "nothing found" in sound.stdout
    refused(seed("check", "juggling"), 2, "juggling", "kinematic")
