"""What a fault of the arm means for the motion that it broke off: how that ended, and who has to look."""

from __future__ import annotations

from robot_adapters.base import EndReason, SafetyViolation
from robot_adapters.franka.backend import ArmFault, FingersFault, Mode
from robot_adapters.franka.limits import Refused


def ended_by(fault: ArmFault | Refused) -> EndReason:
    """Why the motion ended."""
    if isinstance(fault, ArmFault) and fault.mode is Mode.USER_STOPPED:
        return EndReason.STOPPED
    if isinstance(fault, ArmFault) and fault.mode is Mode.REFLEX:
        return EndReason.FORCE_LIMIT
    return EndReason.STALLED


def violations_of(fault: ArmFault | Refused) -> tuple[SafetyViolation, ...]:
    """A reflex and a lost arm need somebody to look before anything else.

    A button that was pressed, or fingers that are stuck, need a hand.
    """
    if isinstance(fault, Refused):
        return ()
    by_hand = isinstance(fault, FingersFault) or fault.mode is Mode.USER_STOPPED
    return (SafetyViolation("manual_reset" if by_hand else "damage", f"{fault}. {fault.remedy}"),)
