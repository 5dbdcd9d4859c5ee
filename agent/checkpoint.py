"""Checkpoint files: written whole or not at all, versioned, checksummed, and readable without executing anything.

Layout: 8 bytes magic, u32 version, u64 header length, header (JSON), arrays one after another, SHA-256 of all before.
Numbers are little-endian.
"""

from __future__ import annotations

import hashlib
import json
import os
import struct
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from agent.algorithm import CheckpointError

MAGIC = b"SEEDCKPT"
VERSION = 1
_PREFIX = struct.Struct("<8sIQ")
_DTYPES = frozenset({"<f4", "<f8", "<i8", "|u1"})

Arrays = Mapping[str, NDArray[Any]]
"""Arrays by name, of float32, float64, int64 or uint8."""


@dataclass(frozen=True)
class Checkpoint:
    """fingerprint: what the arrays are for, by topic. state: everything small, as JSON. arrays: the rest."""

    fingerprint: Mapping[str, Any]
    state: Mapping[str, Any]
    arrays: Arrays


def write(path: Path, checkpoint: Checkpoint) -> None:
    """Write beside `path`, sync, then rename over it: a crash leaves the old file or the new one.

    Raises:
        OSError: the folder is missing, full or read-only. `path` is unchanged.
    """
    contents = _encode(checkpoint)
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(contents)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)  # or the rename itself may be lost with the power
    finally:
        os.close(folder)


def read(path: Path, fingerprint: Mapping[str, Any]) -> Checkpoint:
    """Read a checkpoint made for `fingerprint`.

    Raises:
        CheckpointError: missing, damaged, of another version, made for something else, or holding numbers that are not
            finite; the message says which.
    """
    try:
        contents = path.read_bytes()
    except OSError as error:
        raise CheckpointError(
            f"{path} can't be read: {error.strerror}", remedy="name an existing, readable checkpoint file"
        ) from error
    checkpoint = _decode(path, contents)
    ours: Mapping[str, Any] = json.loads(json.dumps(fingerprint))
    differing = sorted(
        k for k in ours.keys() | checkpoint.fingerprint.keys() if ours.get(k) != checkpoint.fingerprint.get(k)
    )
    if differing:
        told = "; ".join(f"{k}: file has {checkpoint.fingerprint.get(k)}, wanted {ours.get(k)}" for k in differing)
        raise CheckpointError(
            f"{path} belongs to something else ({told})",
            remedy="load it with the task, skills and network settings it was made with, or train anew",
        )
    lost = [name for name, array in checkpoint.arrays.items() if not np.isfinite(array).all()]
    if lost:
        raise CheckpointError(
            f"{path} holds numbers that are not finite: {', '.join(lost)}",
            remedy="use an older checkpoint, or rebuild the learner from the labels",
        )
    return checkpoint


def _encode(checkpoint: Checkpoint) -> bytes:
    table: list[list[Any]] = []
    chunks: list[bytes] = []
    for name, array in checkpoint.arrays.items():
        stored = np.asarray(array, order="C")
        stored = stored.astype(stored.dtype.newbyteorder("<"), copy=False)
        if stored.dtype.str not in _DTYPES:
            raise TypeError(f"array {name!r} is of type {stored.dtype}, which checkpoints don't hold")
        table.append([name, stored.dtype.str, list(stored.shape)])
        chunks.append(stored.tobytes())
    header = json.dumps(
        {"fingerprint": dict(checkpoint.fingerprint), "state": dict(checkpoint.state), "arrays": table}, allow_nan=False
    ).encode()
    body = b"".join([_PREFIX.pack(MAGIC, VERSION, len(header)), header, *chunks])
    return body + hashlib.sha256(body).digest()


def _decode(path: Path, contents: bytes) -> Checkpoint:
    damaged = CheckpointError(
        f"{path} is damaged or cut short", remedy="use an older checkpoint; the learner can be rebuilt from the labels"
    )
    if len(contents) < _PREFIX.size:
        raise damaged
    magic, version, length = _PREFIX.unpack_from(contents)
    if magic != MAGIC:
        raise CheckpointError(f"{path} is no checkpoint of this program", remedy="name a file that `save` wrote")
    if version != VERSION:
        raise CheckpointError(
            f"{path} has the format version {version}, this program reads {VERSION}",
            remedy="use the program version that wrote it, or rebuild the learner from the labels",
        )
    body, digest = contents[:-32], contents[-32:]
    if hashlib.sha256(body).digest() != digest:
        raise damaged
    try:
        start = _PREFIX.size + length
        header = json.loads(body[_PREFIX.size : start])
        arrays: dict[str, NDArray[Any]] = {}
        for name, dtype, shape in header["arrays"]:
            count = int(np.prod(shape, dtype=np.int64))
            array = np.frombuffer(body, dtype=np.dtype(dtype), count=count, offset=start)
            arrays[name] = array.reshape(shape).copy()
            start += array.nbytes
        return Checkpoint(header["fingerprint"], header["state"], arrays)
    except (ValueError, KeyError, TypeError) as error:
        raise damaged from error
