"""Whether an approved skill may run now: pure functions of what the store has just re-read (DESIGN.md section 4, 7)."""

from __future__ import annotations

from server.schemas import GateDecision, Lifecycle, Mode, Verdict

OPEN = GateDecision(allowed=True, reason="open")


def decide(
    *,
    mode: Mode,
    by_critic: bool,
    auto_approval: bool,
    gold: bool,
    verdict: Verdict | None,
    rule_stands: bool,
    lifecycle: Lifecycle,
    halted: bool,
    simulated: bool,
    operator_present: bool,
    workspace_ok: bool,
    observation_current: bool,
    unclear: str,
) -> GateDecision:
    """The decision for a training proposal; the reason names the first thing that keeps the gate shut.

    rule_stands: the votes still add up to good by the experiment's rule, which may have changed since the verdict.
    by_critic: the verdict is the critic's own. auto_approval: the rule by which it approved still holds.
    unclear: why the robot can't see now that the scene is as it was judged; empty where it can, or doesn't look.
    gold: it measured its trainers, and its answer was known; the reason doesn't give that away.
    """
    if halted:
        return _shut("the emergency stop is latched")
    if verdict is not Verdict.GOOD:
        return _shut("no verdict" if verdict is None else f"the verdict is {verdict.value}")
    if not by_critic and not rule_stands:
        return _shut("its votes don't approve it by the rule of now")
    if by_critic and not simulated:
        return _shut("a real robot moves by a person's verdict only, and this one is the critic's")
    if by_critic and not auto_approval:
        return _shut("the critic approved it by a rule that no longer holds")
    if mode is not Mode.EXECUTE_APPROVED:
        return _shut("the mode is propose only")
    if gold:
        return _shut("held back")
    if lifecycle is not Lifecycle.RUNNING:
        return _shut(f"the experiment is {lifecycle.value}")
    if not simulated and not operator_present:
        return _shut("a real robot needs an operator present")
    if unclear:
        return _shut(unclear)
    return _world(workspace_ok, observation_current)


def decide_evaluation(
    *,
    verdict: Verdict | None,
    lifecycle: Lifecycle,
    halted: bool,
    simulated: bool,
    workspace_ok: bool,
    observation_current: bool,
) -> GateDecision:
    """The decision for a rollout of the deterministic policy: nobody watches, so only simulators may move.

    The mode doesn't matter: it is about proposals that people judge. The experiment must not be training meanwhile.
    """
    if halted:
        return _shut("the emergency stop is latched")
    if verdict is not Verdict.GOOD:
        return _shut("the evaluation hasn't approved it")
    if not simulated:
        return _shut("evaluations move simulated robots only")
    if lifecycle not in (Lifecycle.CREATED, Lifecycle.PAUSED, Lifecycle.FINISHED):
        return _shut(f"the experiment is {lifecycle.value}")
    return _world(workspace_ok, observation_current)


def _world(workspace_ok: bool, observation_current: bool) -> GateDecision:
    if not workspace_ok:
        return _shut("a parameter lies outside the workspace")
    if not observation_current:
        return _shut("the scene has changed since the observation")
    return OPEN


def _shut(reason: str) -> GateDecision:
    return GateDecision(allowed=False, reason=reason)
