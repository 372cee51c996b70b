# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
import struct
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, FORMATS, IMU, LIVOX, TF, Messages, livox_records, records, typestore, write
from rosbags.rosbag1 import Writer as Writer1

from nvm.bags import BagError, Recording, is_bag
from nvm.choice import choose
from nvm.imu import imu_cdr_to_ros1
from nvm.livox import livox_cdr_to_ros1
from nvm.message_definitions import DEFINITIONS
from nvm.serialization import ros1_typestore, ros2_typestore
from nvm.transforms import quaternion, rotation

HALF = np.sqrt(0.5)


def walk(rng):
    """A maker of a recording of a LiDAR, an IMU and the transform between them."""

    def make(m):
        edges = [("base", "imu", (0, 0, 0.1), (0, 0, 0, 1)), ("base", "lidar", (1, 0, 0.4), (0, 0, HALF, HALF))]
        yield "/tf_static", TF, 100.0, m.transforms(*edges)
        for i in range(5):
            time = 100.0 + 0.1 * i
            yield "/points", CLOUD, time + 0.1, m.cloud(time, records(rng))
            for j in range(10):
                yield "/imu", IMU, time + 0.1, m.imu(time + 0.01 * j, (0.1, i, j), (0, 0, 9.8))

    return make


@pytest.mark.parametrize("form", FORMATS)
def test_every_format_holds_the_same(rng, tmp_path, form):
    path = write(tmp_path / "walk", form, walk(rng))
    assert is_bag(path)
    with Recording(path) as recording:
        assert recording.format == {"bag": "ROS 1 bag", "ros1.mcap": "MCAP"}.get(form, "ROS 2 bag")
        topics = {t.name: t for t in recording.topics()}
        assert {n: t.count for n, t in topics.items()} == {"/points": 5, "/imu": 50, "/tf_static": 1}
        assert topics["/points"].points == 50 and topics["/points"].time_field == "t"
        assert "x:f4" in topics["/points"].fields and topics["/imu"].frame == "imu"
        messages = list(recording.messages(["/points", "/imu"]))
    assert len(messages) == 55
    assert {m.type for m in messages} == {"sensor_msgs/PointCloud2", "sensor_msgs/Imu"}
    store = typestore(ros1=True)
    first = store.deserialize_ros1(messages[0].data, CLOUD)
    assert first.width == 50 and first.header.stamp.sec == 100
    gyros = [
        store.deserialize_ros1(m.data, IMU).angular_velocity for m in messages if m.topic == "/imu"
    ]
    assert [(g.y, g.z) for g in gyros] == [(i, j) for i in range(5) for j in range(10)]


def test_a_part_of_a_bag_stands_for_the_whole(rng, tmp_path):
    folder = write(tmp_path / "walk", "mcap", walk(rng))
    part = next(folder.glob("*.mcap"))
    with Recording(part) as recording:
        assert len(list(recording.messages(["/points"]))) == 5
    alone = tmp_path / "alone" / "x.mcap"
    alone.parent.mkdir()
    part.rename(alone)
    with Recording(alone) as recording:
        assert len(list(recording.messages(["/points"]))) == 5


def test_the_extrinsic_comes_from_tf_static(rng, tmp_path):
    with Recording(write(tmp_path / "walk", "db3", walk(rng))) as recording:
        choice = choose(recording)
    assert (choice.lidar.name, choice.imu.name) == ("/points", "/imu")
    # A point 2 m in front of the LiDAR, which looks along y of base from (1, 0, 0.4).
    p_imu = choice.T_imu_lidar @ [2, 0, 0, 1]
    assert np.allclose(p_imu, [1, 2, 0.3, 1])
    assert np.allclose(choice.extrinsic_numbers(), [1, 0, 0.3, 0, 0, HALF, HALF])
    assert [r.split(":")[0] for r in choice.reasons] == ["lidar", "IMU", "T_imu_lidar"]


def test_the_densest_cloud_with_times_and_the_nearest_imu_are_chosen(rng, tmp_path):
    bare = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4")])

    def make(m):
        edges = [("base", "front", (1, 0, 0), (0, 0, 0, 1)), ("front", "front_imu", (0, 0, 0), (0, 0, 0, 1))]
        yield "/tf_static", TF, 1.0, m.transforms(*edges, ("base", "imu", (0, 0, 0), (0, 0, 0, 1)))
        for i in range(4):
            yield "/depth/points", CLOUD, 1 + i, m.cloud(1 + i, records(rng, 900, bare), "base")
            yield "/a/points", CLOUD, 1 + i, m.cloud(1 + i, records(rng, 20), "base")
            yield "/front/points", CLOUD, 1 + i, m.cloud(1 + i, records(rng, 80), "/front")
            yield "/a/imu", IMU, 1 + i, m.imu(1 + i, (0, 0, 0), (0, 0, 9.8), "imu")
            yield "/front/imu", IMU, 1 + i, m.imu(1 + i, (0, 0, 0), (0, 0, 9.8), "front_imu")

    with Recording(write(tmp_path / "many", "mcap", make)) as recording:
        choice = choose(recording)
        assert (choice.lidar.name, choice.imu.name) == ("/front/points", "/front/imu")
        assert "/depth/points" in choice.reasons[0] and "/a/imu" in choice.reasons[1]
        wanted = choose(recording, lidar="/a/points", imu="/a/imu")
        assert (wanted.lidar.name, wanted.imu.name) == ("/a/points", "/a/imu")
        with pytest.raises(BagError, match="'/b'.*there are: /a/points, /depth/points"):
            choose(recording, lidar="/b")
        with pytest.raises(BagError, match="imu topic '/b'"):
            choose(recording, imu="/b")


def test_unlinked_frames_and_no_imu_are_said(rng, tmp_path):
    def make(m):
        yield "/points", CLOUD, 1.0, m.cloud(1.0, records(rng))
        yield "/imu", IMU, 1.0, m.imu(1.0, (0, 0, 0), (0, 0, 9.8))

    with Recording(write(tmp_path / "bare", "bag", make)) as recording:
        choice = choose(recording)
    assert choice.T_imu_lidar is None and "identity is assumed" in choice.reasons[2]

    def make_alone(m):
        yield "/points", CLOUD, 1.0, m.cloud(1.0, records(rng))

    with Recording(write(tmp_path / "alone", "bag", make_alone)) as recording:
        choice = choose(recording)
    assert choice.imu is None and choice.reasons[-1] == "IMU: none in the recording"


@pytest.mark.parametrize("form", FORMATS)
def test_livox_messages_are_those_of_ros1(rng, tmp_path, form):
    points = livox_records(rng)

    def make(m):
        for i in range(3):
            yield "/livox/lidar", LIVOX, 5.0 + i, m.livox(5.0 + i, points[: 50 - i])

    with Recording(write(tmp_path / "livox", form, make)) as recording:
        assert choose(recording).lidar.time_field == "offset_time"
        messages = list(recording.messages(["/livox/lidar"]))
    store = typestore(ros1=True)
    for i, message in enumerate(messages):
        assert message.type == "livox_ros_driver2/CustomMsg"
        read = store.deserialize_ros1(message.data, LIVOX)
        assert read.header.frame_id == "livox" and read.timebase == (5 + i) * 10**9
        assert len(read.points) == read.point_num == 50 - i
        assert [p.x for p in read.points] == points["x"][: 50 - i].tolist()
        assert [p.line for p in read.points] == points["line"][: 50 - i].tolist()


@pytest.mark.parametrize("frame", ["", "a", "livox", "a frame of any length"])
def test_livox_is_translated_as_rosbags_does(rng, frame):
    store = typestore(ros1=False)
    for count in (0, 1, 7):
        message = Messages(store).livox(3.25, livox_records(rng, count), frame)
        raw = store.serialize_cdr(message, LIVOX)
        assert livox_cdr_to_ros1(raw) == bytes(store.cdr_to_ros1(raw, LIVOX))
        big = store.serialize_cdr(message, LIVOX, little_endian=False)
        assert livox_cdr_to_ros1(big) == livox_cdr_to_ros1(raw)
    for size in (3, 10, 40, len(raw) - 5):
        with pytest.raises((ValueError, IndexError)):
            livox_cdr_to_ros1(bytes(raw)[:size])


@pytest.mark.parametrize("frame", ["", "a", "imu_link", "a frame of any length"])
def test_an_imu_is_translated_as_rosbags_does(rng, frame):
    store = typestore(ros1=False)
    message = Messages(store).imu(3.25, rng.normal(size=3), rng.normal(size=3), frame)
    message.orientation_covariance = rng.normal(size=9)
    message.linear_acceleration_covariance = rng.normal(size=9)
    raw = bytes(store.serialize_cdr(message, IMU))
    assert imu_cdr_to_ros1(raw) == imu_cdr_to_ros1(memoryview(raw)) == bytes(store.cdr_to_ros1(raw, IMU))
    assert imu_cdr_to_ros1(store.serialize_cdr(message, IMU, little_endian=False)) is None
    for size in (4, 10, 40, len(raw) - 1):
        with pytest.raises(ValueError):
            imu_cdr_to_ros1(raw[:size])


def test_rotations_and_quaternions_agree(rng):
    for q in [*rng.normal(size=(50, 4)), [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]:
        q = np.asarray(q) / np.linalg.norm(q)
        R = rotation(*q)
        assert np.allclose(R @ R.T, np.eye(3)) and np.isclose(np.linalg.det(R), 1)
        assert np.isclose(abs(quaternion(R) @ q), 1) and quaternion(R)[3] >= 0


def test_what_is_no_bag_is_said_in_one_line(tmp_path):
    for name in ("empty.bag", "junk.mcap", "junk.db3"):
        path = tmp_path / name
        path.write_bytes(b"" if name == "empty.bag" else struct.pack("<100I", *range(100)))
        with pytest.raises(BagError, match=name) as caught:
            Recording(path)
        assert "\n" not in str(caught.value)
    with pytest.raises(BagError, match="missing.bag: does not exist"):
        Recording(tmp_path / "missing.bag")
    (tmp_path / "folder").mkdir()
    assert not is_bag(tmp_path / "folder")


def test_a_folder_of_both_kinds_of_bags_is_refused(rng, tmp_path):
    make = lambda m: iter([("/imu", IMU, 1.0, m.imu(1.0, (0, 0, 0), (0, 0, 9.81)))])
    write(tmp_path / "old.bag", "bag", make)
    (tmp_path / "new.mcap").write_bytes(b"")
    with pytest.raises(BagError, match="of ROS 1 .old.bag. and of ROS 2: name one"):
        Recording(tmp_path)


def test_info_tells_what_is_there_and_what_would_be_read(rng, tmp_path, capsys):
    from nvm.cli import main

    path = write(tmp_path / "walk", "mcap", walk(rng))
    assert main(["info", str(path)]) == 0
    out = capsys.readouterr().out
    assert f"{path}: ROS 2 bag, 0.5 s from 100.000 s" in out
    assert "/points: 50 points, x:f4 y:f4 z:f4 intensity:f4 t:u4; times in t from 0 to 99000000: ns" in out
    assert "/imu: accelerations of 9.80: m/s^2" in out
    assert "/tf_static: base, imu, lidar" in out
    assert "lidar: /points, the only one with clouds" in out
    assert "'imu' and 'lidar' are 1.000 0.000 0.300 m apart" in out
    assert main(["info", str(tmp_path / "missing.bag")]) == 1
    assert capsys.readouterr().err.startswith("nvm: ")


def test_a_recording_without_clouds_says_what_it_holds(rng, tmp_path, capsys):
    from nvm.cli import main

    def make(m):
        yield "/imu", IMU, 1.0, m.imu(1.0, (0, 0, 0), (0, 0, 0.99))

    assert main(["info", str(write(tmp_path / "imu", "db3", make))]) == 0
    out = capsys.readouterr().out
    assert "accelerations of 0.99: g" in out
    assert "has no clouds" in out and "it holds: sensor_msgs/msg/Imu" in out


@pytest.mark.parametrize("form, is_alone", [("bag", "rosbags.rosbag2"), ("db3", "rosbags.rosbag1")])
def test_no_more_is_imported_than_a_recording_takes(rng, tmp_path, form, is_alone):
    path = write(tmp_path / "walk", form, walk(rng))
    code = f"""import sys
from nvm.program import choose, input_settings, Recording
settings = input_settings("no such program", ["run", "--out", "x"])
print(choose(Recording({str(path)!r}), settings["lidar_topic"]).lidar.name)
print([name for name in ({is_alone!r}, "mcap", "fsspec", "matplotlib", "rosbags.typesys.stores.ros2_foxy") if name in sys.modules])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "/points\n[]\n", done.stderr


def test_definitions_of_other_topics_may_be_unreadable(rng, tmp_path):
    path = tmp_path / "odd.bag"
    store = typestore(ros1=True)
    with Writer1(path) as writer:
        other = writer.add_connection("/other", "my_msgs/msg/Other", msgdef="int32[<=] 3 ]", md5sum="0" * 32)
        writer.write(other, 99 * 10**9, b"??")
        topic = writer.add_connection("/points", CLOUD, typestore=store)
        writer.write(topic, 100 * 10**9, store.serialize_ros1(Messages(store).cloud(100.0, records(rng)), CLOUD))
    with Recording(path) as recording:
        assert choose(recording).lidar.points == 50
        assert [message.topic for message in recording.messages(["/points"])] == ["/points"]


def test_own_definitions_are_those_of_ros(rng):
    for ros1, own in ((True, ros1_typestore()), (False, ros2_typestore())):
        theirs = typestore(ros1)
        for kind in ("std_msgs/msg/Header", *DEFINITIONS):
            assert own.fielddefs[kind][1] == theirs.fielddefs[kind][1]
