# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Folders that hold a tile store: on a disk, or behind whatever URL fsspec opens (``s3://bucket/campus``)."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import uuid
from pathlib import Path

URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*(://|::)")
FLATTENED_URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:/")  # what Path makes of one


class LocalFolder:
    """A folder on a disk, or on one that several machines share."""

    def __init__(self, path: Path):
        self.path = path

    def __str__(self) -> str:
        return str(self.path)

    def make(self, name: str) -> None:
        (self.path / name).mkdir(parents=True, exist_ok=True)

    def has(self, name: str) -> bool:
        return (self.path / name).is_file()

    def read(self, name: str) -> bytes:
        return (self.path / name).read_bytes()

    def write(self, name: str, data: bytes, *, is_to_last: bool = True) -> None:
        """Puts `data` at `name` all or not at all, whatever is killed; if it is to last, or loses power."""
        path = self.path / name
        temporary = path.with_name(f"{path.name}.{uuid.uuid4().hex}.part")
        try:
            with temporary.open("wb") as file:
                file.write(data)
                file.flush()
                if is_to_last:
                    os.fsync(file.fileno())
            os.replace(temporary, path)
        finally:
            temporary.unlink(missing_ok=True)
        if is_to_last:
            folder = os.open(path.parent, os.O_RDONLY)
            try:
                os.fsync(folder)
            finally:
                os.close(folder)

    def sizes(self, name: str) -> dict[str, int]:
        """Of all files below `name`, by their names from here [bytes]."""
        files = (file for file in (self.path / name).rglob("*") if not file.is_dir())
        return {file.relative_to(self.path).as_posix(): file.lstat().st_size for file in files}

    def remove(self, name: str) -> None:
        """Removes a file, or a folder with all that it holds; nothing when it is not there."""
        path = self.path / name
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)


class RemoteFolder:
    """A folder behind a URL. Object stores put an object at its name all or not at all, and have no renaming."""

    def __init__(self, url: str, filesystem, root: str):
        self.path = url.rstrip("/")
        self._filesystem = filesystem
        self._root = root.rstrip("/")

    def __str__(self) -> str:
        return self.path

    def make(self, name: str) -> None:
        with naming(f"{self}/{name}"):
            self._filesystem.makedirs(self._at(name), exist_ok=True)

    def has(self, name: str) -> bool:
        with naming(f"{self}/{name}"):
            self._filesystem.invalidate_cache()  # of listings: others write too
            return self._filesystem.exists(self._at(name))

    def read(self, name: str) -> bytes:
        with naming(f"{self}/{name}"):
            return self._filesystem.cat_file(self._at(name))

    def write(self, name: str, data: bytes, *, is_to_last: bool = True) -> None:
        """Puts `data` at `name`. When it returns, the data lasts as the other side promises."""
        with naming(f"{self}/{name}"):
            self._filesystem.pipe_file(self._at(name), data)

    def sizes(self, name: str) -> dict[str, int]:
        with naming(f"{self}/{name}"):
            self._filesystem.invalidate_cache()
            found = self._filesystem.find(self._at(name), detail=True)
        start = len(self._at(name))
        return {name + path[start:]: entry["size"] for path, entry in found.items()}

    def remove(self, name: str) -> None:
        with naming(f"{self}/{name}"), contextlib.suppress(FileNotFoundError):
            self._filesystem.rm(self._at(name), recursive=True)

    def _at(self, name: str) -> str:
        return f"{self._root}/{name}"


@contextlib.contextmanager
def naming(url: str):
    """Makes an OSError, in one line that names the URL, of whatever goes wrong: each file system has its own."""
    try:
        yield
    except Exception as error:
        lines = str(error).strip().splitlines() or [type(error).__name__]
        is_missing = isinstance(error, FileNotFoundError)
        problem = "does not exist" if is_missing and " " not in lines[0] else lines[0]  # and not its name again
        kind = FileNotFoundError if is_missing else OSError
        raise kind(f"{url}: {problem}") from error


def is_url(where) -> bool:
    return isinstance(where, str) and URL.match(where) is not None


def filesystem_of(url: str):
    """The file system of fsspec for a URL, and the path in it. RuntimeError when a package for it is missing."""
    try:
        from fsspec.core import url_to_fs
    except ImportError as error:
        raise RuntimeError(f"{url}: URLs are read by fsspec: pip install fsspec") from error
    try:
        with naming(url):
            return url_to_fs(url)
    except OSError as error:
        cause = error.__cause__
        kind = {ImportError: RuntimeError, ValueError: ValueError}.get(type(cause))  # what to install, no protocol
        raise (kind(f"{url}: {cause}") if kind else error) from cause


def folder_at(where) -> LocalFolder | RemoteFolder:
    """The folder at a path or URL."""
    if not is_url(where):
        if FLATTENED_URL.match(str(where)):
            raise ValueError(f"{where}: give a URL as text: as a Path it has lost a slash")
        return LocalFolder(Path(where))
    from fsspec.implementations.local import LocalFileSystem

    filesystem, root = filesystem_of(where)
    if isinstance(filesystem, LocalFileSystem):  # which would leave half a file where it is killed
        return LocalFolder(Path(root))
    return RemoteFolder(where, filesystem, root)


def read_url(url: str) -> bytes:
    """What is behind a URL."""
    filesystem, path = filesystem_of(url)
    with naming(url):
        return filesystem.cat_file(path)
