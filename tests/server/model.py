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
    overtaken: bool = False
    corrected: int | None = None

    @property
    def status(self) -> str:
        return "late" if self.late else "overtaken" if self.overtaken else "stored"

    @property
    def label(self) -> int:
        return self.value if self.corrected is None else self.corrected

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
    slot: int
    electorate: list[str]
    born: int
    open: bool = True
    superseded: bool = False
    verdict: str | None = None
    decided: bool = False
    execution: Execution | None = None


@dataclass
class Execution:
    id: int
    proposal: Proposal
    born: int
    outcome: str | None = None


@dataclass
class Experiment:
    id: int
    rule: str
    lifecycle: str = "created"
    halted: bool = False
    mode: str = "execute_approved"
    episode: int = 0
    episode_open: bool = False
    observation: int = 0
    proposals: list[Proposal] = field(default_factory=list)
    clicks: list[Click] = field(default_factory=list)
    learner: dict[int, int] = field(default_factory=dict)
    """What a learner that lives on holds, feedback id -> value: by what the store has told to learn and to forget."""
    age: int = 0

    def tick(self) -> int:
        """The order of openings and motions."""
        self.age += 1
        return self.age

    @property
    def at_work(self) -> bool:
        return self.lifecycle == "running" and not self.halted

    @property
    def open_proposals(self) -> list[Proposal]:
        return [p for p in self.proposals if p.open]

    def at(self, slot: int) -> Proposal | None:
        return next((p for p in self.open_proposals if p.slot == slot), None)

    @property
    def executions(self) -> list[Execution]:
        return [p.execution for p in self.proposals if p.execution is not None]

    @property
    def moving(self) -> Execution | None:
        return next((e for e in self.executions if e.outcome is None), None)

    def supersede(self) -> tuple[int, int]:
        """The robot moves: how many open proposals are closed by that, and how many were approved too late."""
        opened = self.open_proposals
        late = [p for p in self.proposals if p.verdict == "good" and not p.decided and p.episode == self.episode]
        for proposal in opened:
            proposal.open, proposal.superseded = False, True
        for proposal in late:
            proposal.decided = True
        return len(opened), len(late)

    def votes(self, proposal: Proposal) -> list[Click]:
        return [c for c in self.clicks if c.proposal is proposal and c.counted and not c.overtaken]


def verdict_of(rule: str, votes: list[Click], electorate: list[str]) -> str | None:
    name = {1: "good", 0: "neutral", -1: "bad"}
    if not votes:
        return None
    if rule == "first":
        return name[votes[0].value]
    values = [vote.value for vote in votes if vote.trainer in electorate]
    missing = len(electorate) - len(values)
    if rule == "unanimous":
        if -1 in values:
            return "bad"
        return None if missing else "good" if set(values) == {1} else "neutral"
    for value, word in name.items():
        if 2 * values.count(value) > len(electorate):
            return word
    reachable = [value for value in name if 2 * (values.count(value) + missing) > len(electorate)]
    return None if values and reachable else "neutral" if values else None
