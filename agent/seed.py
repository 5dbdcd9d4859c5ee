"""SEED: skill-based learning from human evaluative feedback (paper, section III and Algorithm 1).

Three learners share each batch: the critic H_theta regresses the labels (eq. 1), the skill actor pi_phi and the
parameter actors pi_psi climb it under an entropy bonus (eq. 2 and 3), both temperatures are learned. There is no
bootstrapping: the target of the critic is the label, so no discount and no target network appear.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch

from agent import checkpoint
from agent.algorithm import CheckpointError, Label, Problem, Suggestion
from agent.arena import ADAM_STATE
from agent.candidates import Chooser, search_of
from agent.config import SeedSettings
from agent.consensus import Consensus
from agent.encoding import Encoder
from agent.grounding import grounding
from agent.kernels import no_pause
from agent.networks import Layout, Networks, dice
from agent.proposing import Choice, choose, estimate, likeliest
from agent.replay import Batch, Replay
from agent.symmetry import symmetries
from agent.training import Objective, Trainer
from robot_adapters.base import Array, SkillCall


class Seed:
    """Implements `agent.algorithm.Algorithm`.

    Proposing and training draw from separate random states: with the same seed, labels in the same order and the same
    number of updates, proposals are the same whenever the updates happened.
    """

    def __init__(self, problem: Problem, settings: SeedSettings, seed: int) -> None:
        self._settings = settings
        self._encoder = Encoder(problem, keypoints=settings.keypoints)
        initial, proposing, training, drawing = np.random.SeedSequence(seed).spawn(4)
        self._proposing = dice(proposing)
        self._training = dice(training)
        self._drawing = np.random.default_rng(drawing)
        layout = Layout(self._encoder.state_size, self._encoder.parameter_counts)
        self._grounding = grounding(
            problem.skills,
            self._encoder.keypoint_counts,
            grounded=settings.grounded_actor,
            relative=settings.relative_critic,
            radius=settings.grounding_radius,
        )
        self._symmetries = symmetries(problem, settings, self._encoder)
        self._networks = Networks(
            layout,
            hidden=[settings.hidden_size] * settings.hidden_layers,
            critics=settings.critics,
            initial_temperature=settings.initial_temperature,
            generator=dice(initial),
            grounding=self._grounding,
        )
        objective = Objective(
            settings.learning_rate,
            skill_entropy=settings.skill_entropy * math.log(self._grounding.options),
            parameter_entropy=settings.parameter_entropy * self._networks.mask.sum(dim=-1),
        )
        self._trainer, self._place = Trainer([self._networks], objective), 0
        consensus = None
        if settings.consensus:
            consensus = Consensus(
                self._grounding,
                layout.state_size,
                problem.position_fields,
                settings.consensus,
                weighed=settings.trainer_reliability,
            )
        self._replay = Replay(
            layout.state_size,
            layout.width,
            self._encoder.keypoint_shape,
            balanced=settings.balanced_replay,
            believed=consensus.believed if consensus else None,
        )
        self._chooser: Chooser | None = None
        if settings.candidates:
            self._chooser = Chooser(self._networks, self._grounding, self._replay, search_of(settings))
        self._forgotten: set[int] = set()
        self._labels_seen = 0
        self._owed = 0
        self._spare = 0
        self.pause: Callable[[], None] = no_pause
        self.policy_version = 0
        self.last_label_id = 0
        self._heard = 0
        """`last_label_id` at the last `restore`: labels up to it owe no updates."""

    @property
    def owed_updates(self) -> int:
        """Gradient steps that the schedule asks for and that are not yet worked off."""
        return self._owed

    @property
    def spare_updates(self) -> int:
        """Gradient steps beyond the owed ones that fresh labels allow while a person thinks."""
        return self._spare

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """Suggest a call for state (n,).

        Raises:
            AgentError: the state has the wrong shape or holds a value that is not finite.
        """
        return self._suggestion(self._choose(state, deterministic=deterministic))

    def propose_beside(self, state: Array, pending: Sequence[SkillCall]) -> Suggestion:
        """Suggest a call for state (n,), supposing that the pending ones, which wait to be judged, will be refused.

        Raises:
            AgentError: as `propose`, or a pending call doesn't fit the task.
        """
        return self._suggestion(self._choose(state, deterministic=False, pending=pending))

    def _suggestion(self, choice: Choice) -> Suggestion:
        names = self._encoder.skill_names
        return Suggestion(
            call=self._encoder.call(choice.skill, choice.parameters),
            predicted_feedback=choice.predicted,
            skill_probabilities={name: float(p) for name, p in zip(names, choice.probabilities, strict=True)},
            policy_version=self.policy_version,
            uncertainty=choice.uncertainty,
        )

    def _choose(self, state: Array, *, deterministic: bool, pending: Sequence[SkillCall] = ()) -> Choice:
        scaled, keypoints = self._encoder.state(state), self._encoder.keypoints(state)
        if self._chooser is not None:
            refused = self._replay.empty()
            for number, call in enumerate(pending):
                refused.add(self._encoder.entry(Label(number, state, call, -1), affordance_penalty=0.0))
            return self._chooser.choose(
                scaled, keypoints, self._proposing, deterministic=deterministic, pending=refused.bad()
            )
        return choose(self._networks, scaled, keypoints, self._proposing, deterministic=deterministic)

    def estimate(self, state: Array, calls: Sequence[SkillCall]) -> Array:
        """(n,) state and C calls -> (C,) predicted feedback; nothing changes, and nothing is drawn.

        Raises:
            AgentError: the state or a call doesn't fit the task.
        """
        scaled, keypoints = self._encoder.state(state), self._encoder.keypoints(state)
        skills, parameters = self._encoder.calls(calls)
        return estimate(self._networks, scaled, keypoints, skills=skills, parameters=parameters)

    def consider(self, state: Array) -> list[SkillCall]:
        """(n,) state -> a call of each skill, the one that its actor thinks likeliest; nothing changes or is drawn.

        Raises:
            AgentError: the state doesn't fit the task.
        """
        scaled, keypoints = self._encoder.state(state), self._encoder.keypoints(state)
        found = likeliest(self._networks, scaled, keypoints)
        return [self._encoder.call(skill, parameters) for skill, parameters in enumerate(found)]

    def add(self, labels: Sequence[Label]) -> None:
        """Take labels into the replay and owe their gradient steps. Each is taken once.

        Raises:
            AgentError: a label doesn't fit the task. None of `labels` was taken.
        """
        settings = self._settings
        for label in self._remember(labels):
            self.last_label_id = max(self.last_label_id, label.id)
            self._labels_seen += 1
            if self._labels_seen % settings.train_frequency == 0:
                self._owed += settings.gradient_steps
            self._spare += settings.think_time_updates

    def restore(self, labels: Sequence[Label]) -> None:
        """Fill the replay anew, after `load`: labels up to `last_label_id` owe no updates, newer ones do.

        Raises:
            AgentError: a label doesn't fit the task.
        """
        self._replay.clear()
        self._forgotten.clear()
        self._heard = self.last_label_id
        self.recollect(labels)

    def recollect(self, labels: Sequence[Label]) -> None:
        """Implements `agent.algorithm.Recollecting`: older labels come in front of those held, at little cost.

        Raises:
            AgentError: a label doesn't fit the task. None of those that owe no updates was taken.
        """
        self._remember([label for label in labels if label.id <= self._heard])
        self.add([label for label in labels if label.id > self._heard])

    def forget(self, label_id: int) -> None:
        """Take an undone label out of the replay; unknown ids are ignored."""
        if label_id in self._replay:
            self._replay.forget(label_id)
            self._forgotten.add(label_id)

    def relabel(self, label: Label) -> None:
        """Hold this label in the place of the one of the same id; if none is held, take it. It owes no steps.

        What it changes is worked off in spare steps, and in those that later labels owe.

        Raises:
            AgentError: it doesn't fit the task. Nothing has changed.
        """
        entry = self._encoder.entry(label, affordance_penalty=self._settings.affordance_penalty)
        self._replay.forget(label.id)
        self._replay.add(entry)
        self._forgotten.discard(label.id)
        self._spare += self._settings.think_time_updates

    def update(self) -> Mapping[str, float] | None:
        """One gradient step on critic, actors and temperatures; None where there is nothing to learn from yet.

        Raises:
            AgentError: losses or gradients are no longer finite. The networks are as before this step.
        """
        if not self.ready():
            return None
        if len(self._trainer.learners) > 1:  # trained together with others until now
            self.settle(Trainer.joined([self.seat]), 0)
        (metrics,) = self._trainer.step([self.draw()], self.pause)
        self.stepped()
        return metrics

    def ready(self) -> bool:
        """Whether there is something to learn from. If not, nothing is owed any more: its labels were undone."""
        if not len(self._replay):
            self._owed = self._spare = 0
        return len(self._replay) > 0

    def draw(self) -> tuple[Batch, torch.Tensor]:
        """What the next gradient step learns from: labels, and noise (O, B, P) for the parameters it imagines."""
        return Seed.drawn([self])[0]

    @staticmethod
    def drawn(learners: Sequence[Seed]) -> list[tuple[Batch, torch.Tensor]]:
        """`draw` for several learners of one task and setting, each by its own dice; moved in one pass."""
        batches = [each._replay.sample(each._settings.batch_size, each._drawing) for each in learners]
        moving = learners[0]._symmetries
        if moving is not None:
            motions = [moving.motions(batch, each._drawing) for each, batch in zip(learners, batches, strict=True)]
            shift, flip, angle = (np.concatenate(part) for part in zip(*motions, strict=True))
            batches = moving.moved(Batch.joined(batches), shift, flip, angle).split(len(batches))
        return [(batch, each._noise(len(batch.skills))) for each, batch in zip(learners, batches, strict=True)]

    def _noise(self, size: int) -> torch.Tensor:
        options, _, width = self._networks.mask.shape
        return torch.randn((options, size, width), generator=self._training)

    def stepped(self) -> None:
        """Count a gradient step: an owed one, or else a spare one."""
        self.policy_version += 1
        if self._owed:
            self._owed -= 1
        elif self._spare:
            self._spare -= 1

    @property
    def seat(self) -> tuple[Trainer, int]:
        """What trains the networks, and their place there."""
        return self._trainer, self._place

    def settle(self, trainer: Trainer, place: int) -> None:
        """Be trained by another trainer, which has taken the networks in (`Trainer.joined`)."""
        self._trainer, self._place = trainer, place

    def move(self, device: torch.device) -> None:
        """Implements `agent.algorithm.Movable`. Proposals are made on the CPU, and dice are thrown there.

        Raises:
            RuntimeError: PyTorch can't use that device. Nothing has changed.
        """
        moved = Trainer([self._networks], self._trainer.objective, None if device.type == "cpu" else device)
        moved.recall(0, self._trainer.arena.moments(self._place))
        self.settle(moved, 0)

    def save(self, path: Path) -> None:
        """Write networks, optimiser, temperatures, random states and counters atomically. The replay isn't written."""
        arrays: dict[str, torch.Tensor] = {
            "random.proposing": self._proposing.get_state(),
            "random.training": self._training.get_state(),
        }
        for name, tensor in self._networks.named_parameters():
            arrays[f"network.{name}"] = tensor.detach()
        for name, moments in self._trainer.arena.moments(self._place).items():
            for key, value in moments.items():
                arrays[f"adam.{key}.{name}"] = value.cpu()
        state = {
            "drawing": self._drawing.bit_generator.state,
            "policy_version": self.policy_version,
            "last_label_id": self.last_label_id,
            "labels_seen": self._labels_seen,
            "owed": self._owed,
            "spare": self._spare,
        }
        content = {name: tensor.numpy() for name, tensor in arrays.items()}
        checkpoint.write(path, checkpoint.Checkpoint(self._fingerprint(), state, content))

    def load(self, path: Path) -> None:
        """Read what `save` wrote. The replay is left as it is: `restore` follows.

        Raises:
            CheckpointError: it is damaged or belongs to something else. Nothing has changed.
        """
        read = checkpoint.read(path, self._fingerprint())
        tensors = {name: torch.from_numpy(array) for name, array in read.arrays.items()}
        try:
            drawing = np.random.default_rng(0)
            drawing.bit_generator.state = read.state["drawing"]
            proposing = torch.Generator().set_state(tensors["random.proposing"])
            training = torch.Generator().set_state(tensors["random.training"])
            counters = {
                name: int(read.state[name])
                for name in ("policy_version", "last_label_id", "labels_seen", "owed", "spare")
            }
            parameters = dict(self._networks.named_parameters())
            weights = {name: tensors[f"network.{name}"].view_as(value) for name, value in parameters.items()}
            moments = {
                name: {key: tensors[f"adam.{key}.{name}"] for key in ADAM_STATE}
                for name in parameters
                if counters["policy_version"]
            }
        except (KeyError, TypeError, ValueError, RuntimeError) as error:
            raise CheckpointError(
                f"{path} lacks or garbles {error}",
                remedy="use an older checkpoint, or rebuild the learner from the labels",
            ) from error
        with torch.no_grad():
            for name, parameter in parameters.items():
                parameter.copy_(weights[name])
        self.settle(Trainer([self._networks], self._trainer.objective, self._trainer.device), 0)
        self._trainer.recall(0, moments)
        self._drawing, self._proposing, self._training = drawing, proposing, training
        self.policy_version, self.last_label_id = counters["policy_version"], counters["last_label_id"]
        self._labels_seen, self._owed, self._spare = counters["labels_seen"], counters["owed"], counters["spare"]

    def _remember(self, labels: Sequence[Label]) -> list[Label]:
        """Put those labels into the replay that are new to it; return them in ascending order."""
        fresh = {
            label.id: label for label in labels if label.id not in self._replay and label.id not in self._forgotten
        }
        ordered = [fresh[label_id] for label_id in sorted(fresh)]
        penalty = self._settings.affordance_penalty
        checked = self._replay.empty()  # nothing is taken before all fit; arrays, because there may be a million
        for label in ordered:
            checked.add(self._encoder.entry(label, affordance_penalty=penalty))
        self._replay.take(checked)
        return ordered

    def _fingerprint(self) -> Mapping[str, Any]:
        settings = self._settings
        return {
            "algorithm": "seed",
            **self._encoder.fingerprint(),
            "hidden": [settings.hidden_size] * settings.hidden_layers,
            "critics": settings.critics,
            **_grounded_fingerprint(settings, self._encoder),
        }


def _grounded_fingerprint(settings: SeedSettings, encoder: Encoder) -> Mapping[str, Any]:
    """What key points change of the networks; nothing where they see none, so that older checkpoints still fit."""
    if settings.keypoints == "none":
        return {}
    return {
        "keypoints": list(encoder.keypoint_counts),
        "relative_critic": settings.relative_critic,
        "grounded_actor": [settings.grounded_actor, settings.grounding_radius],
    }
