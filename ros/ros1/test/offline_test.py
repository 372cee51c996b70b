# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Offline mode on bags with PointCloud2 and with the CustomMsg of both Livox drivers: the poses of
`nvm run`, though the queue is short and nothing waits for anything."""

import rospy
from nav_msgs.msg import Odometry

from ros_world import RosWorld, expect_same, row, wait_until


def expect_poses(world, odometry, bag):
    odometry.clear()
    reference = world.reference(bag)
    name = f"offline_{bag.stem}"
    node = world.start_node("mode:=offline", f"bag:={bag}", name=name)
    assert node.wait(timeout=240) == 0, world.output(name)
    wait_until(lambda: len(odometry) >= len(reference), "all poses have come", 20)
    expect_same([row(message) for message in odometry], reference)


def test(world):
    rospy.init_node("listener")
    odometry = []
    rospy.Subscriber("nvm/odometry", Odometry, odometry.append)
    for cloud_type in ("cloud", "livox", "livox2"):
        expect_poses(world, odometry, world.record(cloud_type, duration=3.0))
    expect_refusals(world)


def expect_refusals(world):
    for parameter, line in (
        ("bag:=", "needs the parameter bag"),
        (f"bag:={world.folder}/none.bag", "none.bag"),
        ("bagg:=x", "bagg"),
    ):
        node = world.start_node("mode:=offline", parameter, name="refused")
        assert node.wait(timeout=120) == 1
        assert line in world.output("refused"), world.output("refused")


with RosWorld() as ros_world:
    test(ros_world)
