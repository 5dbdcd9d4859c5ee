"""What a learner process is configured with, and where its checkpoints lie."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from server.schemas import Experiment
from server.schemas_records import Checkpoint
from server.settings import Settings


def configuration(experiment: Experiment, settings: Settings, *, lockstep: bool) -> dict[str, Any]:
    """The arguments of the command `configure`."""
    return {
        "task": experiment.task,
        "algorithm": experiment.algorithm,
        "settings": experiment.settings,
        "seed": experiment.seed,
        "lockstep": lockstep,
        "threads": settings.learner_threads,
        "device": settings.learner_device,
    }


def checkpoint_folder(settings: Settings, experiment_id: int) -> Path:
    """Where an experiment's learners are saved."""
    return settings.data_dir.resolve() / "checkpoints" / str(experiment_id)


def checkpoint_name(policy_version: int, last_feedback_id: int) -> str:
    """A checkpoint's file."""
    return f"{policy_version:08d}-{last_feedback_id:08d}.ckpt"


def checkpoint_path(settings: Settings, experiment_id: int, checkpoint: Checkpoint) -> Path:
    """Where this one lies."""
    name = checkpoint_name(checkpoint.policy_version, checkpoint.last_feedback_id)
    return checkpoint_folder(settings, experiment_id) / name
