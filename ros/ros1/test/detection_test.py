# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Which topics are read: found by type, no IMU, a topic of another type; extrinsic and base from
TF; and scans that come faster than they can be worked on."""

import rospy
import rosbag
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, PointCloud2
import tf2_ros

from ros_world import RosWorld, end, expect_same, row, wait_until


def transform(parent, child, x, qw=1.0, qz=0.0):
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.x = x
    message.transform.rotation.w, message.transform.rotation.z = qw, qz
    return message


class Listener:
    def __init__(self):
        self.odometry, self.states = [], []
        rospy.Subscriber("nvm/odometry", Odometry, self.odometry.append)
        rospy.Subscriber("nvm/status", DiagnosticArray, self.states.append)

    def values(self):
        return {e.key: e.value for e in self.states[-1].status[0].values} if self.states else {}

    def message(self):
        return self.states[-1].status[0].message if self.states else ""

    def clear(self):
        self.odometry.clear()
        self.states.clear()


def without_imu(world, listener, bag):
    """Clouds only: odometry from scans alone, once no IMU has come for detection_time."""
    listener.clear()
    clouds = [message for _, message, _ in rosbag.Bag(bag).read_messages("/lidar")]
    publisher = rospy.Publisher("/scans", PointCloud2, queue_size=100)
    node = world.start_node("detection_time:=0.5", name="without")
    wait_until(lambda: publisher.get_num_connections() > 0, "the node listens")
    for cloud in clouds[:12]:
        publisher.publish(cloud)
    wait_until(lambda: len(listener.odometry) >= 4, "scans alone give poses")
    assert listener.odometry[0].child_frame_id == "lidar"
    assert "no IMU topic" in world.output("without")
    end(node)
    publisher.unregister()


def two_lidars(world, listener, bag):
    """Clouds of another frame in between are left out and named."""
    listener.clear()
    clouds = [message for _, message, _ in rosbag.Bag(bag).read_messages("/lidar")][:15]
    publisher = rospy.Publisher("/scans", PointCloud2, queue_size=100)
    node = world.start_node("detection_time:=0.5", "queue_size:=1000", name="two")
    wait_until(lambda: publisher.get_num_connections() > 0, "the node listens")
    for cloud in clouds:
        frame = cloud.header.frame_id
        publisher.publish(cloud)
        cloud.header.frame_id = "another_lidar"
        publisher.publish(cloud)
        cloud.header.frame_id = frame
    wait_until(lambda: len(listener.odometry) >= 12, "one of them gives poses")
    wait_until(lambda: "two LiDARs on one topic" in world.output("two"), "the other one is named")
    assert len(listener.odometry) <= len(clouds), len(listener.odometry)
    end(node)
    publisher.unregister()


def of_another_type(world, listener):
    listener.clear()
    publisher = rospy.Publisher("/wrong", Imu, queue_size=10)
    node = world.start_node("lidar_topic:=/wrong", "imu_topic:=none", name="wrong")
    wait_until(lambda: publisher.get_num_connections() > 0, "the node listens")
    publisher.publish(Imu())
    wait_until(lambda: "sensor_msgs/Imu" in listener.message(), "the type is refused")
    assert listener.states[-1].status[0].level == 2
    end(node)
    publisher.unregister()


def with_tf(world, listener, bag):
    """The IMU hangs, turned by 90 degrees, in a robot whose root is base_link."""
    listener.clear()
    half = 0.5**0.5
    broadcaster = tf2_ros.StaticTransformBroadcaster()
    broadcaster.sendTransform(
        [transform("base_link", "imu", 0.5, half, half), transform("imu", "lidar", 0.0)]
    )
    reference = world.reference(bag)
    node = world.start_node("queue_size:=1000", "tf_timeout:=20", name="tf")
    world.play(bag, "-r", "2")
    wait_until(lambda: len(listener.odometry) == len(reference), "all poses have come")
    last = listener.odometry[-1]
    assert last.child_frame_id == "base_link", last.child_frame_id
    # T_imu_base = (base <- imu)^-1: 0.5 m along the IMU's y axis, turned by -90 degrees.
    ours, theirs = row(last), reference[-1]
    distance = sum((a - b) ** 2 for a, b in zip(ours[1:4], theirs[1:4])) ** 0.5
    assert abs(distance - 0.5) < 1e-6, distance
    assert "TF has no" not in world.output("tf")
    end(node)


def too_fast(world, listener, bag):
    """Scans are dropped, and said to be, when more come than the queue holds."""
    listener.clear()
    node = world.start_node("queue_size:=1", "lidar_topic:=/lidar", "imu_topic:=/imu", name="fast")
    world.play(bag, "-r", "60")
    wait_until(lambda: int(listener.values().get("scans dropped", 0)) > 3, "scans are dropped")
    wait_until(lambda: "cannot keep up" in world.output("fast"), "the node says so")
    assert node.poll() is None
    end(node)


def test(world):
    bag = world.record(duration=3.0)
    rospy.init_node("listener")
    listener = Listener()
    of_another_type(world, listener)
    without_imu(world, listener, bag)
    two_lidars(world, listener, bag)
    too_fast(world, listener, bag)
    with_tf(world, listener, bag)


with RosWorld() as ros_world:
    test(ros_world)
