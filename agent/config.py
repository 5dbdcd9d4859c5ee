"""Settings of each algorithm, and the light objects that the entry points of `seed.algorithms` name.

Importing this module imports no torch: the catalogue lists algorithms without loading them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from agent.algorithm import AgentError, Algorithm, Problem

# of SEED and of what it is compared with (agent.baseline_config)
HiddenSize = Annotated[int, Field(ge=1, le=4096, description="units of a hidden layer (MAPLE: 256)")]
HiddenLayers = Annotated[int, Field(ge=1, le=8, description="hidden layers of each network (MAPLE: 2)")]
SkillEntropy = Annotated[
    float,
    Field(ge=0, le=1, description="target entropy of the skill actor as a share of log(skills) (MAPLE's script: 0.5)"),
]
ParameterEntropy = Annotated[
    float,
    Field(
        ge=-20,
        le=0.69,
        description="target entropy of a parameter actor in nats for each parameter, parameters scaled to [-1, 1] "
        "(MAPLE and SAC: -1; a uniform distribution has log 2)",
    ),
]


class SeedSettings(BaseModel):
    """Settings of SEED. The defaults are the simulation column of the paper's hyper-parameter table.

    What the paper leaves open follows MAPLE, on which it builds (Nasiriany et al., 2022, and its published run
    script); each field says so.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    learning_rate: Annotated[
        float, Field(gt=0, le=0.1, description="Adam step size of critic, actors and temperatures (table: 3e-3)")
    ] = 3e-3
    batch_size: Annotated[
        int,
        Field(ge=4, le=65536, description="labels in one gradient step (table: 256 in simulation, 1024 on a robot)"),
    ] = 256
    discount: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="the table's gamma (0.99 / 0.4). Without effect: eq. 1 regresses the label itself and looks at "
            "no next state. Kept so that a preset is the table's whole column",
        ),
    ] = 0.99
    gradient_steps: Annotated[
        int, Field(ge=0, le=10000, description="gradient steps owed every `train_frequency` labels (table: 5 / 30)")
    ] = 5
    train_frequency: Annotated[
        int, Field(ge=1, le=10000, description="labels between two rounds of gradient steps (table: 1 / 25)")
    ] = 1
    think_time_updates: Annotated[
        int,
        Field(
            ge=0,
            le=10000,
            description="extra gradient steps that each fresh label allows while a person thinks about the next "
            "proposal; 0 keeps exactly to the table's schedule",
        ),
    ] = 0
    affordance_penalty: Annotated[
        float,
        Field(
            ge=0,
            le=2,
            description="taken off a label whose skill parameter is near no task-relevant object (paper: 0.1, used on "
            "the real robot); 0 turns it off",
        ),
    ] = 0.0
    hidden_size: HiddenSize = 256
    hidden_layers: HiddenLayers = 2
    critics: Annotated[
        int,
        Field(
            ge=1,
            le=16,
            description="human critics; the actors follow the lowest. The paper doesn't say how many stand for H_theta "
            "(MAPLE: twins)",
        ),
    ] = 2
    initial_temperature: Annotated[
        float, Field(gt=0, le=100, description="both entropy temperatures at the start (MAPLE: 1); they are learned")
    ] = 1.0
    skill_entropy: SkillEntropy = 0.5
    parameter_entropy: ParameterEntropy = -1.0
    keypoints: Annotated[
        Literal["none", "all", "skill"],
        Field(
            description="what the networks are told of task-relevant places (the paper's affordance knowledge): "
            "nothing, all of them for every skill, or each skill its own (pick at objects, place at what carries them)"
        ),
    ] = "none"
    relative_critic: Annotated[
        bool, Field(description="the critic also reads the parameters relative to the skill's key points")
    ] = False
    grounded_actor: Annotated[
        bool,
        Field(description="the actor chooses a key point with the skill, and its parameters are an offset from there"),
    ] = False
    grounding_radius: Annotated[
        float, Field(gt=0, le=0.5, description="m from its key point that a grounded offset reaches in x, y and z")
    ] = 0.04
    augment_translation: Annotated[
        float,
        Field(
            ge=0,
            le=1,
            description="m that the whole scene of a stored label is moved at most, in x and in y, whenever it is "
            "drawn; 0 turns it off. Without effect where the state has no key points, as for every augmentation",
        ),
    ] = 0.0
    augment_flip: Annotated[
        bool, Field(description="the whole scene of a stored label is mirrored in y, every other time it is drawn")
    ] = False
    augment_rotation: Annotated[
        bool,
        Field(
            description="the whole scene of a stored label is turned about the vertical by any angle; without effect "
            "where a skill pushes or keeps the gripper's yaw"
        ),
    ] = False
    candidates: Annotated[
        int,
        Field(
            ge=0,
            le=4096,
            description="calls drawn for each skill (and key point) of which the critic's favourite is proposed; 0 "
            "proposes what the actors draw, as the paper does",
        ),
    ] = 0
    candidate_temperature: Annotated[
        float,
        Field(gt=0, le=10, description="softness of the choice among candidates, in units of predicted feedback"),
    ] = 0.1
    explore_optimism: Annotated[
        float,
        Field(
            ge=0,
            le=2,
            description="added to the score of a candidate whose skill (and key point) was never called good",
        ),
    ] = 1.0
    explore_spacing: Annotated[
        float,
        Field(
            gt=0,
            le=0.5,
            description="m around a refused spot without a key point where candidates of the same situation lose score",
        ),
    ] = 0.05
    explore_locality: Annotated[
        float,
        Field(
            ge=0,
            le=10,
            description="what a candidate loses a grounding radius away from its key point, or from what was good "
            "there: of calls that promise alike, the nearest is made; four times that at a push that never was good",
        ),
    ] = 1.5
    explore_fatigue: Annotated[
        bool,
        Field(
            description="with `candidates`: each refusal in this very situation takes a little off every call of its "
            "skill (and key point), so that others get their turn"
        ),
    ] = True
    balanced_replay: Annotated[
        bool,
        Field(
            description="a batch is half good and half bad, whatever there is more of (paper: balanced replay "
            "buffer); otherwise each label is as likely"
        ),
    ] = True
    consensus: Annotated[
        float,
        Field(
            ge=0,
            le=0.05,
            description="m between two calls at the same key point, in situations that look alike, whose labels still "
            "vote on each other, because trainers err: a label means what most of those say; 0 takes each at its word",
        ),
    ] = 0.0
    trainer_reliability: Annotated[
        bool,
        Field(
            description="with `consensus`, where several trainers judge: a vote weighs as much as its trainer's labels "
            "agree with what the others around them let expect; otherwise all weigh the same"
        ),
    ] = False
    explore_elimination: Annotated[
        bool,
        Field(
            description="a skill without key points that was never called good is tried where most is left of what "
            "refusals within `explore_spacing` have not ruled out, and so are direction and length of a push at a key "
            "point; otherwise at random, away from them"
        ),
    ] = False
    avoid_refused: Annotated[
        bool,
        Field(description="with `candidates`: calls near one that was refused in this very situation lose their turn"),
    ] = True
    explore: Annotated[
        Literal["value", "uncertainty"],
        Field(
            description="what speaks for a candidate: the lowest of the critics' predictions, or their mean plus their "
            "disagreement (needs `critics` of 2 or more, and `candidates`), so that what would teach most is asked"
        ),
    ] = "value"
    explore_curiosity: Annotated[
        float,
        Field(
            ge=0,
            le=10,
            description="with `explore` uncertainty: how many standard deviations of the critics are added to the mean",
        ),
    ] = 1.0
    recall: Annotated[
        int,
        Field(
            ge=0, le=512, description="newest good calls that are candidates again, each at its key point's new place"
        ),
    ] = 0

    @model_validator(mode="after")
    def _can_disagree(self) -> SeedSettings:
        if self.explore == "uncertainty" and (self.critics < 2 or not self.candidates):
            raise ValueError("explore 'uncertainty' needs critics of 2 or more, and candidates: set both, or 'value'")
        return self


PAPER_SIM: Mapping[str, Any] = MappingProxyType(
    {"learning_rate": 3e-3, "batch_size": 256, "discount": 0.99, "gradient_steps": 5, "train_frequency": 1}
)
"""Paper, table of training hyper-parameters, column SEED, left of the slash."""

PAPER_REAL: Mapping[str, Any] = MappingProxyType(
    {
        "learning_rate": 3e-3,
        "batch_size": 1024,
        "discount": 0.4,
        "gradient_steps": 30,
        "train_frequency": 25,
        "affordance_penalty": 0.1,  # paper, "Facilitating learning with affordances": in real robot experiments
    }
)
"""Paper, table of training hyper-parameters, column SEED, right of the slash."""


RECOMMENDED: Mapping[str, Any] = MappingProxyType(
    {
        "learning_rate": 1e-3,
        "batch_size": 128,
        "gradient_steps": 20,
        "hidden_size": 64,
        "initial_temperature": 0.2,
        "keypoints": "skill",
        "relative_critic": True,
        "grounded_actor": True,
        "augment_translation": 0.1,
        "augment_flip": True,
        "augment_rotation": True,
        "candidates": 32,
        "recall": 16,
        "explore_elimination": True,
        "consensus": 0.008,
        "trainer_reliability": True,
    }
)
"""What needs the fewest clicks (measured by `tests/benchmarks/clicks_kinematic.py`)."""


class SeedFactory:
    """Builds SEED (paper, section III). Imports torch only when called."""

    name = "seed"
    description = (
        "SEED: a skill actor, one parameter actor a skill and a critic that predicts human feedback, trained from "
        "good, neutral and bad"
    )
    settings: type[BaseModel] = SeedSettings
    presets: Mapping[str, Mapping[str, Any]] = MappingProxyType(
        {"paper_sim": PAPER_SIM, "paper_real": PAPER_REAL, "recommended": RECOMMENDED}
    )

    def __call__(self, problem: Problem, settings: BaseModel, seed: int) -> Algorithm:
        """Build the learner.

        Raises:
            AgentError: the settings are of another algorithm, or the problem has no skills or no valid state bounds.
        """
        from agent.seed import Seed  # noqa: PLC0415 - torch stays out of processes that only list algorithms

        if not isinstance(settings, SeedSettings):
            raise AgentError(
                f"settings are {type(settings).__name__}, not SeedSettings",
                remedy="validate them with the factory's own `settings` model",
            )
        return Seed(problem, settings, seed)


SEED = SeedFactory()
