"""Settings of each algorithm, and the light objects that the entry points of `seed.algorithms` name.

Importing this module imports no torch: the catalogue lists algorithms without loading them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from agent.algorithm import AgentError, Algorithm, Problem


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
    hidden_size: Annotated[int, Field(ge=1, le=4096, description="units of a hidden layer (MAPLE: 256)")] = 256
    hidden_layers: Annotated[int, Field(ge=1, le=8, description="hidden layers of each network (MAPLE: 2)")] = 2
    critics: Annotated[
        int,
        Field(
            ge=1,
            le=16,
            description="human critics; the actors follow the lowest. The paper has one H_theta; MAPLE's twins mend "
            "the optimism of bootstrapping, which a regression on labels doesn't have",
        ),
    ] = 1
    initial_temperature: Annotated[
        float, Field(gt=0, le=100, description="both entropy temperatures at the start (MAPLE: 1); they are learned")
    ] = 1.0
    skill_entropy: Annotated[
        float,
        Field(
            ge=0, le=1, description="target entropy of the skill actor as a share of log(skills) (MAPLE's script: 0.5)"
        ),
    ] = 0.5
    parameter_entropy: Annotated[
        float,
        Field(
            ge=-20,
            le=0.69,
            description="target entropy of a parameter actor in nats for each parameter, parameters scaled to [-1, 1] "
            "(MAPLE and SAC: -1; a uniform distribution has log 2)",
        ),
    ] = -1.0


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


class SeedFactory:
    """Builds SEED (paper, section III). Imports torch only when called."""

    name = "seed"
    description = (
        "SEED: a skill actor, one parameter actor a skill and a critic that predicts human feedback, trained from "
        "good, neutral and bad"
    )
    settings: type[BaseModel] = SeedSettings
    presets: Mapping[str, Mapping[str, Any]] = MappingProxyType({"paper_sim": PAPER_SIM, "paper_real": PAPER_REAL})

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
