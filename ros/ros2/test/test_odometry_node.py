# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The node beside a publisher of simulated scans and readings.

Needs $NVM_SEQUENCE, a folder of `nvm simulate`, and the packages of requirements.txt."""

import copy
import csv
import dataclasses
import os
import pathlib
import threading
import time

import numpy as np
import nvm
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from nvm_ros.clouds import cloud_message, raw_cloud
from nvm_ros.finding_watch import FindingWatch
from nvm_ros.messages import stamp_of
from nvm_ros.odometry_node import HAVE_POSE, LEARNING, OdometryNode
from nvm_ros.options import Options, split
from nvm_ros.sensor_queue import SensorQueue
from nvm_ros.topics import choose, message_class
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Imu, PointCloud2
from std_srvs.srv import Trigger

SEQUENCE = pathlib.Path(os.environ.get("NVM_SEQUENCE", ""))
RECORD = np.dtype([("xyz", "<f4", 3), ("intensity", "<f4"), ("dt", "<f4"), ("ring", "<u2"), ("_", "<u2")])
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LATER = 1000.0  # [s]; time 0 has a meaning of its own in ROS
needs_sequence = pytest.mark.skipif(not (SEQUENCE / "scans.csv").is_file(), reason="no $NVM_SEQUENCE")


def column(cloud, name):
    offset = next(field.offset for field in cloud.fields if field.name == name)
    return np.ndarray(cloud.width, "<f4", bytes(cloud.data), offset, (cloud.point_step,))


def recording():
    """Messages in order of time: (time [s], message)."""
    messages = []
    for row in csv.DictReader(open(SEQUENCE / "imu.csv")):
        imu = Imu()
        imu.header.frame_id, imu.header.stamp = "imu", stamp_of(float(row["t"]) + LATER)
        w, a = imu.angular_velocity, imu.linear_acceleration
        w.x, w.y, w.z = (float(row[key]) for key in ("gx", "gy", "gz"))
        a.x, a.y, a.z = (float(row[key]) for key in ("ax", "ay", "az"))
        messages.append((float(row["t"]), imu))
    for row in csv.DictReader(open(SEQUENCE / "scans.csv")):
        points = np.fromfile(SEQUENCE / row["file"], RECORD)
        columns = {name: points["xyz"][:, i] for i, name in enumerate("xyz")}
        columns |= {"intensity": points["intensity"], "time": points["dt"]}
        cloud = cloud_message(stamp_of(float(row["t_begin"]) + LATER), "lidar", columns)
        messages.append((float(row["t_end"]), cloud))
    return sorted(messages, key=lambda item: (item[0], isinstance(item[1], PointCloud2)))


def raw(cloud):
    """As a subscription gets it."""
    return raw_cloud(serialize_message(cloud), "sensor_msgs/msg/PointCloud2", 0.0)


def offline(messages):
    """What nvm.Odometry makes of them: readings up to each scan's last point, as nvm run has it."""
    odometry, stream, poses, waiting = nvm.Odometry(), nvm.ScanStream(), [], []
    clouds = [raw(message).ros1() for _, message in messages if isinstance(message, PointCloud2)]
    assert stream.learn(clouds[:LEARNING]) == LEARNING
    for _, message in messages:
        if isinstance(message, Imu):
            w, a = message.angular_velocity, message.linear_acceleration
            stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
            waiting.append((stamp, (w.x, w.y, w.z), (a.x, a.y, a.z)))
            continue
        scan = stream.convert(clouds.pop(0))
        while waiting and waiting[0][0] <= odometry.imu_needed_until(scan.end):
            odometry.add_imu(*waiting.pop(0))
        frame = odometry.register(scan)
        if frame.status in HAVE_POSE:
            poses.append(frame.T_map_body[:3, 3])
    return np.array(poses)


class Bench(Node):
    def __init__(self):
        super().__init__("bench")
        self.clouds = self.create_publisher(PointCloud2, "points", 100)
        self.imu = self.create_publisher(Imu, "imu", 2000)
        self.odometry, self.states, self.maps, self.frames = [], [], [], []
        self.create_subscription(Odometry, "nvm/odometry", self.odometry.append, 1000)
        self.create_subscription(DiagnosticArray, "nvm/status", self.states.append, 10)
        self.create_subscription(PointCloud2, "nvm/map", self.maps.append, LATCHED)
        self.create_subscription(PointCloud2, "nvm/frame", self.frames.append, 100)
        self.save = self.create_client(Trigger, "nvm/save")
        self.reset = self.create_client(Trigger, "nvm/reset")

    def publish(self, messages, pause=0.0):
        for _, message in messages:
            is_cloud = isinstance(message, PointCloud2)
            (self.clouds if is_cloud else self.imu).publish(message)
            time.sleep(pause if is_cloud else 0.0)


@pytest.fixture
def world():
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    nodes = []

    def start(**parameters):
        nodes.append(
            OdometryNode(parameter_overrides=[Parameter(n, value=v) for n, v in parameters.items()])
        )
        executor.add_node(nodes[-1])
        return nodes[-1]

    bench = Bench()
    executor.add_node(bench)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    yield bench, start
    executor.shutdown()
    for node in [*nodes, bench]:
        node.destroy_node()
    rclpy.try_shutdown()


def wait_until(condition, timeout=120.0):
    deadline = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.05)


def called(client):
    """The answer of a service."""
    wait_until(client.service_is_ready)
    future = client.call_async(Trigger.Request())
    wait_until(future.done)
    return future.result()


@needs_sequence
def test_gives_the_poses_of_nvm_odometry(world, tmp_path):
    bench, start = world
    start(queue_size=1000, imu_timeout=20.0, map_period=0.2, save_folder=str(tmp_path))
    messages = recording()
    expected = offline(messages)
    wait_until(lambda: bench.clouds.get_subscription_count() and bench.imu.get_subscription_count())
    bench.publish(messages, pause=0.1)
    wait_until(lambda: len(bench.odometry) >= len(expected))
    got = [(m.pose.pose.position.x, m.pose.pose.position.y, m.pose.pose.position.z) for m in bench.odometry]
    np.testing.assert_array_equal(np.array(got), expected)
    assert bench.odometry[-1].header.frame_id == "odom"
    assert bench.odometry[-1].child_frame_id == "imu"
    assert 0 < bench.odometry[-1].pose.covariance[0] < 1e-2
    wait_until(lambda: bench.maps and len(bench.frames) >= 5)
    assert [f.name for f in bench.maps[-1].fields][-2:] == ["intensity", "side"]
    for cloud in (bench.maps[-1], bench.frames[-1]):
        intensities = column(cloud, "intensity")
        assert 0 <= intensities.min() < 50 < intensities.max() <= 255
    sides = np.frombuffer(bench.maps[-1].data, np.uint8).reshape(-1, bench.maps[-1].point_step)[:, -1]
    assert set(sides) == {0, 1}
    assert bench.frames[-1].header.frame_id == "imu" and bench.frames[-1].width > 1000
    wait_until(lambda: any("TF has no transform" in s.status[0].message for s in bench.states))
    answer = called(bench.save)
    assert answer.success, answer.message
    rows = np.loadtxt(tmp_path / "trajectory.tum")
    np.testing.assert_allclose(rows[:, 1:4], expected, atol=1e-9)
    assert len(nvm.load(tmp_path / "map.nvm")) > 1000
    assert called(bench.reset).success and not called(bench.save).success


@needs_sequence
def test_begins_anew_when_time_goes_back(world):
    bench, start = world
    node = start(queue_size=1000, imu_timeout=20.0)
    messages = recording()
    wait_until(lambda: bench.clouds.get_subscription_count() and bench.imu.get_subscription_count())
    bench.publish(messages, pause=0.05)
    wait_until(lambda: bench.odometry)
    bench.publish(messages, pause=0.05)
    wait_until(lambda: node._counts["resets"] == 1)


def test_refuses_unknown_parameters():
    rclpy.init()
    try:
        for name, value in (("map.voxel_siz", 0.2), ("input.point_time_units", "s"), ("input.accel_unit", "feet")):
            with pytest.raises(ValueError, match=name.split(".")[1]):
                OdometryNode(parameter_overrides=[Parameter(name, value=value)])
    finally:
        rclpy.try_shutdown()


def test_parts_own_parameters_from_those_of_the_odometry():
    options, config = split({"queue_size": 3, "map.voxel_size": 0.2, "use_sim_time": True})
    assert options.queue_size == 3 and config == {"map": {"voxel_size": 0.2}}
    with pytest.raises(ValueError, match="queue_size"):
        split({"queue_size": "many"})


def test_topics_are_the_first_of_their_types_unless_named():
    clouds, imus = ["sensor_msgs/msg/PointCloud2"], ["sensor_msgs/msg/Imu"]
    there = [("/b", clouds), ("/nvm/map", clouds), ("/imu", imus), ("/a", clouds), ("/text", ["std_msgs/msg/String"])]
    found = choose(there, Options(), True, ("/nvm/map",))
    assert (found.lidar, found.imu) == ("/a", "/imu") and "/a, /b" in found.notes[0]
    found = choose(there, Options(lidar_topic="/b"), False, ("/nvm/map",))
    assert (found.lidar, found.imu, found.notes) == ("/b", "", [])
    assert choose([], Options(), True, ()).lidar == ""


def test_livox_clouds_are_found_and_need_their_package():
    custom = "livox_ros_driver2/msg/CustomMsg"
    there = [("/livox/lidar", [custom]), ("/livox/imu", ["sensor_msgs/msg/Imu"])]
    found = choose(there, Options(), True, ())
    assert (found.lidar, found.lidar_type, found.imu) == ("/livox/lidar", custom, "/livox/imu")
    assert message_class("sensor_msgs/msg/PointCloud2") is PointCloud2
    with pytest.raises(ValueError, match="workspace that has livox_ros_driver2"):
        message_class(custom)


@pytest.mark.parametrize("size", [*range(0, 40, 7), -1])
def test_a_truncated_cloud_is_an_error(size):
    columns = {name: np.zeros(5, "f4") for name in "xyz"}
    cdr = serialize_message(cloud_message(stamp_of(1.5), "/lidar", columns))
    whole = raw_cloud(cdr, "sensor_msgs/msg/PointCloud2", 0.0)
    assert (whole.stamp, whole.frame) == (1.5, "lidar")
    with pytest.raises((ValueError, RuntimeError)):
        nvm.ScanStream().convert(dataclasses.replace(whole, cdr=cdr[:size]).ros1())


@needs_sequence
def test_keeps_to_one_of_two_lidars(world):
    bench, start = world
    node = start(queue_size=1000, imu_timeout=20.0)
    messages = recording()
    expected = offline(messages)
    wait_until(lambda: bench.clouds.get_subscription_count() and bench.imu.get_subscription_count())
    for item in messages:
        bench.publish([item], pause=0.05)
        if isinstance(item[1], PointCloud2):
            other = copy.deepcopy(item[1])
            other.header.frame_id = "rear"
            bench.publish([(item[0], other)], pause=0.05)
    wait_until(lambda: len(bench.odometry) >= len(expected))
    got = [(m.pose.pose.position.x, m.pose.pose.position.y, m.pose.pose.position.z) for m in bench.odometry]
    np.testing.assert_array_equal(np.array(got), expected)
    wait_until(lambda: "two LiDARs on one topic" in node._bad or any("two LiDARs" in s.status[0].message for s in bench.states))


def test_findings_are_said_once_whatever_their_numbers():
    watch = FindingWatch()
    assert watch.new_ones(0.0, ["the clock is 12 ms late"]) == []
    assert watch.new_ones(5.0, ["the clock is 9.5 ms late", "a"]) == ["the clock is 9.5 ms late"]
    assert watch.new_ones(8.0, ["the clock is 3 ms late"]) == []
    assert watch.new_ones(20.0, ["a"]) == [], "what did not last is not said"


@needs_sequence
def test_tells_what_is_wrong_with_the_imu(world):
    bench, start = world
    start(queue_size=1000, imu_timeout=20.0)
    messages = recording()
    for _, message in messages:
        if isinstance(message, Imu):
            a = message.linear_acceleration
            a.x, a.y, a.z = a.x * 0.3, a.y * 0.3, a.z * 0.3
    wait_until(lambda: bench.clouds.get_subscription_count() and bench.imu.get_subscription_count())
    bench.publish(messages, pause=0.05)
    said = "accelerometer feels"
    wait_until(lambda: any(said in v.value for s in bench.states for v in s.status[0].values))


def test_the_queue_drops_the_oldest_and_begins_anew():
    queue = SensorQueue(2, has_imu=False)
    for stamp in (1.0, 1.1, 1.2):
        queue.add_cloud(stamp, stamp)
    assert queue.counts["dropped"] == 1
    assert queue.next_cloud() == (0, 1.1)
    queue.add_cloud(-5.0, "again")
    assert queue.next_cloud() == (1, "again")
