"""Where the gradient steps are computed: on the CPU, or on a graphics card."""

from __future__ import annotations

import torch

from agent.algorithm import AgentError, Algorithm, DeviceName, Movable

SETTING = "SEED_LEARNER_DEVICE"


def chosen(name: DeviceName) -> torch.device:
    """The device of this name; `auto` is a CUDA card where PyTorch can use one, and the CPU elsewhere.

    Raises:
        AgentError: CUDA is asked for, and PyTorch can't use it here.
    """
    there = torch.cuda.is_available()
    if name == "cuda" and not there:
        raise AgentError(
            f"{SETTING} is cuda, but PyTorch {torch.__version__} can't use CUDA here",
            remedy=f"set {SETTING} to auto or cpu, or install a PyTorch built for CUDA, and the card's driver",
        )
    return torch.device("cuda" if there and name != "cpu" else "cpu")


def place(algorithm: Algorithm, name: DeviceName) -> None:
    """Have the algorithm train on the device of this name; `auto` is the CPU for one that can't be moved.

    Raises:
        AgentError: CUDA is asked for, and PyTorch can't use it here, or the algorithm can't.
    """
    device = chosen(name)
    if isinstance(algorithm, Movable):
        algorithm.move(device)
    elif name == "cuda":
        raise AgentError(
            f"{SETTING} is cuda, but {type(algorithm).__name__} trains on the CPU only",
            remedy=f"set {SETTING} to auto or cpu",
        )
