"""What the preset `recommended` is made of: the settings that take each ingredient away, and the steps that lead there.

Pure data for studies, benchmarks and the documentation; imports no torch.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from agent.config import PAPER_SIM, RECOMMENDED, SeedSettings


@dataclass(frozen=True)
class Ablation:
    """One ingredient taken away. settings: those of `SeedSettings` that differ from the preset `recommended`."""

    title: str
    sentence: str
    settings: Mapping[str, Any] = field(default_factory=dict)


def _without(title: str, sentence: str, **settings: Any) -> Ablation:
    return Ablation(title, sentence, MappingProxyType(settings))


ABLATIONS: Mapping[str, Ablation] = MappingProxyType(
    {
        "nothing": _without("recommended", "The preset as it is."),
        "augmentation": _without(
            "no augmentation",
            "Stored labels are learned from where they were given, not moved, mirrored or turned.",
            augment_translation=0.0,
            augment_flip=False,
            augment_rotation=False,
        ),
        "relative_critic": _without(
            "absolute critic",
            "The critic reads parameters in the robot's frame only, not relative to the skill's key points.",
            relative_critic=False,
        ),
        "grounded_actor": _without(
            "ungrounded actor",
            "The actor puts out a position in the workspace instead of a key point and an offset from it.",
            grounded_actor=False,
        ),
        "skill_keypoints": _without(
            "key points shared",
            "Every skill sees all key points of the task instead of its own.",
            keypoints="all",
        ),
        "keypoints": _without("no key points", "The networks are told of no places that matter.", keypoints="none"),
        "candidates": _without(
            "no candidates",
            "A proposal is drawn from the actors; the critic ranks nothing, so neither good calls come back nor "
            "refused ones stay away.",
            candidates=0,
        ),
        "optimism": _without(
            "no optimism",
            "A skill that never was called good gets no head start among the candidates.",
            explore_optimism=0.0,
        ),
        "elimination": _without(
            "random search",
            "Where no key point leads to a good position, candidates are random instead of where most is left to "
            "rule out.",
            explore_elimination=False,
        ),
        "avoid_refused": _without(
            "refused spots stay",
            "What was refused in this very situation may be proposed again.",
            avoid_refused=False,
        ),
        "locality": _without(
            "no locality",
            "A call near its key point, or near what was good there, has no advantage over one farther away.",
            explore_locality=0.0,
        ),
        "fatigue": _without(
            "no fatigue",
            "A skill that was refused in this situation is as likely to be tried again there as any other.",
            explore_fatigue=False,
        ),
        "recall": _without("no recall", "Calls that were good before are not candidates again.", recall=0),
        "balanced_replay": _without(
            "unbalanced replay",
            "Batches hold as many good labels as there happen to be, not half.",
            balanced_replay=False,
        ),
        "consensus": _without(
            "no consensus",
            "Every label is taken at its word; those of like calls don't vote on it.",
            consensus=0.0,
        ),
        "trainer_reliability": _without(
            "trainers alike",
            "Where several trainers judge, all their votes weigh the same. Without effect where one does.",
            trainer_reliability=False,
        ),
        "twin_critic": _without("one critic", "A single critic instead of the lower of two.", critics=1),
        "gradient_steps": _without(
            "5 steps a label", "As few gradient steps as in the paper, not 20.", gradient_steps=5
        ),
        "temperature": _without(
            "temperature from 1",
            "Both entropy temperatures start where MAPLE's do.",
            initial_temperature=1.0,
        ),
        "learning_rate": _without("learning rate 3e-3", "The paper's step size, not 1e-3.", learning_rate=3e-3),
        "wide_networks": _without(
            "256 units, batch 256",
            "The paper's layer and batch sizes, not 64 and 128.",
            hidden_size=256,
            batch_size=256,
        ),
    }
)
"""Ingredient -> what `recommended` is without it; `nothing` is the reference row."""


def _ladder() -> Mapping[str, Ablation]:
    """Each step keeps what those before it added; what is still missing is as in the paper."""
    steps: tuple[tuple[str, str, str, tuple[str, ...]], ...] = (
        ("paper", "paper_sim", "The paper to the letter.", ()),
        (
            "training",
            "+ training",
            "20 steps a label of 1e-3 instead of 5 of 3e-3, temperatures from 0.2, 64 units, batch 128.",
            ("learning_rate", "gradient_steps", "initial_temperature", "hidden_size", "batch_size"),
        ),
        (
            "augmentation",
            "+ key points, augmentation",
            "The networks are told each skill's key points; stored labels are moved, mirrored and turned with them.",
            ("keypoints", "augment_translation", "augment_flip", "augment_rotation"),
        ),
        (
            "relative_critic",
            "+ relative critic",
            "The critic reads parameters relative to the skill's key points.",
            ("relative_critic",),
        ),
        (
            "candidates",
            "+ candidates",
            "Of many calls the critic's favourites are proposed, refused spots are left out, and what never was called "
            "good gets a head start.",
            ("candidates",),
        ),
        (
            "grounded_actor",
            "+ grounded actor",
            "The actor chooses a key point with the skill, and an offset from there.",
            ("grounded_actor",),
        ),
        (
            "elimination",
            "+ elimination",
            "Where no key point leads to the goal, each refusal rules out a neighbourhood.",
            ("explore_elimination",),
        ),
        ("recall", "+ recall", "Calls that were good are candidates again.", ("recall",)),
        ("consensus", "+ consensus", "Labels of like calls vote on each other.", ("consensus",)),
        (
            "trainer_reliability",
            "+ trainer reliability",
            "Votes weigh as much as their trainers can be believed: `recommended`.",
            ("trainer_reliability",),
        ),
    )
    paper, missing = SeedSettings(**PAPER_SIM).model_dump(), set(RECOMMENDED)
    ladder = {}
    for name, title, sentence, added in steps:
        missing -= set(added)
        ladder[name] = _without(title, sentence, **{field: paper[field] for field in RECOMMENDED if field in missing})
    return MappingProxyType(ladder)


LADDER = _ladder()
"""From `paper_sim` to `recommended`, step by step; settings are, as above, what differs from `recommended`."""
