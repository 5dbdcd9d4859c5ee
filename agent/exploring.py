"""What an ensemble of critics says of a call beyond its mean: how far it disagrees, and what that is worth."""

from __future__ import annotations

from torch import Tensor


def disagreement(predicted: Tensor) -> float | None:
    """Standard deviation of (E,) predictions of one call; None with a single critic, which can't disagree.

    It is the ensemble's own spread (divided by E): of two critics, each is so far from their mean.
    """
    return None if len(predicted) < 2 else float(predicted.std(dim=0, correction=0))


def promise(predicted: Tensor, curiosity: float) -> Tensor:
    """(E, C) predictions of C candidates -> (C,) what speaks for each.

    Without curiosity that is the lowest prediction: what all critics call good. With it, the mean and so many standard
    deviations of the critics: what is good, or what they know too little of to agree on (an upper confidence bound).
    """
    if not curiosity:
        lowest: Tensor = predicted.amin(dim=0).clamp(min=-1.0)
        return lowest
    spread = predicted.std(dim=0, correction=0)
    return (predicted.mean(dim=0) + curiosity * spread).clamp(min=-1.0)
