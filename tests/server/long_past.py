"""A long past: an experiment's history, multiplied with seeded variations, without the days that it would take."""

from __future__ import annotations

import contextlib
import json
import random
import sqlite3
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

from robot_adapters import registry

PACE = 2.0
"""Seconds between two proposals."""
A_ROW = {"episode": 20, "evaluation": 5000}
"""Of so many proposals one begins an episode, or an evaluation follows."""
TRAINERS = ("Ann", "Bo", "Cleo")
PAGES = (
    "/experiments?limit=50",
    "/experiments/{id}",
    "/experiments/{id}/curves",
    "/experiments/{id}/history?limit=100",
    "/experiments/{id}/history?limit=100&violation=true",
    "/experiments/{id}/history?limit=100&verdict=none",
    "/experiments/{id}/history?limit=100&episode=2&order=asc",
    "/experiments/{id}/episodes?limit=50",
    "/experiments/{id}/proposals?limit=50",
    "/experiments/{id}/feedback?limit=200",
    "/experiments/{id}/executions?limit=50",
    "/experiments/{id}/quality",
    "/experiments/{id}/quality/mine?trainer=Ann",
    "/experiments/{id}/calibration",
    "/experiments/{id}/auto-approval",
    "/comparison?experiment={id}&measure=successes",
    "/comparison?experiment={id}&measure=success_rate",
)
"""What the pages ask for, below /api/v1."""


def lengthen(database: Path, experiment: int, proposals: int, seed: int = 0) -> None:
    """Add closed proposals with their clicks, motions, violations, metrics, episodes and evaluations to an experiment.

    The service that owns the SQLite database must not run. The experiment must have a closed proposal: its pictures,
    state and parameters are everybody's.
    """
    with contextlib.closing(sqlite3.connect(database, isolation_level=None)) as connection:
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute("BEGIN")
        _Past(connection, experiment, proposals, random.Random(seed)).write()
        connection.execute("COMMIT")


class _Past:
    def __init__(self, connection: sqlite3.Connection, experiment: int, count: int, rng: random.Random) -> None:
        self._db, self._experiment, self._count, self._rng = connection, experiment, count, rng
        connection.row_factory = sqlite3.Row
        self._model = connection.execute(
            "SELECT * FROM proposal WHERE experiment_id = ? AND closed_at IS NOT NULL LIMIT 1", (experiment,)
        ).fetchone()
        self._observation = connection.execute(
            "SELECT * FROM observation WHERE id = ?", (self._model["observation_id"],)
        ).fetchone()
        self._begun = datetime.now(UTC) - timedelta(seconds=PACE * count)
        tables = ("episode", "observation", "proposal", "feedback", "execution", "violation")
        self._first = {table: self._newest(table) + 1 for table in tables}
        self._number = self._newest_number("proposal")
        self._labels = [rng.choices((1, -1, 0), (3 + 4 * n / count, 4, 1))[0] for n in range(count)]
        self._moved = [n for n, label in enumerate(self._labels) if label == 1]

    def write(self) -> None:
        """All tables, parents first."""
        trainers = self._trainers()
        self._insert("episode", self._episodes())
        self._insert("observation", self._observations())
        self._insert("proposal", self._proposals())
        self._insert("feedback", self._feedback(trainers))
        self._insert("execution", self._executions())
        self._insert("violation", self._violations())
        self._insert("metric", self._metrics())
        self._insert("evaluation", self._evaluations())
        good, bad = self._labels.count(1), self._labels.count(-1)
        self._db.execute(
            "UPDATE experiment SET feedback = feedback + ?, good = good + ?, bad = bad + ?, neutral = neutral + ?,"
            " proposals = proposals + ?, executions = executions + ?, low_level_steps = low_level_steps + ?"
            " WHERE id = ?",
            (*(self._count, good, bad, self._count - good - bad), self._count, good, 40 * good, self._experiment),
        )

    def _at(self, n: float) -> str:
        return (self._begun + timedelta(seconds=PACE * n)).strftime("%Y-%m-%d %H:%M:%S.%f")

    def _newest(self, table: str) -> int:
        return int(self._db.execute(f"SELECT coalesce(max(id), 0) FROM {table}").fetchone()[0])

    def _newest_number(self, table: str) -> int:
        query = f"SELECT coalesce(max(number), 0) FROM {table} WHERE experiment_id = ?"
        return int(self._db.execute(query, (self._experiment,)).fetchone()[0])

    def _insert(self, table: str, rows: Iterable[dict[str, object]]) -> None:
        for first in (iterator := iter(rows)):
            names = ", ".join(first)
            blanks = ", ".join(f":{name}" for name in first)
            self._db.execute(f"INSERT INTO {table} ({names}) VALUES ({blanks})", first)
            self._db.executemany(f"INSERT INTO {table} ({names}) VALUES ({blanks})", iterator)

    def _trainers(self) -> list[int]:
        for name in TRAINERS:
            row = (name, "person", self._at(0))
            self._db.execute("INSERT OR IGNORE INTO trainer (name, kind, created_at) VALUES (?, ?, ?)", row)
        blanks = ", ".join("?" * len(TRAINERS))
        query = f"SELECT id FROM trainer WHERE kind = 'person' AND name IN ({blanks})"
        return [row[0] for row in self._db.execute(query, TRAINERS)]

    def _episodes(self) -> Iterator[dict[str, object]]:
        first, step = self._newest_number("episode") + 1, A_ROW["episode"]
        for index, n in enumerate(range(0, self._count, step)):
            yield {
                "id": self._first["episode"] + index,
                "experiment_id": self._experiment,
                "robot": 0,
                "number": first + index,
                "purpose": "training",
                "seed": index,
                "outcome": self._rng.choice(("success", "horizon", "reset")),
                "started_at": self._at(n),
                "ended_at": self._at(n + step - 0.5),
            }

    def _observations(self) -> Iterator[dict[str, object]]:
        for n in range(self._count):
            yield {
                **dict(self._observation),
                "id": self._first["observation"] + n,
                "uid": f"past-{self._first['observation'] + n}",
                "taken_at": (self._begun + timedelta(seconds=PACE * n)).timestamp(),
            }

    def _proposals(self) -> Iterator[dict[str, object]]:
        parameters, skills = json.loads(self._model["parameters"]), ("pick", "place")
        words = {1: "good", 0: "neutral", -1: "bad"}
        task = self._db.execute("SELECT task FROM experiment WHERE id = ?", (self._experiment,)).fetchone()["task"]
        bounds = {spec.name: spec.parameters for spec in registry.task(task).skills}
        for n, label in enumerate(self._labels):
            moved = [value + self._rng.gauss(0.0, 0.02) for value in parameters]
            skill = self._rng.choices(skills, (2, 1 + n / self._count))[0]
            moved = [min(max(value, p.low), p.high) for value, p in zip(moved, bounds[skill], strict=True)]
            yield {
                **dict(self._model),
                "id": self._first["proposal"] + n,
                "episode_id": self._first["episode"] + n // A_ROW["episode"],
                "observation_id": self._first["observation"] + n,
                "number": self._number + 1 + n,
                "skill": skill,
                "parameters": json.dumps(moved),
                "digest": f"{n:064x}",
                "predicted_feedback": label * min(1.0, 0.3 + n / self._count) + self._rng.gauss(0.0, 0.3),
                "policy_version": n,
                "opened_at": self._at(n),
                "closed_at": self._at(n + 0.4),
                "close_reason": "judged",
                "verdict": words[label],
                "verdict_source": "trainers",
                "gate_allowed": int(label == 1),
                "gate_reason": "approved" if label == 1 else "not approved",
            }

    def _feedback(self, trainers: list[int]) -> Iterator[dict[str, object]]:
        for n, label in enumerate(self._labels):
            yield {
                "id": self._first["feedback"] + n,
                "click_id": f"past-{self._experiment}-{n:07}",
                "experiment_id": self._experiment,
                "proposal_id": self._first["proposal"] + n,
                "trainer_id": trainers[n // 500 % len(trainers)],
                "value": label,
                "status": "stored",
                "received_at": self._at(n + 0.4),
                "estimate_shown": 1,
            }

    def _executions(self) -> Iterator[dict[str, object]]:
        for index, n in enumerate(self._moved):
            yield {
                "id": self._first["execution"] + index,
                "experiment_id": self._experiment,
                "proposal_id": self._first["proposal"] + n,
                "robot": 0,
                "started_at": self._at(n + 0.4),
                "ended_at": self._at(n + 0.9),
                "outcome": "succeeded",
                "low_level_steps": 40,
                "task_success": int(n % 7 == 0),
            }

    def _violations(self) -> Iterator[dict[str, object]]:
        for index, n in enumerate(self._moved):
            if self._rng.random() < 0.02:
                yield {
                    "experiment_id": self._experiment,
                    "execution_id": self._first["execution"] + index,
                    "kind": "manual_reset",
                    "detail": "a block fell off the table",
                    "at": self._at(n + 0.8),
                }

    def _metrics(self) -> Iterator[dict[str, object]]:
        good = moved = 0
        for n, label in enumerate(self._labels):
            good += label == 1
            moved += label == 1
            told = {
                "successes": good // 3,
                "executions": moved,
                "violation_ratio": round(0.02 * moved / (n + 1), 6),
                "good_share": round(good / (n + 1), 6),
                "critic_loss": round(0.6 / (1 + n / 5000) + 0.05 * self._rng.random(), 6),
                "skill_actor_loss": round(-n / self._count, 6),
                "parameter_actor_loss": round(-0.5 * n / self._count, 6),
                "skill_temperature": round(0.2 / (1 + n / 20000), 6),
                "parameter_temperature": round(0.1 / (1 + n / 20000), 6),
            }
            yield {
                "experiment_id": self._experiment,
                "feedback": n + 1,
                "at": self._at(n + 0.5),
                "data": json.dumps(told),
            }

    def _evaluations(self) -> Iterator[dict[str, object]]:
        for n in range(0, self._count, A_ROW["evaluation"]):
            yield {
                "experiment_id": self._experiment,
                "feedback": n,
                "policy_version": n,
                "rollouts": 10,
                "done": 10,
                "successes": min(10, self._rng.randint(0, 4) + 6 * n // self._count),
                "low_level_steps": 400,
                "seed": 0,
                "started_at": self._at(n + 0.95),
                "ended_at": self._at(n + 0.99),
            }
