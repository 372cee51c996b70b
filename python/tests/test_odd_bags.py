# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings that are cut off, lack parts, hold other messages or none, and have odd names."""

import dataclasses
import shutil
import sqlite3

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, LIVOX, POINT, Messages, fill, livox_records, records, typestore, write, write_mcap
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from support import nvm

from nvm.bags import BagError, Recording
from nvm.cli import main


def walk(rng, count=5):
    """A maker of clouds."""
    return lambda m: (("/points", CLOUD, 100 + i, m.cloud(100 + i, records(rng, 500))) for i in range(count))


def test_a_ros2_bag_that_was_cut_off_is_refused_with_what_mends_it(rng, tmp_path):
    file = next(write(tmp_path / "walk", "db3", walk(rng)).glob("*.db3"))
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    for path in (file, file.parent):
        with pytest.raises(BagError, match="sqlite3 FILE .recover") as caught:
            Recording(path)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("form", ["mcap", "ros1.mcap"])
@pytest.mark.parametrize("share", [0.5, 0.99])
def test_mcap_that_was_cut_off_is_read_as_far_as_it_goes(rng, tmp_path, form, share, capsys):
    path = write(tmp_path / "walk", form, walk(rng, 400))
    file = path if path.is_file() else next(path.glob("*.mcap"))
    with Recording(path) as recording:
        whole = [message.data for message in recording.messages(["/points"])]
        assert recording.problems == []
    file.write_bytes(file.read_bytes()[: int(share * file.stat().st_size)])
    with Recording(path) as recording:
        (topic,) = recording.topics()
        messages = [message.data for message in recording.messages(["/points"])]
        assert topic.count == len(messages) > (share - 0.35) * len(whole)
        assert messages == whole[: len(messages)]
        assert recording.problems == [f"{file}: was cut off, and is read as far as it goes"]
    assert main(["info", str(path)]) == 0
    assert "was cut off" in capsys.readouterr().out


def test_a_split_bag_that_lacks_a_part_is_refused(rng, tmp_path):
    folder = write(tmp_path / "walk", "mcap", walk(rng))
    metadata = folder / "metadata.yaml"
    name = next(folder.glob("*.mcap")).name
    metadata.write_text(metadata.read_text().replace(f"- {name}", f"- {name}\n  - lost.mcap", 1))
    with pytest.raises(BagError, match="lost.mcap"):
        Recording(folder)


OTHERS = [  # messages of other kinds; a protobuf schema is no text
    ("/poses", "json", ("foxglove.PoseInFrame", "jsonschema", b"{}"), 100.2, b"{}"),
    ("/scan", "protobuf", ("foxglove.PointCloud", "protobuf", b"\x0a\xff\xfe\x80"), 100.3, b"\x0a\x00"),
    ("/cloud", "json", ("sensor_msgs/PointCloud2", "jsonschema", b"{}"), 100.4, b"{}"),
]


@pytest.mark.parametrize("profile", ["", "ros1", "ros2"])
@pytest.mark.parametrize("options", [{}, {"use_chunking": False}, {"repeat_schemas": False}, {"use_statistics": False}])
def test_channels_of_other_kinds_in_mcap_are_left_out_and_named(rng, tmp_path, profile, options, capsys):
    store = typestore(ros1=True)
    clouds = list(walk(rng)(Messages(store)))
    path = write_mcap(tmp_path / "mixed.mcap", store, clouds, OTHERS, profile, **options)
    with Recording(path) as recording:
        assert {t.name: t.count for t in recording.topics()} == {"/points": 5, "/poses": 1, "/scan": 1, "/cloud": 1}
        data = [message.data for message in recording.messages(["/points", "/poses", "/cloud"])]
        assert data == [bytes(store.serialize_ros1(cloud, CLOUD)) for *_, cloud in clouds]
        assert recording.begin == 100 and recording.duration == 4
    assert main(["info", str(path)]) == 0
    out = capsys.readouterr().out
    for line in ("/poses: left out, json is no encoding of ROS", "/scan: left out, protobuf", "/cloud: left out, json"):
        assert line in out
    assert "lidar: /points, the only one" in out


def test_mcap_without_messages_of_ros_says_what_it_holds(tmp_path, capsys):
    path = write_mcap(tmp_path / "other.mcap", None, [], OTHERS, "")
    assert main(["info", str(path)]) == 0
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 1
    error = capsys.readouterr().err
    assert "has no clouds" in error and "foxglove.PointCloud (protobuf)" in error and error.count("\n") == 1


def test_mcap_of_ros1_in_parts_is_one_recording(rng, tmp_path):
    store = typestore(ros1=True)
    clouds = list(walk(rng, 6)(Messages(store)))
    (tmp_path / "parts").mkdir()
    for i in range(2):
        write_mcap(tmp_path / f"parts/{i}.mcap", store, clouds[i::2])
    with Recording(tmp_path / "parts") as recording:
        assert [message.record_time for message in recording.messages(["/points"])] == [100, 101, 102, 103, 104, 105]


def test_a_damaged_chunk_of_mcap_is_said(rng, tmp_path):
    path = write(tmp_path / "walk", "ros1.mcap", walk(rng))
    data = bytearray(path.read_bytes())
    data[len(data) // 3] ^= 255
    path.write_bytes(data)
    done = nvm("run", path, "--out", tmp_path / "out")
    assert done.returncode == 1 and f"{path}: is " in done.stderr and "Traceback" not in done.stderr


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


@pytest.mark.parametrize("form", ["bag", "mcap"])
def test_damaged_messages_are_left_out_and_counted(rng, tmp_path, form):
    store = typestore(form == "bag")
    path = tmp_path / ("walk.bag" if form == "bag" else "walk")
    writer = Writer1(path) if form == "bag" else Writer2(path, version=9, storage_plugin=StoragePlugin.MCAP)
    with writer:
        topic = writer.add_connection("/points", CLOUD, typestore=store)
        for i, (_, kind, time, cloud) in enumerate(walk(rng, 8)(Messages(store))):
            raw = bytes((store.serialize_ros1 if form == "bag" else store.serialize_cdr)(cloud, kind))
            writer.write(topic, round(time * 1e9), raw[:30] if i in (0, 5) else raw)
    assert "/points: 500 points" in nvm("info", path).stdout
    done = nvm("run", path, "--out", tmp_path / "out")
    assert "6 of 6 scans" in done.stderr and "2" in done.stderr and "Traceback" not in done.stderr, done.stderr


def test_messages_that_sqlite_has_beside_a_bag_are_not_lost(rng, tmp_path):
    folder = write(tmp_path / "walk", "db3", walk(rng))
    file = next(folder.glob("*.db3"))
    database = sqlite3.connect(file)
    database.execute("PRAGMA journal_mode=WAL")
    database.execute("INSERT INTO messages(topic_id, timestamp, data) SELECT topic_id, timestamp + 10, data FROM messages")
    database.commit()
    left = shutil.copytree(folder, tmp_path / "left")  # as a recorder that was killed leaves it
    database.close()
    for path in (left, left / file.name):
        with pytest.raises(BagError, match=f"{file.name}-wal: .*SELECT count"):
            Recording(path)
    remedy = sqlite3.connect(left / file.name)
    assert remedy.execute("SELECT count(*) FROM messages").fetchone() == (10,)
    remedy.close()
    with Recording(left / file.name) as recording:
        assert len(list(recording.messages(["/points"]))) == 10


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_compressed_messages_are_read_without_the_metadata(rng, tmp_path, plugin):
    store = typestore(ros1=False)
    writer = Writer2(tmp_path / "walk", version=9, storage_plugin=plugin)
    writer.set_compression(CompressionMode.MESSAGE, CompressionFormat.ZSTD)
    with writer:
        fill(writer, store.serialize_cdr, store, list(walk(rng)(Messages(store))))
    found = []
    for is_whole in (True, False):
        with Recording(tmp_path / "walk") as recording:
            assert recording.topics()[0].points == 500
            found.append([bytes(message.data) for message in recording.messages(["/points"])])
        if is_whole:
            (tmp_path / "walk" / "metadata.yaml").unlink()
    assert found[0] == found[1] and len(found[0]) == 5


def test_a_topic_may_change_its_type(rng, tmp_path):
    store = typestore(ros1=True)
    clouds = [(CLOUD, Messages(store).cloud(100.0 + i, records(rng, 500))) for i in range(3)]
    clouds += [(LIVOX, Messages(store).livox(103.0 + i, livox_records(rng, 500), "lidar")) for i in range(2)]
    path = tmp_path / "walk.bag"
    with Writer1(path) as writer:
        topics = {kind: writer.add_connection("/points", kind, typestore=store) for kind in (CLOUD, LIVOX)}
        for i, (kind, cloud) in enumerate(clouds):
            writer.write(topics[kind], (101 + i) * 10**9, store.serialize_ros1(cloud, kind))
    done = nvm("run", path, "--out", tmp_path / "out")
    assert "5 of 5 scans" in done.stderr and "others:" not in done.stderr, done.stderr
