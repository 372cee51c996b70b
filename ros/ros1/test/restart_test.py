# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A node that is killed while a bag is played, and started again: it begins anew and goes on."""

import signal

import rospy
from nav_msgs.msg import Odometry

from ros_world import RosWorld, end, wait_until


def test(world):
    bag = world.record(duration=8.0)
    rospy.init_node("listener")
    odometry = []
    rospy.Subscriber("nvm/odometry", Odometry, odometry.append)
    first = world.start_node("lidar_topic:=/lidar", "imu_topic:=/imu")
    world.play(bag, "-r", "0.3")
    wait_until(lambda: len(odometry) >= 5, "the first node tracks")
    end(first, signal.SIGKILL)
    last = odometry[-1].header.stamp
    world.start_node("lidar_topic:=/lidar", "imu_topic:=/imu", name="again")
    wait_until(lambda: odometry[-1].header.stamp > last, "the second node tracks")


with RosWorld() as ros_world:
    test(ros_world)
