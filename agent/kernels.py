"""Stacked networks forward and backward, each matrix product by the quickest way that PyTorch offers here.

Shapes: C networks of the same shape, B rows, i inputs and o outputs of a layer. Three things cost the plain products
much (measured on one core of an AMD EPYC with AVX-512; `docs/learning-speed.md`): MKL, which PyTorch calls, runs at
half the speed of oneDNN on processors that aren't Intel's; a product that ends in a few columns runs at a fraction of
the speed of the same product transposed; and what doesn't fit a core's cache is fetched again by every operation.

Small networks are a batch of matrices, because there each call costs most, as many at a time as the cache holds; large
ones go one after another, so many rows at a time. Which way depends on shapes and processor only, never on a clock: the
same step gives the same bits.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import torch
from torch import Tensor

NARROW = 16
"""A layer with so few outputs is computed transposed: sixteen numbers are one register of AVX-512."""
LARGE = 2**22
"""Multiplications of one network's layer from which oneDNN pays, whose calls cost some 10 us more; found by trying."""
ACTIVATIONS = 2**16
"""Numbers that a large network's layer gives at a time, a quarter of a cache of 1 MB: 256 rows of 256 units."""


TOGETHER = 2**17
"""Numbers that a layer of small networks gives at a time: half of a cache of 1 MB, with what they are made from."""


@functools.cache
def onednn() -> bool:
    """Whether oneDNN's product is there and worth its while: on processors with AVX-512."""
    mkldnn = torch.backends.mkldnn
    there = bool(mkldnn.is_available()) and hasattr(torch.ops.mkldnn, "_linear_pointwise")  # type: ignore[no-untyped-call]
    return there and torch.backends.cpu.get_cpu_capability() == "AVX512"


def no_pause() -> None:
    """Go on at once."""


@dataclass(frozen=True)
class Weights:
    """Of C networks, by layer: weights (C, i, o) and biases (C, 1, o)."""

    weights: Sequence[Tensor]
    biases: Sequence[Tensor]
    _pieces: dict[int, list[Weights]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def pieces(self, size: int) -> list[Weights]:
        """So many networks each, the last one perhaps fewer."""
        if size not in self._pieces:
            parts = [slice(at, at + size) for at in range(0, len(self.weights[0]), size)]
            self._pieces[size] = [Weights([w[p] for w in self.weights], [b[p] for b in self.biases]) for p in parts]
        return self._pieces[size]

    @functools.cached_property
    def each(self) -> list[Weights]:
        """One network's each: (i, o) and (o,)."""
        size = len(self.weights[0])
        return [Weights([w[k] for w in self.weights], [b[k, 0] for b in self.biases]) for k in range(size)]

    @functools.cached_property
    def turned(self) -> list[Tensor]:
        """One network's weights, transposed (o, i)."""
        return [w.t() for w in self.weights]


class Pass:
    """One pass forward, kept for the way back. ReLU between layers."""

    def __init__(self, x: Tensor, weights: Weights, *, learnt: int, pause: Callable[[], None] = no_pause) -> None:
        """x: (C, B, i). The weights learn from the first `learnt` rows; of the others, only inputs get a gradient.

        pause: called every millisecond or so of a large network's work, there and back.
        """
        self._weights, self._learnt, self._pause = weights, learnt, pause
        self._size, self._rows = x.shape[:2]
        self._one_by_one = _large(x, weights)
        outputs = weights.weights[-1].shape[-1]
        self.output: Tensor
        """(C, B, o)."""
        self._passed: list[list[Tensor]] = []
        if not self._one_by_one:
            pieces = torch.split(x, self._at_once())
            self._passed = [_batched(*piece) for piece in zip(pieces, weights.pieces(self._at_once()), strict=True)]
            together = [passed.pop() for passed in self._passed]
            self.output = together[0] if len(together) == 1 else torch.cat(together)
            return
        self.output = x.new_empty(self._size, outputs, self._rows).transpose(1, 2)
        for k in range(self._size):
            ours = weights.each[k]
            for rows in self._parts():
                pause()
                passed = _alone(x[k, rows], ours)
                self.output[k, rows] = passed.pop()
                self._passed.append(passed)

    def back(self, gradient: Tensor, into: Weights, *, columns: slice | None = None) -> Tensor | None:
        """From the gradient by the output (C, B, o) to that by the weights, written to `into`.

        columns: of the input; the gradient by those of the rows that aren't learnt from is returned
        (C, B - learnt, columns). None: none is asked for.
        """
        if not self._one_by_one:
            return self._batched_back(gradient, into, columns)
        asked: list[Tensor] = []
        passed = iter(self._passed)
        for k in range(self._size):
            ours, gradients = self._weights.each[k], into.each[k]
            for rows in self._parts():
                self._pause()
                part = gradient[k, rows]
                if rows.start < self._learnt:
                    _alone_back(next(passed), ours, part, gradients, add=rows.start > 0)
                else:
                    asked.append(_alone_through(next(passed), ours, part, columns or slice(0, 0)))
        return torch.cat(asked).view(self._size, self._rows - self._learnt, -1) if columns is not None else None

    def _parts(self) -> Iterator[slice]:
        most = ACTIVATIONS // max(w.shape[2] for w in self._weights.weights)
        for start, stop in ((0, self._learnt), (self._learnt, self._rows)):
            yield from (slice(at, min(at + most, stop)) for at in range(start, stop, most))

    def _at_once(self) -> int:
        """Networks whose layer's activations stay in the cache together."""
        widest = max(w.shape[2] for w in self._weights.weights)
        return max(1, min(self._size, TOGETHER // (self._rows * widest)))

    def _batched_back(self, gradient: Tensor, into: Weights, columns: slice | None) -> Tensor | None:
        size = self._at_once()
        pieces = zip(
            self._passed, torch.split(gradient, size), self._weights.pieces(size), into.pieces(size), strict=True
        )
        asked = [_batched_back(*piece, learnt=self._learnt, columns=columns) for piece in pieces]
        given = [each for each in asked if each is not None]
        return torch.cat(given) if given else None


def _large(x: Tensor, weights: Weights) -> bool:
    """Whether each network is worth going alone, by oneDNN."""
    work = x.shape[1] * max(w.shape[1] * w.shape[2] for w in weights.weights)
    return work >= LARGE and x.device.type == "cpu" and x.dtype == torch.float32 and onednn()


def _batched(x: Tensor, weights: Weights) -> list[Tensor]:
    """What goes into each layer, and last the output, (C, B, ...) each."""
    passed = [x]
    last = len(weights.weights) - 1
    for i, (weight, bias) in enumerate(zip(weights.weights, weights.biases, strict=True)):
        if weight.shape[-1] <= NARROW:
            out = torch.baddbmm(bias.transpose(1, 2), weight.transpose(1, 2), passed[-1].transpose(1, 2)).transpose(
                1, 2
            )
        else:
            out = torch.baddbmm(bias, passed[-1], weight)
        passed.append(out.relu_() if i < last else out)
    return passed


def _batched_back(
    passed: list[Tensor], gradient: Tensor, weights: Weights, into: Weights, *, learnt: int, columns: slice | None
) -> Tensor | None:
    """`Pass.back` of networks that went together."""
    for i in reversed(range(len(passed))):
        ours, x = gradient[:, :learnt], passed[i][:, :learnt]
        if ours.shape[-1] <= NARROW:
            into.weights[i].copy_(torch.bmm(ours.transpose(1, 2), x).transpose(1, 2))
        else:
            torch.bmm(x.transpose(1, 2), ours, out=into.weights[i])
        torch.sum(ours, dim=1, keepdim=True, out=into.biases[i])
        if i:
            turned = weights.weights[i].transpose(1, 2)
            gradient = gradient * turned if turned.shape[1] == 1 else torch.bmm(gradient, turned)
            _stop_where_zero(gradient, passed[i])
    if columns is None:
        return None
    return torch.bmm(weights.weights[0][:, columns], gradient[:, learnt:].transpose(1, 2)).transpose(1, 2)


def _alone(x: Tensor, weights: Weights) -> list[Tensor]:
    """The same for one network: (B, ...) each."""
    passed = [x]
    last = len(weights.weights) - 1
    for i, (turned, bias) in enumerate(zip(weights.turned, weights.biases, strict=True)):
        if len(bias) > NARROW:
            passed.append(_onednn(passed[-1], turned, bias, "relu" if i < last else "none"))
        else:
            out = torch.addmm(bias.unsqueeze(1), turned, passed[-1].t()).t()
            passed.append(out.relu_() if i < last else out)
    return passed


def _alone_back(passed: list[Tensor], weights: Weights, gradient: Tensor, into: Weights, *, add: bool) -> None:
    """Gradients of one network's weights; added to what is there, or written over it."""
    kept = 1.0 if add else 0.0
    for i in reversed(range(len(passed))):
        x, target = passed[i], into.weights[i]
        if gradient.shape[-1] <= NARROW:
            # apart: written straight to the target, which lies the other way, the product takes four times as long
            product = (gradient.t() @ x).t()
            target.add_(product) if add else target.copy_(product)
        elif x.shape[-1] * gradient.numel() < LARGE:
            torch.addmm(target, x.t(), gradient, beta=kept, out=target)
        else:
            product = _onednn(x.t(), gradient.t(), None, "none")
            target.add_(product) if add else target.copy_(product)
        total = gradient.sum(dim=0)
        into.biases[i].add_(total) if add else into.biases[i].copy_(total)
        if i:
            gradient = _before(gradient, weights.weights[i], x)


def _alone_through(passed: list[Tensor], weights: Weights, gradient: Tensor, columns: slice) -> Tensor:
    """The gradient by the input's columns (B, columns) of one network."""
    for i in reversed(range(1, len(passed))):
        gradient = _before(gradient, weights.weights[i], passed[i])
    return (weights.weights[0][columns] @ gradient.t()).t()


def _before(gradient: Tensor, weight: Tensor, x: Tensor) -> Tensor:
    """From the gradient by a layer's output (B, o) to that before the ReLU that its input x (B, i) came through."""
    if gradient.shape[-1] > NARROW:
        gradient = _onednn(gradient, weight, None, "none")
    else:
        gradient = gradient * weight.t() if gradient.shape[-1] == 1 else gradient @ weight.t()
    _stop_where_zero(gradient, x)
    return gradient


def _stop_where_zero(gradient: Tensor, activation: Tensor) -> None:
    """ReLU backward, in place: no gradient where the activation is 0."""
    torch.ops.aten.threshold_backward.grad_input(gradient, activation, 0, grad_input=gradient)


def _onednn(x: Tensor, weight: Tensor, bias: Tensor | None, way: str) -> Tensor:
    """X (B, i) times the transpose of weight (o, i)."""
    out: Tensor = torch.ops.mkldnn._linear_pointwise(x, weight, bias, way, [], "")
    return out
