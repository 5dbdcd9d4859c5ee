"""Pictures named by their content."""

from __future__ import annotations

import hashlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from server.images import Images
from server.store_errors import NotFound, StoreError


def test_a_picture_comes_back_under_its_hash(tmp_path: Path) -> None:
    images = Images(tmp_path)
    sha = images.put(b"picture")
    assert sha == hashlib.sha256(b"picture").hexdigest()
    assert images.path(sha).read_bytes() == b"picture"


def test_the_same_picture_is_one_file_written_once(tmp_path: Path) -> None:
    images = Images(tmp_path)
    first = images.path(images.put(b"picture"))
    before = first.stat().st_mtime_ns
    assert images.path(images.put(b"picture")) == first
    assert first.stat().st_mtime_ns == before
    assert [p for p in tmp_path.rglob("*") if p.is_file()] == [first]


def test_many_at_once_leave_whole_files_only(tmp_path: Path) -> None:
    pictures = [bytes([n % 5]) * 10_000 for n in range(40)]
    with ThreadPoolExecutor(8) as pool:
        hashes = list(pool.map(Images(tmp_path).put, pictures))
    for picture, sha in zip(pictures, hashes, strict=True):
        assert Images(tmp_path).path(sha).read_bytes() == picture
    assert len([p for p in tmp_path.rglob("*") if p.is_file()]) == 5


@pytest.mark.parametrize("name", ["", "0" * 63, "../../etc/passwd", "G" * 64, "0" * 64, "A" * 64, "0" * 64 + "\n"])
def test_no_other_file_can_be_asked_for(tmp_path: Path, name: str) -> None:
    with pytest.raises(NotFound) as caught:
        Images(tmp_path).path(name)
    assert caught.value.remedy


def test_a_directory_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "images").write_bytes(b"a file in the way")
    with pytest.raises(StoreError) as caught:
        Images(tmp_path).put(b"picture")
    assert "images" in caught.value.remedy
