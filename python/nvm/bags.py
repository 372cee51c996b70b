# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings of ROS 1 and ROS 2: what they hold, and their messages one after the other.

Read by the package rosbags: ``.bag`` files, folders of ROS 2 bags (``.db3``, ``.mcap``, compressed,
split) and single files of them; MCAP with messages of ROS 1, or of other kinds beside those of ROS, by the package
mcap. Messages come as ROS 1 serialises them, whatever the bag.
"""

from __future__ import annotations

import contextlib
import dataclasses
import heapq
import itertools
import pathlib
import re
from collections.abc import Iterator

from .livox import is_livox
from .mcap_file import McapFile
from .message_definitions import TRANSFORMS
from .serialization import ros1_of, ros1_typestore, ros2_typestore
from .topics import ROS, Topic, described
from .transforms import TransformTree

ROS2 = (".db3", ".mcap")
SCANS = (".pcd", ".ply", ".bin")
HINTS = {  # of what rosbags says
    "disk image is malformed": "it was cut off or damaged, of which `sqlite3 FILE .recover` saves what there is",
}
FOR_MCAP = ("Profile is not ros2", "File end magic is invalid", "Invalid MCAP footer")  # so rosbags refuses
ZSTD = b"\x28\xb5\x2f\xfd"  # begins what it has compressed, and no message of ROS 2
SAMPLES = 10  # messages of a topic that are looked at


class BagError(RuntimeError):
    """What is wrong with a recording, in one line."""


@dataclasses.dataclass(frozen=True)
class Message:
    topic: str
    type: str  # as ROS 1 writes it: sensor_msgs/Imu
    record_time: float  # [s]
    data: bytes | memoryview  # as ROS 1 serialises it


def is_bag(path: str | pathlib.Path) -> bool:
    """Whether `path` is a recording of ROS 1 or ROS 2."""
    return bool(bags_of(pathlib.Path(path)))


def bags_of(path: pathlib.Path) -> list[pathlib.Path]:
    """What rosbags is to open for `path`: a folder may hold the parts of a recording alone, as the
    program has it (src/io/open_sequence.cpp)."""
    if not path.is_dir():
        return [path] if path.suffix in (".bag", ".zstd", *ROS2) else []
    metadata = path / "metadata.yaml"
    if metadata.is_file() and b"rosbag2_bagfile_information" in metadata.read_bytes():
        return [path]
    files = sorted(file for file in path.iterdir() if file.is_file())
    if any(file.name == "scans.csv" for file in files):
        return []
    ros2 = [file for file in files if file.suffix in ROS2]
    if ros2 and not any(file.suffix.lower() in SCANS for file in files):
        return ros2
    return [file for file in files if file.suffix == ".bag"]


def is_ros1(path: str | pathlib.Path) -> bool:
    """Whether `path` is there and names bags of ROS 1 alone."""
    path = pathlib.Path(path)
    return path.exists() and is_bag(path) and all(bag.suffix == ".bag" for bag in bags_of(path))


class Recording:
    """A recording of ROS 1 or ROS 2.

    Parameters
    ----------
    path : path
        A ``.bag``, ``.mcap`` or ``.db3`` file, or a folder of them; a file of a split ROS 2 bag stands
        for the whole. An MCAP file that was cut off is read as far as it goes.

    Raises
    ------
    BagError
        When it cannot be read, or rosbags is not installed.
    """

    transforms_from = "/tf_static"

    def __init__(self, path: str | pathlib.Path):
        self.path = pathlib.Path(path)
        if not self.path.exists():
            raise BagError(f"{path}: does not exist")
        others = list(self.path.glob("*.bag")) if self.path.is_dir() else []
        if others and bags_of(self.path)[0].suffix in ROS2:
            raise BagError(f"{path}: holds bags of ROS 1 ({others[0].name}) and of ROS 2: name one of them")
        folder = self.path.parent
        is_part = self.path.suffix != ".bag" and self.path.is_file() and bags_of(folder) == [folder]
        bags = [folder] if is_part else bags_of(self.path) or [self.path]
        refuse_unfinished(bags)
        try:
            with contextlib.ExitStack() as opened:
                self._readers = open_all(bags, opened)
                self._opened = opened.pop_all()
        except ImportError as error:
            raise BagError(f"{path}: bags are read by rosbags and mcap: pip install rosbags mcap") from error
        except Exception as error:  # rosbags lets what yaml, sqlite and mcap find wrong pass
            hints = (f": {hint}" for problem, hint in HINTS.items() if problem in str(error))
            raise BagError(f"{path}: is no readable bag: {str(error).rstrip('.')}" + next(hints, "")) from error

    def __enter__(self) -> Recording:
        return self

    def __exit__(self, *_) -> None:
        self._opened.close()

    @property
    def format(self) -> str:
        if self._mcap_files:
            return "MCAP"
        return "ROS 1 bag" if all(encoding_of(c) == "ros1" for c in self._connections) else "ROS 2 bag"

    @property
    def problems(self) -> list[str]:
        """What is wrong with it, but does not keep it from being read; a line each."""
        cut_off = (file for file in self._mcap_files if file.is_cut_off)
        return [f"{file.path}: was cut off, and is read as far as it goes" for file in cut_off]

    @property
    def begin(self) -> float:
        """Time of recording of the first message [s]."""
        return min(reader.start_time for reader in self._readers) * 1e-9

    @property
    def duration(self) -> float:
        """[s]"""
        used = [reader for reader in self._readers if reader.message_count]
        return max(reader.end_time for reader in used) * 1e-9 - self.begin if used else 0.0

    @property
    def _mcap_files(self) -> list[McapFile]:
        return [reader for reader in self._readers if isinstance(reader, McapFile)]

    @property
    def _connections(self) -> list:
        return [connection for reader in self._readers for connection in reader.connections]

    def topics(self) -> list[Topic]:
        """All topics, in the order of their names."""
        found: dict[tuple[str, str, str], int] = {}
        for connection in self._connections:
            key = (connection.topic, connection.msgtype, encoding_of(connection))
            found[key] = found.get(key, 0) + connection.msgcount
        return [self._topic(*key, count) for key, count in sorted(found.items())]

    def transforms(self) -> TransformTree:
        """The static transforms, from /tf_static."""
        tree = TransformTree()
        for message in self._deserialized(lambda c: c.msgtype == TRANSFORMS and c.topic.endswith("tf_static")):
            for transform in message.transforms:
                tree.add(transform)
        return tree

    def messages(self, topics: list[str]) -> Iterator[Message]:
        """The messages of the topics in the order of recording; one that is damaged is empty. BagError when the file
        is."""
        for connection, time, raw in self._messages(lambda c: c.topic in topics):
            seconds, nanoseconds = divmod(time, 10**9)
            yield Message(
                connection.topic,
                connection.msgtype.replace("/msg/", "/"),
                seconds + 1e-9 * nanoseconds,  # the bits that ROS makes of it
                as_ros1(raw, connection),
            )

    def _messages(self, accepts):
        parts = []
        for reader in self._readers:
            connections = [c for c in reader.connections if encoding_of(c) in ROS and accepts(c)]
            if connections:  # without any, rosbags reads all
                parts.append(reader.messages(connections=connections))
        try:
            for connection, time, raw in heapq.merge(*parts, key=lambda found: found[1]):
                yield connection, time, unpacked(raw) if raw[:4] == ZSTD and encoding_of(connection) == "cdr" else raw
        except Exception as error:  # each library has its own
            raise BagError(f"{self.path}: is damaged: {error}") from error

    def _deserialized(self, accepts):
        """Messages that are not damaged."""
        for connection, _, raw in self._messages(accepts):
            with contextlib.suppress(Exception):
                yield deserialized(raw, connection)

    def _topic(self, name: str, kind: str, encoding: str, count: int) -> Topic:
        rate = (count - 1) / self.duration if count > 1 and self.duration > 0 else 0.0
        topic = Topic(name, kind, count, rate, encoding=encoding)
        if not (topic.is_cloud or topic.is_imu):
            return topic
        found = self._deserialized(lambda c: (c.topic, c.msgtype, encoding_of(c)) == (name, kind, encoding))
        samples = list(itertools.islice(found, SAMPLES))
        return dataclasses.replace(topic, **described(samples, is_livox(kind))) if samples else topic


def refuse_unfinished(bags: list[pathlib.Path]) -> None:
    """BagError when SQLite has messages beside a bag, which rosbags would not see."""
    for file in (file for bag in bags for file in (sorted(bag.glob("*.db3")) if bag.is_dir() else [bag])):
        for beside in (file.with_name(file.name + end) for end in ("-wal", "-journal")):
            if beside.exists() and beside.stat().st_size:
                raise BagError(
                    f"{beside}: has what was not put into {file.name} before its recorder ended: "
                    f"`sqlite3 {file} 'SELECT count(*) FROM messages'` puts it there"
                )


def open_all(bags: list[pathlib.Path], opened: contextlib.ExitStack) -> list:
    """Readers of files, or of the folder of one recording, each with the package that reads it."""
    if all(bag.suffix == ".bag" for bag in bags):
        from rosbags.rosbag1 import Reader
    else:
        from rosbags.rosbag2 import Reader
    try:
        return [opened.enter_context(Reader(bag)) for bag in bags]
    except Exception as error:
        # KeyError and UnicodeDecodeError are of a schema, in MCAP.
        is_known = isinstance(error, (KeyError, UnicodeDecodeError)) or any(text in str(error) for text in FOR_MCAP)
        files = [file for bag in bags for file in parts_of(bag)]
        if not is_known or any(file.suffix != ".mcap" for file in files):
            raise
        return [McapFile(file) for file in files]


def parts_of(bag: pathlib.Path) -> list[pathlib.Path]:
    """The MCAP files of a ROS 2 bag that may be read alone; the bag itself where its metadata say how they are packed."""
    if bag.is_file() or re.search(r"compression_mode:\W*(message|file)", (bag / "metadata.yaml").read_text(), re.I):
        return [bag]
    return sorted(bag.glob("*.mcap"))


def encoding_of(connection) -> str:
    """How the messages of a connection are serialised."""
    if hasattr(connection, "encoding"):
        return connection.encoding
    return getattr(connection.ext, "serialization_format", "ros1")


def unpacked(raw) -> bytes:
    """A message of a bag whose metadata, which say that messages are compressed, are lost."""
    from zstandard import ZstdDecompressor

    return ZstdDecompressor().decompressobj().decompress(raw)


def as_ros1(raw, connection) -> bytes | memoryview:
    """A message as ROS 1 serialises it; nothing of one that is damaged, which whoever reads it then counts."""
    if encoding_of(connection) == "ros1":
        return raw
    try:
        return ros1_of(raw, connection.msgtype)
    except Exception:
        return b""


def deserialized(raw, connection):
    if encoding_of(connection) == "ros1":
        return ros1_typestore().deserialize_ros1(raw, connection.msgtype)
    return ros2_typestore().deserialize_cdr(raw, connection.msgtype)
