"""Still images as files named by their content: the robot worker writes them, the image route reads them."""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import threading
from pathlib import Path

from server.store_errors import Full, NotFound, StoreError

_SHA256 = re.compile(r"[0-9a-f]{64}")


class Images:
    """The directory `images` below the data directory. Safe to use from several processes at once."""

    def __init__(self, data_dir: Path) -> None:
        self._root = data_dir / "images"

    def put(self, jpeg: bytes) -> str:
        """Keep a picture and return its SHA-256 in hex. Once it returns, the file survives a power cut.

        Raises:
            Full: no room on the disk. StoreError: the directory can't be written.
        """
        sha = hashlib.sha256(jpeg).hexdigest()
        target = self._target(sha)
        if target.exists():
            return sha
        # a name of its own: two that write the same picture at once must not share a half-written file
        partial = target.with_suffix(f".{os.getpid()}-{threading.get_ident()}.part")
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            with partial.open("wb") as file:
                file.write(jpeg)
                file.flush()
                os.fsync(file.fileno())
            partial.replace(target)
            _sync_directory(target.parent)
        except OSError as error:
            with contextlib.suppress(OSError):
                partial.unlink(missing_ok=True)
            if error.errno in (28, 122):  # ENOSPC, EDQUOT
                raise Full(str(error)) from error
            raise StoreError(
                f"the image can't be written: {error}", remedy=f"make {self._root} writable for the user of the service"
            ) from error
        return sha

    def path(self, sha: str) -> Path:
        """Where the picture lies.

        Raises:
            NotFound: no such picture, or not a SHA-256 in hex.
        """
        if not _SHA256.fullmatch(sha):
            raise NotFound("image", "of that name")
        target = self._target(sha)
        if not target.is_file():
            raise NotFound("image", sha)
        return target

    def _target(self, sha: str) -> Path:
        return self._root / sha[:2] / f"{sha}.jpg"  # 256 directories keep listings short


def _sync_directory(path: Path) -> None:
    """A rename is durable only once its directory is."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
