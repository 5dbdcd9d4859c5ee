"""A learner from reward written down whole, transitions and random states too, so that it goes on bit for bit.

Unlike SEED's, whose replay is a view of stored feedback, these learners have nothing to rebuild their replay from.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from agent import checkpoint
from agent.algorithm import AgentError, CheckpointError
from agent.arena import ADAM_STATE
from agent.td import Memory, Schedule


@dataclass
class Progress:
    """Everything that changes while a learner learns.

    networks: by name; `optimiser` may train any of them. dice: torch's random states by what they are for.
    drawing: numpy's, which draws batches. version: gradient steps taken.
    """

    networks: Mapping[str, nn.Module]
    optimiser: torch.optim.Adam
    memory: Memory
    schedule: Schedule
    dice: dict[str, torch.Generator]
    drawing: np.random.Generator
    version: int = 0

    def descend(self, loss: Tensor) -> None:
        """One gradient step.

        Raises:
            AgentError: the loss or its gradients are no longer finite. Nothing has changed but random states.
        """
        self.optimiser.zero_grad()
        loss.backward()  # type: ignore[no-untyped-call]
        gradients = [p.grad for group in self.optimiser.param_groups for p in group["params"] if p.grad is not None]
        # Adam squares them, and so does the norm
        if not torch.isfinite(loss + nn.utils.get_total_norm(gradients)):
            raise AgentError(
                f"training diverged at gradient step {self.version}",
                remedy="load the last checkpoint, or start anew with a lower learning_rate",
            )
        self.optimiser.step()
        self.version += 1
        self.schedule.stepped()

    def save(self, path: Path, fingerprint: Mapping[str, Any]) -> None:
        """Write it atomically.

        Raises:
            OSError: the folder is missing, full or read-only. `path` is unchanged.
        """
        arrays: dict[str, Any] = {}
        for name, tensor in self._parameters().items():
            arrays[f"network.{name}"] = tensor.detach().numpy()
            for key, value in self.optimiser.state.get(tensor, {}).items():
                arrays[f"adam.{key}.{name}"] = value.numpy()
        for name, generator in self.dice.items():
            arrays[f"random.{name}"] = generator.get_state().numpy()
        at, columns = self.memory.contents()
        arrays |= {f"memory.{name}": column for name, column in columns.items()}
        state = {
            "version": self.version,
            "seen": self.schedule.seen,
            "owed": self.schedule.owed,
            "memory_at": at,
            "drawing": self.drawing.bit_generator.state,
        }
        checkpoint.write(path, checkpoint.Checkpoint(fingerprint, state, arrays))

    def load(self, path: Path, fingerprint: Mapping[str, Any]) -> None:
        """Read what `save` wrote.

        Raises:
            CheckpointError: it is damaged or belongs to something else. Nothing has changed.
        """
        read = checkpoint.read(path, fingerprint)
        parameters = self._parameters()
        try:
            version, seen, owed, at = (int(read.state[name]) for name in ("version", "seen", "owed", "memory_at"))
            drawing = np.random.default_rng(0)
            drawing.bit_generator.state = read.state["drawing"]
            dice = {
                name: torch.Generator().set_state(torch.from_numpy(read.arrays[f"random.{name}"])) for name in self.dice
            }
            prefix = "memory."
            columns = {n.removeprefix(prefix): a for n, a in read.arrays.items() if n.startswith(prefix)}
            memory = self.memory.restored(at, columns)
            weights = {
                name: torch.from_numpy(read.arrays[f"network.{name}"]).view_as(tensor)
                for name, tensor in parameters.items()
            }
            trained = {name for name in parameters if f"adam.step.{name}" in read.arrays}
            moments = {
                name: {key: torch.from_numpy(read.arrays[f"adam.{key}.{name}"]) for key in ADAM_STATE}
                for name in trained
            }
        except (KeyError, TypeError, ValueError, RuntimeError) as error:
            raise CheckpointError(
                f"{path} lacks or garbles {error}", remedy="use an older checkpoint, or train anew"
            ) from error
        with torch.no_grad():
            for name, tensor in parameters.items():
                tensor.copy_(weights[name])
        self.optimiser.state.clear()
        for name, moment in moments.items():
            self.optimiser.state[parameters[name]] = moment
        self.memory, self.drawing, self.version = memory, drawing, version
        self.dice.update(dice)
        self.schedule.seen, self.schedule.owed = seen, owed

    def _parameters(self) -> dict[str, Tensor]:
        return {
            f"{part}.{name}": tensor
            for part, network in self.networks.items()
            for name, tensor in network.named_parameters()
        }
