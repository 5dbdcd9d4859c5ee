"""Every way of multiplying gives what float64 gives, and the way that isn't there is not taken."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from types import SimpleNamespace

import pytest
import torch
from torch import Tensor

from agent import kernels

LARGE = (2, 600, (20, 256, 256, 10))
SMALL = (5, 48, (20, 32, 32, 1))
"""Networks, rows, sizes."""


@pytest.fixture(autouse=True)
def _asked_anew() -> Iterator[None]:
    torch.set_num_threads(1)
    kernels.onednn.cache_clear()
    yield
    kernels.onednn.cache_clear()


def there_and_back(shape: tuple[int, int, tuple[int, ...]]) -> None:
    """Both ways of one pass, beside autograd in float64."""
    count, rows, sizes = shape
    dice = torch.Generator().manual_seed(0)
    learnt, columns = rows // 3, slice(4, 9)
    x = torch.randn(count, rows, sizes[0], generator=dice)
    weights = [torch.randn(count, i, o, generator=dice) / i**0.5 for i, o in pairwise(sizes)]
    biases = [torch.randn(count, 1, o, generator=dice) for o in sizes[1:]]
    given = torch.randn(count, rows, sizes[-1], generator=dice)
    into = kernels.Weights([torch.full_like(w, 7.0) for w in weights], [torch.full_like(b, 7.0) for b in biases])

    done = kernels.Pass(x, kernels.Weights(weights, biases), learnt=learnt)
    asked = done.back(given, into, columns=columns)

    exact = [t.double().requires_grad_() for t in (*weights, *biases)]
    inputs = x.double().requires_grad_()
    whole = forward(inputs, exact)
    torch.testing.assert_close(done.output.double(), whole, rtol=1e-4, atol=1e-4)
    (by_inputs,) = torch.autograd.grad(whole, inputs, given.double(), retain_graph=True)
    assert asked is not None
    torch.testing.assert_close(asked.double(), by_inputs[:, learnt:, columns], rtol=1e-4, atol=1e-4)
    by_weights = torch.autograd.grad(whole[:, :learnt], exact, given[:, :learnt].double())
    for ours, theirs in zip((*into.weights, *into.biases), by_weights, strict=True):
        torch.testing.assert_close(ours.double(), theirs, rtol=1e-4, atol=1e-3)


def forward(x: Tensor, parameters: list[Tensor]) -> Tensor:
    layers = len(parameters) // 2
    for i in range(layers):
        x = torch.baddbmm(parameters[layers + i], x, parameters[i])
        x = x.relu() if i < layers - 1 else x
    return x


@pytest.mark.parametrize("shape", [LARGE, SMALL], ids=["large", "small"])
def test_as_this_machine_does_it(shape: tuple[int, int, tuple[int, ...]]) -> None:
    there_and_back(shape)


@pytest.mark.parametrize("shape", [LARGE, SMALL], ids=["large", "small"])
def test_where_the_operator_is_missing(
    monkeypatch: pytest.MonkeyPatch, shape: tuple[int, int, tuple[int, ...]]
) -> None:
    """It isn't a public one: another PyTorch may not have it."""
    monkeypatch.setattr(torch.ops, "mkldnn", SimpleNamespace())
    assert not kernels.onednn()
    there_and_back(shape)


@pytest.mark.parametrize("at_once", [1, 2, 5])
def test_however_many_networks_fit_the_cache(monkeypatch: pytest.MonkeyPatch, at_once: int) -> None:
    monkeypatch.setattr(kernels, "TOGETHER", at_once * SMALL[1] * max(SMALL[2][1:]))
    there_and_back(SMALL)
