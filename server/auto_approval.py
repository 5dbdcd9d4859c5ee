"""When the critic may approve a proposal by itself: pure functions. Only in simulation, only where it is asked for.

An approval by the critic is a verdict, but no feedback: the critic must not learn from its own opinion. Whether it is
still right is found out by audits, which are proposals that it would have approved and a trainer judges all the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

from agent.trust import wilson
from server.errors import invalid
from server.schemas import Mode
from server.schemas_problems import FieldProblem
from server.schemas_trust import AutoApproval
from server.seeds import auditing

WINDOW = 50
"""Newest audits that count: a critic that was right for long and is no longer is found out all the same."""


class Decision(Enum):
    """What becomes of a proposal: trainers are asked as ever, or because of an audit, or the critic approves."""

    ASK = "ask"
    AUDIT = "audit"
    APPROVE = "approve"


@dataclass(frozen=True)
class Case:
    """A proposal and where its experiment stands, as the store has just read both.

    seed: the experiment's. qualified: proposals that met the rule since it was set, approved and audited ones.
    """

    predicted: float
    uncertainty: float | None
    simulated: bool
    mode: Mode
    feedback: int
    qualified: int
    seed: int


def decide(rule: AutoApproval | None, case: Case) -> Decision:
    """What becomes of this proposal. Where nothing may move, an approval would be for nothing."""
    if rule is None or not case.simulated or case.mode is not Mode.EXECUTE_APPROVED:
        return Decision.ASK
    sure = case.uncertainty is not None and case.uncertainty <= rule.uncertainty_at_most
    if not (sure and case.predicted >= rule.predicted_at_least and case.feedback >= rule.after_feedback):
        return Decision.ASK
    return Decision.AUDIT if is_audited(rule.audit_every, case.qualified, case.seed) else Decision.APPROVE


def is_audited(every: int, qualified: int, seed: int) -> bool:
    """Whether the proposal after so many qualifying ones is held back: one in each block of `every`, drawn by lot.

    A fixed one of each block would always fall on the same skill where a task alternates between two.
    """
    block, place = divmod(qualified, every)
    return int(auditing(seed, block).integers(every)) == place


def too_low(rule: AutoApproval, audited: int, agreed: int) -> bool:
    """Whether trainers agree too rarely: the whole 95 % interval of their agreement lies below what the rule asks for.

    It is looked at after every audit, which makes a false alarm likelier than 5 % in the long run, never the opposite.
    """
    return wilson(agreed, audited)[1] < rule.agreement_at_least


def check(rule: AutoApproval | None, *, adapter: str, simulated: bool, settings: Mapping[str, Any]) -> None:
    """Refuse a rule that must not be: for a real robot, or without an ensemble. `settings`: the algorithm's, resolved.

    Raises:
        ServiceError: 422, naming the field.
    """
    if rule is None:
        return
    if not simulated:
        raise invalid(
            [FieldProblem(field="auto_approval", message=f"{adapter!r} moves a real robot, which only people approve")],
            remedy="leave auto_approval out, or use a simulated adapter",
        )
    critics = settings.get("critics")
    if not isinstance(critics, int) or critics < 2:
        raise invalid(
            [FieldProblem(field="auto_approval", message="one critic alone can't tell how sure it is")],
            remedy="set the algorithm's setting critics to 2 or more (the preset 'recommended' has 2) in a new"
            " experiment, or leave auto_approval out",
        )
