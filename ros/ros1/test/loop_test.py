# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A bag that is played in a loop with /use_sim_time, and a clock that is set back: each begins
odometry anew, with a line."""

import rospy
from nav_msgs.msg import Odometry

from ros_world import RosWorld, end, wait_until


def test(world):
    bag = world.record(duration=3.0)
    rospy.set_param("/use_sim_time", True)
    rospy.init_node("listener")
    odometry = []
    rospy.Subscriber("nvm/odometry", Odometry, odometry.append)
    node = world.start_node("queue_size:=1000")
    player = world.play(bag, "--loop", "--clock")
    wait_until(lambda: steps_back(odometry) >= 2, "the bag has begun again twice")
    end(player)
    expect_anew(world, odometry)
    count = len(odometry)
    world.play(bag, "--clock", "-s", "0.2")
    wait_until(lambda: len(odometry) >= count + 3, "another player is followed")
    assert node.poll() is None, "the node has ended"


def steps_back(odometry):
    times = [message.header.stamp for message in list(odometry)]
    return sum(b < a for a, b in zip(times, times[1:]))


def expect_anew(world, odometry):
    """After each step back in time the odometry begins at the origin, and says so once."""
    for before, message in zip(odometry, odometry[1:]):
        if message.header.stamp < before.header.stamp:
            position = message.pose.pose.position
            assert abs(position.x) + abs(position.y) + abs(position.z) < 0.05, position
    # The player may have ended between a step back and the next pose.
    wait_until(
        lambda: 0 <= world.output("node").count("begin anew") - steps_back(odometry) <= 1,
        "the node tells of each step back once",
    )


with RosWorld() as ros_world:
    test(ros_world)
