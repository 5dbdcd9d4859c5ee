"""Every setting of the service; each is also an environment variable `SEED_...` (docs/settings.md lists them)."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict


class Settings(BaseSettings):
    """Settings of the service. Command-line options win over the environment, the environment over the defaults."""

    model_config = SettingsConfigDict(env_prefix="SEED_", extra="ignore", frozen=True)

    host: Annotated[str, Field(description="address to listen on; anything but loopback needs SEED_LOGIN")] = (
        "127.0.0.1"
    )
    port: Annotated[int, Field(ge=0, le=65535, description="TCP port to listen on; 0 takes a free one")] = 8000
    data_dir: Annotated[
        Path, Field(description="directory of the database, its backups, the images and the checkpoints")
    ] = Path("data")
    database_url: Annotated[
        str | None,
        Field(description="SQLAlchemy URL of the database, e.g. of PostgreSQL; none: SQLite in the data directory"),
    ] = None
    login: Annotated[
        bool,
        Field(
            description="ask everybody who they are. The first start prints the owner's way in, good for once; the "
            "owner invites others"
        ),
    ] = False
    owner_token_file: Annotated[
        Path | None,
        Field(
            description="file that holds the owner's token, at least 32 characters, with a login: a container's "
            "secret. A new token in it ends the owner's sessions at the next start; none: the first start makes one"
        ),
    ] = None
    root_path: Annotated[
        str,
        Field(
            pattern=r"^(/[A-Za-z0-9._~-]+)*$",
            description="path under which a proxy in front publishes the service, e.g. /seed; none: at its root",
        ),
    ] = ""
    trusted_proxies: Annotated[
        str,
        Field(description="comma-separated addresses of proxies whose X-Forwarded-For and X-Forwarded-Proto count"),
    ] = "127.0.0.1"
    session_hours: Annotated[
        float, Field(gt=0, le=24 * 365, description="hours that somebody stays signed in, with a login")
    ] = 720.0
    rate_limit: Annotated[
        str,
        Field(
            pattern=r"^[1-9][0-9]{0,8}/(second|minute|hour)$",
            description="with a login, requests of one person, messages of a stream's session, and requests of all "
            "strangers at one address; an emergency stop is always taken",
        ),
    ] = "6000/minute"
    allowed_hosts: Annotated[
        tuple[str, ...],
        NoDecode,
        Field(
            description="comma-separated host names, beside loopback, under which browsers may reach the service, "
            "e.g. the name of the proxy in front of it; name:port where the proxy keeps a port of its own to itself. "
            "Needs SEED_LOGIN"
        ),
    ] = ()
    log_level: Annotated[
        Literal["critical", "error", "warning", "info", "debug"], Field(description="least serious line to log")
    ] = "info"
    create_first_experiment: Annotated[
        bool, Field(description="create a Stacking experiment on robosuite at start where there is no experiment")
    ] = True
    max_body_bytes: Annotated[
        int, Field(ge=1024, description="largest body of a request, bytes; a larger one is refused with 413")
    ] = 1_000_000
    viewer_queue: Annotated[
        int,
        Field(ge=8, description="events that may wait for one viewer of a stream; one more and it is disconnected"),
    ] = 256
    ping_interval: Annotated[
        float, Field(gt=0, description="seconds between the pings that find dead viewers of a stream")
    ] = 20.0
    robot_deadline: Annotated[
        float, Field(gt=0, description="seconds after which a robot worker that doesn't answer counts as hung")
    ] = 120.0
    operator_silence: Annotated[
        float, Field(gt=0, le=30, description="seconds without word of an attending operator until a real robot stops")
    ] = 1.0
    learner_deadline: Annotated[
        float, Field(gt=0, description="seconds after which a learner worker that doesn't answer counts as hung")
    ] = 120.0
    learner_threads: Annotated[int, Field(ge=1, le=64, description="CPU threads of one learner worker")] = 1
    learner_device: Annotated[
        Literal["auto", "cpu", "cuda"],
        Field(
            description="where learners, SEED's in a study too, take their gradient steps: cpu, cuda, or auto: CUDA "
            "where PyTorch can use it and the algorithm can be moved, else the CPU"
        ),
    ] = "auto"
    checkpoint_every: Annotated[int, Field(ge=1, description="feedback between two checkpoints of the learner")] = 50

    @field_validator("allowed_hosts", mode="before")
    @classmethod
    def _split(cls, value: object) -> object:
        """The environment gives one string: `a.example,b.example`."""
        return (
            tuple(part.strip().lower() for part in value.split(",") if part.strip())
            if isinstance(value, str)
            else value
        )

    @property
    def loopback(self) -> bool:
        """Whether only this machine can reach the service."""
        return self.host in ("localhost", "::1") or self.host.startswith("127.")


def documentation() -> str:
    """docs/settings.md: every setting with its environment variable, default and meaning."""
    lines = [
        "# Settings",
        "",
        "Every setting is an environment variable. `seed serve --host --port --data-dir` win over the environment.",
        "",
        "| variable | default | meaning |",
        "|---|---|---|",
    ]
    for name, field in Settings.model_fields.items():
        default = field.default
        shown = "none" if default in (None, ()) else str(default)
        shown = shown.lower() if isinstance(default, bool) else shown
        lines.append(f"| `SEED_{name.upper()}` | `{shown}` | {field.description} |")
    return "\n".join(lines) + "\n"
