"""Checkpoint files: whole or not at all, and refused with a remedy where they don't fit."""

from __future__ import annotations

import hashlib
import json
import os
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from agent.algorithm import CheckpointError
from agent.checkpoint import VERSION, Checkpoint, read, write

FINGERPRINT = {"task": "toy", "skills": [["pick", [["x", 0.0, 0.1]]]]}
STATE = {"policy_version": 7, "random": {"state": 2**127 + 1}}
ARRAYS: dict[str, NDArray[Any]] = {
    "weights": np.arange(6, dtype=np.float32).reshape(2, 3),
    "step": np.array(3.0, dtype=np.float32),
    "empty": np.zeros((0, 4)),
    "random": np.arange(5, dtype=np.uint8),
}
WHOLE = Checkpoint(FINGERPRINT, STATE, ARRAYS)


def written(folder: Path) -> Path:
    path = folder / "a.ckpt"
    write(path, WHOLE)
    return path


def test_what_was_written_is_read(tmp_path: Path) -> None:
    back = read(written(tmp_path), FINGERPRINT)
    assert back.state == STATE
    assert back.arrays.keys() == ARRAYS.keys()
    for name, array in ARRAYS.items():
        assert back.arrays[name].dtype == array.dtype
        assert back.arrays[name].shape == array.shape
        np.testing.assert_array_equal(back.arrays[name], array)


def test_writing_leaves_nothing_else_behind(tmp_path: Path) -> None:
    path = written(tmp_path)
    write(path, WHOLE)
    assert list(tmp_path.iterdir()) == [path]


def test_a_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = written(tmp_path)
    before = path.read_bytes()

    def full(_handle: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write(path, Checkpoint(FINGERPRINT, {"policy_version": 8}, {}))
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_arrays_of_objects_are_never_written(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="object"):
        write(tmp_path / "a.ckpt", Checkpoint({}, {}, {"bad": np.array([object()])}))
    assert not list(tmp_path.iterdir())


def test_arrays_of_objects_are_never_read(tmp_path: Path) -> None:
    header = json.dumps({"fingerprint": {}, "state": {}, "arrays": [["bad", "|O", [1]]]}).encode()
    body = struct.pack("<8sIQ", b"SEEDCKPT", VERSION, len(header)) + header + bytes(8)
    path = tmp_path / "a.ckpt"
    path.write_bytes(body + hashlib.sha256(body).digest())
    with pytest.raises(CheckpointError, match="damaged"):
        read(path, {})


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(CheckpointError, match=r"none\.ckpt can't be read: No such file") as error:
        read(tmp_path / "none.ckpt", FINGERPRINT)
    assert error.value.remedy


def test_another_version_is_told(tmp_path: Path) -> None:
    path = written(tmp_path)
    contents = bytearray(path.read_bytes())
    struct.pack_into("<I", contents, 8, VERSION + 1)
    path.write_bytes(contents)
    with pytest.raises(CheckpointError, match=f"version {VERSION + 1}, this program reads {VERSION}"):
        read(path, FINGERPRINT)


def test_a_foreign_file_is_told(tmp_path: Path) -> None:
    path = tmp_path / "picture.jpg"
    path.write_bytes(b"\xff\xd8" + bytes(1000))
    with pytest.raises(CheckpointError, match="no checkpoint of this program"):
        read(path, FINGERPRINT)


def test_another_task_is_told(tmp_path: Path) -> None:
    with pytest.raises(CheckpointError, match="task: file has toy, wanted stacking") as error:
        read(written(tmp_path), {**FINGERPRINT, "task": "stacking"})
    assert "skills" not in str(error.value)


@pytest.fixture(scope="module")
def intact(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return written(tmp_path_factory.mktemp("intact")).read_bytes()


@settings(max_examples=80, deadline=None)
@given(st.data())
def test_any_flipped_bit_or_cut_is_noticed(
    intact: bytes, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    contents = bytearray(intact)
    if data.draw(st.booleans(), label="cut"):
        contents = contents[: data.draw(st.integers(0, len(intact) - 1), label="length")]
    else:
        contents[data.draw(st.integers(0, len(intact) - 1), label="byte")] ^= 1 << data.draw(st.integers(0, 7))
    path = tmp_path_factory.mktemp("damaged") / "a.ckpt"
    path.write_bytes(contents)
    with pytest.raises(CheckpointError) as error:
        read(path, FINGERPRINT)
    assert error.value.remedy
