# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The command nvm on bags: what the C++ program says of them, bit by bit."""

import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, FORMATS, IMU, LIVOX_POINT, TF, records, write
from rosbags.rosbag1 import Reader as Reader1
from rosbags.rosbag1 import Writer as Writer1
from support import box_room, nvm

from nvm.program import find_program

PROGRAM = find_program()
BEGIN = 1000.0  # [s]


def room_records(rng, dtype, count=3000):
    values = records(rng, count, dtype)
    points = box_room(rng, count, noise=0.005).astype(np.float32)
    for axis, name in enumerate("xyz"):
        values[name] = points[:, axis]
    return values


def standing_still(rng, livox=""):
    """A maker of 3 s of a LiDAR and an IMU in a room; `livox`: the type of its clouds, if not PointCloud2."""

    def make(m):
        yield "/tf_static", TF, BEGIN, m.transforms(("imu", "lidar", (0.1, 0, 0.2), (0, 0, 0, 1)))
        for i in range(30):
            time = BEGIN + 0.1 * i
            for j in range(20):
                stamp = time + 0.005 * j
                noise = rng.normal(size=6) * 0.002
                yield "/imu", IMU, stamp + 0.001, m.imu(stamp, noise[:3], noise[3:] + (0, 0, 9.81))
            if livox:
                points = room_records(rng, LIVOX_POINT)
                points["offset_time"] = np.linspace(0, 99_000_000, len(points))
                yield "/livox/lidar", livox, time + 0.1, m.livox(time, points, "lidar")
            else:
                yield "/points", CLOUD, time + 0.1, m.cloud(time, room_records(rng, POINTS))

    return make


POINTS = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("t", "u4"), ("ring", "u2")])


def seeded(seed=7, **options):
    return standing_still(np.random.default_rng(seed), **options)


def trajectory(folder):
    text = (folder / "trajectory.tum").read_text()
    assert len(text.splitlines()) > 10
    return text


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """The trajectory of the ROS 2 bag."""
    folder = tmp_path_factory.mktemp("reference")
    done = nvm("run", write(folder / "still", "mcap", seeded()), "--out", folder / "out")
    assert done.returncode == 0, done.stderr
    return trajectory(folder / "out"), done


@pytest.mark.parametrize("form", sorted(set(FORMATS) - {"mcap"}))
def test_every_format_gives_the_same_bits(reference, tmp_path, form):
    done = nvm("run", write(tmp_path / "still", form, seeded()), "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert trajectory(tmp_path / "out") == reference[0]


def test_the_choice_is_said(reference):
    for line in ("lidar: /points, the only one", "IMU: /imu", "T_imu_lidar: from /tf_static"):
        assert f"nvm: note: {line}" in reference[1].stderr


def test_an_extrinsic_that_is_set_is_not_said_to_be_assumed(tmp_path):
    without = lambda m: (message for message in seeded()(m) if message[0] != "/tf_static")
    bag = write(tmp_path / "still", "bag", without)
    for setting, expected in (([], True), (["--set", "input.T_imu_lidar=[0.1,0,0.2,0,0,0,1]"], False)):
        done = nvm("run", bag, "--out", tmp_path / "out", *setting)
        assert done.returncode == 0, done.stderr
        assert ("identity is assumed" in done.stderr) == expected


def test_the_program_itself_gives_the_same_bits(reference, tmp_path):
    bag = write(tmp_path / "still", "bag", seeded())
    extrinsic = "input.T_imu_lidar=[0.1, 0.0, 0.2, 0.0, 0.0, 0.0, 1.0]"
    done = subprocess.run(
        [PROGRAM, "run", bag, "--out", tmp_path / "out", "--set", extrinsic],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert trajectory(tmp_path / "out") == reference[0]


@pytest.mark.parametrize(
    "form, driver",
    [("bag", "livox_ros_driver"), ("bag", "livox_ros_driver2"), ("mcap", "livox_ros_driver2"), ("db3", "livox_interfaces")],
)
def test_livox_messages_run(tmp_path, form, driver):
    done = nvm("run", write(tmp_path / "livox", form, seeded(livox=f"{driver}/msg/CustomMsg")), "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    trajectory(tmp_path / "out")


def test_settings_of_the_command_line_win(tmp_path):
    bag = write(tmp_path / "still", "db3", seeded())
    (tmp_path / "nvm.yaml").write_text("input:\n  T_imu_lidar: [0, 0, 0, 0, 0, 0, 1]\n")
    options = ["--config", tmp_path / "nvm.yaml", "--set", "pipeline=lidar_only"]
    done = nvm("run", bag, *options, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    done = nvm("run", bag, "--out", tmp_path / "out2", "--set", "input.lidar_topic=/nothing")
    assert done.returncode != 0 and "has no lidar topic '/nothing'" in done.stderr
    done = nvm("run", bag, "--out", tmp_path / "out3", "--set", "map.voxelsize=1")
    assert done.returncode != 0 and "map.voxel_size" in done.stderr
    assert not (tmp_path / "out3").exists()
    done = nvm("run", bag, "--out", tmp_path / "out3", "--set")
    assert done.returncode != 0 and "nvm: --set: " in done.stderr and "print-config" not in done.stderr, done.stderr


def test_a_bag_that_breaks_off_is_an_error_in_one_line(tmp_path):
    folder = write(tmp_path / "still", "mcap", seeded())
    file = next(folder.glob("*.mcap"))
    data = file.read_bytes()
    file.write_bytes(data[: len(data) // 2] + bytes(20_000) + data[len(data) // 2 + 20_000 :])
    done = nvm("run", folder, "--out", tmp_path / "out")
    assert done.returncode != 0
    assert "Traceback" not in done.stderr and str(folder) in done.stderr


def test_a_folder_of_ros1_bags_is_one_recording(reference, tmp_path):
    whole = write(tmp_path / "still", "bag", seeded())
    parts = tmp_path / "parts"
    parts.mkdir()
    split(whole, parts)
    done = nvm("run", parts, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert trajectory(tmp_path / "out") == reference[0]
    (parts / "metadata.yaml").write_text("of: something else\n")
    assert "lidar: /points" in nvm("info", parts).stdout


def test_a_folder_without_its_metadata_is_still_a_ros2_bag(reference, tmp_path):
    folder = write(tmp_path / "still", "mcap", seeded())
    (folder / "metadata.yaml").unlink()
    done = nvm("run", folder, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert trajectory(tmp_path / "out") == reference[0]


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_a_ros1_bag_that_was_cut_off_is_read_as_far_as_it_goes(tmp_path, compression):
    with Reader1(write(tmp_path / "still", "bag", seeded())) as reader:
        bag = copy(reader, tmp_path / "cut.bag", (None, None), compression)
    bag.write_bytes(bag.read_bytes()[: bag.stat().st_size * 3 // 4])
    done = nvm("run", bag, "--out", tmp_path / "out")
    assert "Traceback" not in done.stderr
    if compression == "none":
        assert done.returncode == 0, done.stderr
        trajectory(tmp_path / "out")
    else:
        assert done.returncode != 0
        assert f"is compressed ({compression})" in done.stderr and "rosbag decompress" in done.stderr


def split(bag, folder):
    """Copies a bag into two of half its length."""
    with Reader1(bag) as reader:
        middle = (reader.start_time + reader.end_time) // 2
        copy(reader, folder / "part_1.bag", (None, middle))
        copy(reader, folder / "part_2.bag", (middle, None))


def copy(reader, path, span, compression="none"):
    """Writes the messages from one time to another [ns] to a bag; returns its path."""
    writer = Writer1(path)
    if compression != "none":
        writer.set_compression(Writer1.CompressionFormat[compression.upper()])
    with writer:
        connections = {}
        for connection, time, data in reader.messages(start=span[0], stop=span[1]):
            if connection.id not in connections:
                kind, text, digest = connection.msgtype, connection.msgdef.data, connection.digest
                connections[connection.id] = writer.add_connection(
                    connection.topic, kind, msgdef=text, md5sum=digest
                )
            writer.write(connections[connection.id], time, data)
    return path


def test_the_program_is_that_of_the_package(monkeypatch, tmp_path):
    monkeypatch.delenv("NVM_PROGRAM", raising=False)
    assert pathlib.Path(find_program()).parts[-3:] == ("nvm", "bin", "nvm")
    monkeypatch.setenv("NVM_PROGRAM", str(tmp_path / "mine"))
    done = nvm("run", tmp_path)
    assert done.returncode == 1 and "mine" in done.stderr and "Traceback" not in done.stderr
    (tmp_path / "mine").write_text("#!/bin/sh\n")
    (tmp_path / "mine").chmod(0o755)
    assert find_program() == str(tmp_path / "mine")


def test_messages_name_the_recording_instead_of_its_pipe(tmp_path):
    def nothing_near(m):
        for i in range(3):
            cloud = room_records(np.random.default_rng(i), POINTS)
            cloud["x"] = np.nan
            yield "/points", CLOUD, BEGIN + i, m.cloud(BEGIN + i, cloud)

    for form in ("bag", "mcap"):
        path = write(tmp_path / form, form, nothing_near)
        done = nvm("run", path, "--out", tmp_path / "out")
        assert done.returncode != 0 and f"nvm: {path}: " in done.stderr and "/dev/fd" not in done.stderr, done.stderr
        poses = tmp_path / "poses.tum"
        poses.write_text("1000 0 0 0 0 0 0 1\n1005 0 0 0 0 0 0 1\n")
        done = nvm("map", path, "--poses", poses, "--out", tmp_path / "out")
        assert done.returncode != 0 and f"nvm: {path}: " in done.stderr and "/dev/fd" not in done.stderr, done.stderr
    done = nvm("run", path, "--out", path)
    assert done.returncode != 0 and "is where the scans are" in done.stderr and "map.nvm" not in os.listdir(path)


def test_memory_that_runs_out_names_the_recording(tmp_path, monkeypatch):
    """The program has none of the memory that the first clouds take; its reader has."""
    limited = tmp_path / "limited"
    limited.write_text(f'#!/bin/sh\nulimit -v 100000\nexec "{PROGRAM}" "$@"\n')
    limited.chmod(0o755)

    def wide(m):
        points = np.zeros(300_000, POINTS)
        for i in range(10):
            yield "/points", CLOUD, BEGIN + i, m.cloud(BEGIN + i, points)

    path = write(tmp_path / "wide", "bag", wide)
    monkeypatch.setenv("NVM_PROGRAM", str(limited))
    done = nvm("run", path, "--out", tmp_path / "out", "--set", "threads=1")
    assert f"nvm: memory ran out while opening {path}: " in done.stderr and "/dev/fd" not in done.stderr, done.stderr
