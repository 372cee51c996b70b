# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The node on a bag that is played, beside a consumer that is slow: the poses of `nvm run`, and all
topics, TF and services."""

import time

from ros_world import RosWorld, expect_same, row, wait_until


def expect_clouds(frame, scans):
    import sensor_msgs.point_cloud2 as clouds

    names = [field.name for field in frame.fields]
    assert names == ["x", "y", "z", "normal_x", "normal_y", "normal_z", "intensity"], names
    assert frame.header.frame_id == "imu"
    normals = list(clouds.read_points(frame, ("normal_x", "normal_y", "normal_z")))
    lengths = [sum(value * value for value in normal) for normal in normals]
    assert all(abs(length - 1) < 1e-4 or length == 0 for length in lengths)
    assert sum(length > 0.5 for length in lengths) > len(lengths) / 2
    points = list(clouds.read_points(scans, ("x", "y", "z", "normal_x", "side")))
    assert {point[4] for point in points} == {0, 1}, "the map has one side only"
    assert len(points) > 10_000, len(points)
    for cloud in (frame, scans):
        intensities = [point[0] for point in clouds.read_points(cloud, ("intensity",))]
        assert 0 <= min(intensities) < 50 < max(intensities) <= 255


def test(world):
    bag = world.record()
    reference = world.reference(bag)
    import rospy
    from diagnostic_msgs.msg import DiagnosticArray
    from nav_msgs.msg import Odometry, Path
    from sensor_msgs.msg import PointCloud2
    from std_srvs.srv import Trigger
    from tf2_msgs.msg import TFMessage

    rospy.init_node("listener")
    odometry, transforms, paths, frames, maps, states = [], [], [], [], [], []
    rospy.Subscriber("nvm/odometry", Odometry, odometry.append)
    rospy.Subscriber("/tf", TFMessage, transforms.append)
    rospy.Subscriber("nvm/path", Path, paths.append)
    rospy.Subscriber("nvm/frame", PointCloud2, frames.append)
    rospy.Subscriber("nvm/status", DiagnosticArray, states.append)
    rospy.Subscriber("nvm/frame", PointCloud2, lambda message: time.sleep(1.0))
    rospy.Subscriber("nvm/map", PointCloud2, maps.append)
    save_folder = world.folder / "saved"
    world.start_node("queue_size:=1000", f"save_folder:={save_folder}", "map_period:=0.2")
    world.play(bag, "-r", "2")
    wait_until(lambda: len(odometry) == len(reference), f"there are {len(reference)} poses")

    expect_same([row(message) for message in odometry], reference)
    covariance = odometry[-1].pose.covariance
    assert all(0 < covariance[7 * i] < 1e-2 for i in range(6)), covariance
    assert odometry[-1].header.frame_id == "odom" and odometry[-1].child_frame_id == "imu"
    wait_until(lambda: len(transforms) == len(reference), "TF is as long as odometry")
    last = transforms[-1].transforms[0]
    assert (last.header.frame_id, last.child_frame_id) == ("odom", "imu")
    assert last.transform.translation.x == odometry[-1].pose.pose.position.x
    wait_until(lambda: maps and paths and frames, "there are map, path and scan")
    expect_clouds(frames[-1], maps[-1])
    wait_until(lambda: any(values_of(s).get("scans with a pose") == str(len(reference)) for s in states), "the status counts all")
    values = values_of(states[-1])
    assert values["scans dropped"] == "0", values
    assert any("TF has no transform" in s.status[0].message for s in states), "the extrinsic is assumed silently"

    rospy.wait_for_service("nvm/save", 120)
    answer = rospy.ServiceProxy("nvm/save", Trigger)()
    assert answer.success, answer.message
    saved = [[float(w) for w in line.split()] for line in open(save_folder / "trajectory.tum")]
    expect_same(saved, reference)
    assert (save_folder / "map.nvm").stat().st_size > 10_000
    assert rospy.ServiceProxy("nvm/reset", Trigger)().success
    answer = rospy.ServiceProxy("nvm/save", Trigger)()
    assert not answer.success and "no pose" in answer.message, answer.message


def values_of(state):
    return {entry.key: entry.value for entry in state.status[0].values}


with RosWorld() as ros_world:
    test(ros_world)
