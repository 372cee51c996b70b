# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""MCAP files that rosbags refuses: with messages of ROS 1, with channels of other kinds among them, or cut off.

Read by the package mcap, as far as a file goes.
"""

from __future__ import annotations

import dataclasses
import pathlib
from collections.abc import Iterator


@dataclasses.dataclass(frozen=True)
class Channel:
    """What rosbags calls a connection."""

    topic: str
    msgtype: str  # as ROS 2 writes it: sensor_msgs/msg/Imu
    msgcount: int
    encoding: str  # of its messages: ros1, cdr, json, protobuf, ...
    id: int


class McapFile:
    """One file, with what rosbags' readers have of others. Raises McapError when it is none, or damaged."""

    def __init__(self, path: pathlib.Path):
        self.path = path
        self.is_cut_off = False
        self.connections: list[Channel] = []
        self.start_time, self.end_time = 2**63 - 1, 0  # [ns]
        self._is_indexed = self._read_summary()
        if not self._is_indexed:
            self._read_all()

    @property
    def message_count(self) -> int:
        return sum(channel.msgcount for channel in self.connections)

    def messages(self, connections: list[Channel]) -> Iterator[tuple[Channel, int, bytes]]:
        """Channel, time of recording [ns] and bytes; in that order as far as the file has an index."""
        wanted = {channel.id: channel for channel in connections}
        for _, channel, message in self._records({channel.topic for channel in connections}):
            if channel.id in wanted:
                yield wanted[channel.id], message.log_time, message.data

    def _records(self, topics=None):
        from mcap.exceptions import EndOfFile
        from mcap.reader import NonSeekingReader, SeekingReader

        with self.path.open("rb") as stream:
            if self._is_indexed:
                yield from SeekingReader(stream, validate_crcs=True).iter_messages(topics)
                return
            try:
                yield from NonSeekingReader(stream, validate_crcs=True).iter_messages(topics, log_time_order=False)
            except EndOfFile:
                self.is_cut_off = True

    def _read_summary(self) -> bool:
        """Takes what is known of the file from its end; whether all of it is there."""
        from mcap.exceptions import McapError
        from mcap.reader import SeekingReader

        with self.path.open("rb") as stream:
            reader = SeekingReader(stream)
            try:
                summary = reader.get_summary()
            except (McapError, OSError, ValueError):
                return False  # it was cut off
        if summary is None or summary.statistics is None or not summary.chunk_indexes:
            return False
        counts = summary.statistics.channel_message_counts
        has_all = counts.keys() <= summary.channels.keys()
        schemas = {channel.schema_id for channel in summary.channels.values()} - {0}
        if not has_all or not schemas <= summary.schemas.keys():
            return False
        for channel in summary.channels.values():
            self._add(channel, summary.schemas.get(channel.schema_id), counts.get(channel.id, 0))
        if summary.statistics.message_count:
            self.start_time = summary.statistics.message_start_time
            self.end_time = summary.statistics.message_end_time
        return True

    def _read_all(self) -> None:
        found: dict[int, list] = {}
        for schema, channel, message in self._records():
            found.setdefault(channel.id, [channel, schema, 0])[2] += 1
            self.start_time = min(self.start_time, message.log_time)
            self.end_time = max(self.end_time, message.log_time)
        for each in found.values():
            self._add(*each)

    def _add(self, channel, schema, count: int) -> None:
        kind = schema.name if schema else ""
        kind = kind.replace("/", "/msg/") if kind.count("/") == 1 else kind
        self.connections.append(Channel(channel.topic, kind, count, channel.message_encoding, channel.id))
