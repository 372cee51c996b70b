# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings that are cut off, lack parts, hold other messages or none, and have odd names."""

import dataclasses
import struct

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, POINT, records, typestore, write
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from support import nvm

from nvm.bags import BagError, Recording
from nvm.cli import main


def walk(rng):
    """A maker of five clouds."""
    return lambda m: (("/points", CLOUD, 100 + i, m.cloud(100 + i, records(rng, 500))) for i in range(5))


def test_a_ros2_bag_that_was_cut_off_is_refused_with_what_mends_it(rng, tmp_path):
    for form, mends in (("mcap", "mcap recover"), ("db3", "sqlite3 FILE .recover")):
        file = next(write(tmp_path / form, form, walk(rng)).glob(f"*.{form}"))
        file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
        for path in (file, file.parent):
            with pytest.raises(BagError, match=mends) as caught:
                Recording(path)
            assert "\n" not in str(caught.value)


def test_a_split_bag_that_lacks_a_part_is_refused(rng, tmp_path):
    folder = write(tmp_path / "walk", "mcap", walk(rng))
    metadata = folder / "metadata.yaml"
    name = next(folder.glob("*.mcap")).name
    metadata.write_text(metadata.read_text().replace(f"- {name}", f"- {name}\n  - lost.mcap", 1))
    with pytest.raises(BagError, match="lost.mcap"):
        Recording(folder)


@pytest.mark.parametrize("profile, encoding", [("", "json"), ("ros1", "ros1"), ("ros2", "json")])
def test_mcap_without_messages_of_ros2_is_refused(tmp_path, profile, encoding):
    text = lambda value: struct.pack("<I", len(value)) + value.encode()
    record = lambda kind, body: struct.pack("<BQ", kind, len(body)) + body
    magic = b"\x89MCAP0\r\n"
    schema = struct.pack("<H", 1) + text("Point") + text(f"{encoding}schema") + text("{}")
    channel = struct.pack("<HH", 1, 1) + text("/point") + text(encoding) + text("")
    message = struct.pack("<HIQQ", 1, 0, 1, 1) + b"{}"
    records = [(1, text(profile) + text("me")), (3, schema), (4, channel), (5, message)]
    records += [(15, bytes(4)), (2, bytes(20))]
    file = tmp_path / "other.mcap"
    file.write_bytes(magic + b"".join(record(*r) for r in records) + magic)
    with pytest.raises(BagError, match="of ROS 2"):
        Recording(file)


@pytest.mark.parametrize("form", ["bag", "mcap"])
def test_topics_of_any_name_and_order_of_bytes_run(rng, tmp_path, form):
    """Names that a shell or YAML would take apart, and a cloud in big endian."""

    def make(m):
        for i in range(3):
            cloud = m.cloud(100 + i, records(rng))
            data = np.frombuffer(cloud.data.tobytes(), POINT).astype(POINT.newbyteorder(">"))
            big = dataclasses.replace(cloud, is_bigendian=True, data=np.frombuffer(data.tobytes(), np.uint8))
            yield "/my \"points\" é: [1]", CLOUD, 100 + i, big

    path = write(tmp_path / "odd", form, make)
    with Recording(path) as recording:
        (topic,) = recording.topics()
        assert topic.time_range == (0, 99_000_000)
    done = nvm("run", path, "--out", tmp_path / "out")
    assert 'lidar: /my "points" é: [1], the only one' in done.stderr, done.stderr
    assert '/my "points" é: [1]: point times: field' in done.stderr  # the program has read them
    assert "3 of 3 scans" in done.stderr


@pytest.mark.parametrize("form", ["bag", "db3", "mcap"])
def test_topics_without_messages_are_said(tmp_path, form, capsys):
    store = typestore(form == "bag")
    path = tmp_path / "silent"
    if form == "bag":
        path, writer = path.with_suffix(".bag"), Writer1(path.with_suffix(".bag"))
    else:
        plugin = StoragePlugin.MCAP if form == "mcap" else StoragePlugin.SQLITE3
        writer = Writer2(path, version=9, storage_plugin=plugin)
    with writer:
        writer.add_connection("/points", CLOUD, typestore=store)
    assert main(["info", str(path)]) == 0
    assert "/points: no messages" in capsys.readouterr().out
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 1
    assert "/points has no messages" in capsys.readouterr().err
