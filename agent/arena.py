"""Weights, gradients and Adam's moments of several learners of one shape, each kind in one flat vector.

One optimiser call then serves all of them, and the same layer of all learners is one batch of matrices. The networks
go on as before: their parameters become views into the vector.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import torch
from torch import Tensor, nn

from agent import kernels
from agent.networks import Networks, StackedMLP

ALIGNMENT = 16
"""Every block begins at a multiple of so many numbers: a cache line of 64 bytes."""
ADAM_STATE = ("step", "exp_avg", "exp_avg_sq")
"""What torch's Adam keeps."""


class Arena:
    """Moves the networks' parameters into itself. S learners; `block` of a parameter is (S, *shape)."""

    def __init__(self, learners: Sequence[Networks], learning_rate: float) -> None:
        self.learners = tuple(learners)
        named = [dict(networks.named_parameters()) for networks in self.learners]
        self._shapes = {name: value.shape for name, value in named[0].items()}
        self._starts: dict[str, int] = {}
        size = 0
        for name, shape in self._shapes.items():
            self._starts[name] = size
            size += -(-len(named) * shape.numel() // ALIGNMENT) * ALIGNMENT
        device = self.learners[0].mask.device
        self.values = torch.zeros(size, device=device)
        self.gradients = torch.zeros(size, device=device)
        flat = nn.Parameter(self.values)
        flat.grad = self.gradients
        self._adam = torch.optim.Adam([flat], lr=learning_rate, fused=True)
        shapes: dict[str, tuple[int, ...]] = {"step": (), "exp_avg": (size,), "exp_avg_sq": (size,)}
        self.state = {key: torch.zeros(shape, device=device) for key, shape in shapes.items()}
        self._adam.state[flat] = self.state
        for at, parameters in enumerate(named):
            for name, parameter in parameters.items():
                home = self.block(name)[at]
                with torch.no_grad():
                    home.copy_(parameter)
                parameter.data = home

    def block(self, name: str, of: Tensor | None = None) -> Tensor:
        """(S, *shape) a parameter of every learner; `of`: its place in another flat vector, the gradients for one."""
        shape, start = self._shapes[name], self._starts[name]
        size = len(self.learners) * shape.numel()
        return (self.values if of is None else of)[start : start + size].view(len(self.learners), *shape)

    def descend(self) -> None:
        """One step of Adam along `gradients`."""
        self._adam.step()

    def moments(self, at: int) -> Mapping[str, Mapping[str, Tensor]]:
        """What Adam keeps of learner `at`, by parameter; to be copied, or written to."""
        flat = {key: value for key, value in self.state.items() if key != "step"}
        return {
            name: {"step": self.state["step"]} | {key: self.block(name, value)[at] for key, value in flat.items()}
            for name in self._shapes
        }


class Stack:
    """One `StackedMLP` of every learner of an arena, run forward and backward as one.

    count: networks in it, S learners with C each. Gradients are written into the arena's.
    """

    def __init__(self, arena: Arena, name: str) -> None:
        module = getattr(arena.learners[0], name)
        assert isinstance(module, StackedMLP)
        layers = range(len(module.weights))
        self._weights, self._gradients = (
            kernels.Weights(
                [arena.block(f"{name}.weights.{i}", of).flatten(0, 1) for i in layers],
                [arena.block(f"{name}.biases.{i}", of).flatten(0, 1) for i in layers],
            )
            for of in (arena.values, arena.gradients)
        )

    def forward(self, x: Tensor, *, learnt: int, pause: Callable[[], None] = kernels.no_pause) -> kernels.Pass:
        """(S, C or 1, B, input) -> what `kernels.Pass` says, of S * C networks."""
        count = len(self._weights.weights[0]) // len(x)
        return kernels.Pass(x.expand(-1, count, -1, -1).flatten(0, 1), self._weights, learnt=learnt, pause=pause)

    def backward(self, passed: kernels.Pass, gradient: Tensor, columns: slice | None = None) -> Tensor | None:
        """Write the weights' gradients into the arena's; see `kernels.Pass.back`."""
        return passed.back(gradient, self._gradients, columns=columns)
