"""Training elsewhere than in place. There is no CUDA where these run: see what each test puts in its stead."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from torch._subclasses.fake_tensor import FakeTensorMode
from torch.utils._python_dispatch import TorchDispatchMode
from torch.utils._pytree import tree_leaves

from agent import device, kernels
from agent.algorithm import AgentError
from agent.config import SEED, SeedSettings
from agent.seed import Seed
from agent.stacked import StackedSeeds
from agent.training import Trainer, _lesson
from tests.agent.problems import judged, of_task

CASES = [("paper_sim", "stacking"), ("recommended", "stacking"), ("recommended", "sweeping")]
STEPS = 6
CLOSE = 1e-4
"""Rounding, after a few steps of Adam, whose first ones turn any small difference into one of its step size."""
FUSED = "_get_fused_kernels_supported_devices"
"""What PyTorch asks when a fused Adam is made: it has none on `meta`, and none is called there."""


class OneDevice(TorchDispatchMode):  # type: ignore[no-untyped-call]
    """Refuses every operation with an operand that isn't on `meta`, also those that PyTorch would let pass."""

    def __torch_dispatch__(
        self, func: Any, types: Any, args: tuple[Any, ...] = (), kwargs: dict[str, Any] | None = None
    ) -> Any:
        operands = [leaf for leaf in tree_leaves((args, kwargs)) if isinstance(leaf, torch.Tensor)]
        assert all(operand.device.type == "meta" for operand in operands), func
        return func(*args, **(kwargs or {}))


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def settings(preset: str) -> SeedSettings:
    return SeedSettings(**{**SEED.presets[preset], "batch_size": 64})


def learner(preset: str, task: str, *, apart: bool) -> Seed:
    made = Seed(of_task(task), settings(preset), 3)
    made.add(judged(task, 8))
    if apart:
        twinned(made)
    return made


def twinned(made: Seed) -> None:
    """Have twins of its networks learn, as on a card, but on the CPU; `Seed.move` needs none there."""
    trainer, _ = made.seat
    made.settle(Trainer([made._networks], trainer.objective, torch.device("cpu")), 0)


def assert_alike(one: Seed, other: Seed) -> None:
    pairs = zip(one._networks.named_parameters(), other._networks.named_parameters(), strict=True)
    for (name, ours), (_, theirs) in pairs:
        torch.testing.assert_close(ours, theirs, rtol=10 * CLOSE, atol=CLOSE, msg=name)


@pytest.mark.parametrize(("preset", "task"), CASES)
def test_twins_by_plain_products_learn_what_the_networks_learn_in_place(
    preset: str, task: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On the CPU in place of a card: losses of every step, weights, and what is proposed then."""
    here, there = learner(preset, task, apart=False), learner(preset, task, apart=True)
    before = [p.clone() for p in there._networks.parameters()]
    expected = [here.update() for _ in range(STEPS)]
    monkeypatch.setattr(kernels, "onednn", lambda: False)
    told = [there.update() for _ in range(STEPS)]
    for ours, theirs in zip(told, expected, strict=True):
        assert ours == pytest.approx(theirs, rel=1e-3, abs=CLOSE)
    assert not any(torch.equal(a, b) for a, b in zip(before, there._networks.parameters(), strict=True) if b.dim() > 2)
    assert_alike(there, here)
    state = judged(task, 1, seed=9)[0].state
    one, other = (each.propose(state, deterministic=True).call for each in (there, here))
    assert one.skill == other.skill
    np.testing.assert_allclose(one.parameters, other.parameters, atol=1e-3)


def test_a_checkpoint_goes_from_one_device_to_the_other_and_back(tmp_path: Path) -> None:
    """On the CPU in place of a card."""
    preset, task = "recommended", "stacking"
    whole, there = learner(preset, task, apart=False), learner(preset, task, apart=True)
    for _ in range(3):
        whole.update()
        there.update()
    there.save(tmp_path / "there.ckpt")
    here = learner(preset, task, apart=False)
    here.load(tmp_path / "there.ckpt")
    here.restore(judged(task, 8))
    here.update()
    here.save(tmp_path / "here.ckpt")
    back = learner(preset, task, apart=True)
    back.load(tmp_path / "here.ckpt")
    back.restore(judged(task, 8))
    assert back.seat[0].device is not None
    back.update()
    for _ in range(2):
        whole.update()
    assert back.policy_version == whole.policy_version == 5
    assert_alike(back, whole)


def test_moving_keeps_what_adam_knows() -> None:
    """On the CPU in place of a card: from twins to the networks themselves."""
    whole, moved = (learner("recommended", "stacking", apart=apart) for apart in (False, True))
    for _ in range(3):
        whole.update()
        moved.update()
    moved.move(torch.device("cpu"))
    assert moved.seat[0].device is None
    for _ in range(3):
        whole.update()
        moved.update()
    assert_alike(moved, whole)


def test_stacked_learners_are_trained_where_they_were_put() -> None:
    """On the CPU in place of a card."""
    stacks = [StackedSeeds.fresh(of_task("stacking"), settings("recommended"), (1, 2)) for _ in range(2)]
    for each in stacks[1].learners:
        twinned(each)
    for stack in stacks:
        for each in stack.learners:
            each.add(judged("stacking", 4)[:1])
        stack.work_off()
    assert [each.seat[0].device for each in stacks[1].learners] == [torch.device("cpu")] * 2
    for ours, theirs in zip(stacks[1].learners, stacks[0].learners, strict=True):
        assert_alike(ours, theirs)


@pytest.mark.parametrize(("preset", "task"), CASES)
def test_every_tensor_of_a_step_is_on_one_device_by_meta_tensors(
    preset: str, task: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Devices and shapes without values. Adam has a test of its own."""
    monkeypatch.setattr(sys.modules["torch.optim.optimizer"], FUSED, lambda: ["meta"])
    made = learner(preset, task, apart=False)
    drawn = made.draw()
    meta = torch.device("meta")
    trainer = Trainer([made._networks], made.seat[0].objective, meta)
    lesson = _lesson([drawn]).to(meta)
    with OneDevice():  # type: ignore[no-untyped-call]
        metrics, total = trainer._gradients(lesson)
    found = {**trainer.arena.state, "metrics": metrics, "total": total, "gradients": trainer.arena.gradients}
    assert {name: tensor.device for name, tensor in found.items()} == dict.fromkeys(found, meta)
    assert (metrics.shape, total.shape) == ((1, 7), (1,))
    assert made.update() is not None, "the networks themselves are as before"


def test_a_tensor_left_on_the_cpu_is_noticed_by_meta_tensors(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the test above relies on."""
    monkeypatch.setattr(sys.modules["torch.optim.optimizer"], FUSED, lambda: ["meta"])
    made = learner("recommended", "sweeping", apart=False)
    lesson = _lesson([made.draw()])
    meta = torch.device("meta")
    for name in vars(lesson):
        trainer = Trainer([made._networks], made.seat[0].objective, meta)
        left = replace(lesson.to(meta), **{name: getattr(lesson, name)})
        with pytest.raises((RuntimeError, AssertionError), match=r"device|aten"), OneDevice():  # type: ignore[no-untyped-call]
            trainer._gradients(left)


def test_adam_goes_on_cuda_by_fake_tensors() -> None:
    """The arena's very call, with its state laid out as the arena does."""
    with FakeTensorMode():
        flat, zeros = torch.nn.Parameter(torch.zeros(64, device="cuda")), torch.zeros(64, device="cuda")
        flat.grad = zeros
        adam = torch.optim.Adam([flat], lr=1e-3, fused=True)
        shapes: dict[str, tuple[int, ...]] = {"step": (), "exp_avg": (64,), "exp_avg_sq": (64,)}
        adam.state[flat] = {key: torch.zeros(shape, device="cuda") for key, shape in shapes.items()}
        adam.step()
    assert flat.device.type == adam.state[flat]["step"].device.type == "cuda"


def test_cuda_asked_for_where_there_is_none_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    made = learner("recommended", "stacking", apart=False)
    with pytest.raises(AgentError, match="SEED_LEARNER_DEVICE is cuda") as refused:
        device.place(made, "cuda")
    assert "auto or cpu" in refused.value.remedy
    assert made.update() is not None
    device.place(made, "auto")
    assert made.seat[0].device is None


def test_auto_is_cuda_where_pytorch_says_that_there_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """PyTorch's answer is pretended."""
    monkeypatch.setattr(torch.cuda, "is_available", lambda: True)
    assert [device.chosen(name).type for name in ("auto", "cpu", "cuda")] == ["cuda", "cpu", "cuda"]
