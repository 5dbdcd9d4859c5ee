"""What the rules of DESIGN.md section 5 say, apart from the store: the model that its rows are compared with."""

from __future__ import annotations

from dataclasses import dataclass, field

AFTER: dict[str, dict[str, str]] = {
    "start": {"created": "running", "failed": "running"},
    "resume": {"paused": "running", "failed": "running"},
    "pause": {"running": "paused"},
    "finish": {"running": "finished", "paused": "finished"},
    "fail": {"running": "failed"},
    "reset": {"running": "running", "paused": "paused"},
}


@dataclass
class Click:
    id: int
    click_id: str
    proposal: Proposal
    trainer: str
    value: int
    late: bool
    undone: bool = False

    @property
    def counted(self) -> bool:
        return not self.late and not self.undone


@dataclass
class Proposal:
    id: int
    experiment: Experiment
    observation: str
    episode: int
    parameters: dict[str, float]
    open: bool = True
    verdict: str | None = None
    decided: bool = False
    execution: Execution | None = None


@dataclass
class Execution:
    id: int
    proposal: Proposal
    outcome: str | None = None


@dataclass
class Experiment:
    id: int
    majority: bool
    lifecycle: str = "created"
    halted: bool = False
    mode: str = "execute_approved"
    episode: int = 0
    episode_open: bool = False
    observation: int = 0
    proposals: list[Proposal] = field(default_factory=list)
    clicks: list[Click] = field(default_factory=list)

    @property
    def at_work(self) -> bool:
        return self.lifecycle == "running" and not self.halted

    @property
    def open_proposal(self) -> Proposal | None:
        return next((p for p in self.proposals if p.open), None)

    @property
    def executions(self) -> list[Execution]:
        return [p.execution for p in self.proposals if p.execution is not None]

    @property
    def moving(self) -> Execution | None:
        return next((e for e in self.executions if e.outcome is None), None)

    def votes(self, proposal: Proposal) -> list[Click]:
        return [c for c in self.clicks if c.proposal is proposal and c.counted]


def verdict_of(majority: bool, values: list[int]) -> str | None:
    name = {1: "good", 0: "neutral", -1: "bad"}
    if not majority:
        return name[values[0]]
    for value, word in name.items():
        if values.count(value) >= 2:
            return word
    return "neutral" if len(values) == 3 else None
