# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The command nvm on recordings: what the C++ program says, bit by bit."""

import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, FORMATS, IMU, LIVOX, LIVOX_POINT, TF, records, write
from support import box_room

from nvm.program import find_program, is_compiled

try:
    PROGRAM = find_program()
except RuntimeError as error:
    pytest.skip(str(error), allow_module_level=True)

BEGIN = 1000.0  # [s]


def room_records(rng, dtype, count=3000):
    values = records(rng, count, dtype)
    points = box_room(rng, count, noise=0.005).astype(np.float32)
    for axis, name in enumerate("xyz"):
        values[name] = points[:, axis]
    return values


def standing_still(rng, livox=False):
    """A maker of 3 s of a LiDAR and an IMU in a room."""

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
                yield "/livox/lidar", LIVOX, time + 0.1, m.livox(time, points, "lidar")
            else:
                yield "/points", CLOUD, time + 0.1, m.cloud(time, room_records(rng, POINTS))

    return make


POINTS = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("t", "u4"), ("ring", "u2")])


def seeded(seed=7, **options):
    return standing_still(np.random.default_rng(seed), **options)


def nvm(*arguments, **environment):
    """The command of the package."""
    return subprocess.run(
        [sys.executable, "-c", "import sys; from nvm.cli import main; sys.exit(main())", *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        timeout=300,
    )


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


def test_the_program_itself_gives_the_same_bits(reference, tmp_path):
    bag = write(tmp_path / "still", "bag", seeded())
    extrinsic = "input.T_imu_lidar=[0.1, 0.0, 0.2, 0.0, 0.0, 0.0, 1.0]"
    done = subprocess.run(
        [PROGRAM, "run", bag, "--out", tmp_path / "out", "--set", extrinsic],
        capture_output=True,
        text=True,
    )
    if "built without ROS 1 bags" in done.stderr:
        pytest.skip("the program does not read bags")
    assert done.returncode == 0, done.stderr
    assert trajectory(tmp_path / "out") == reference[0]


@pytest.mark.parametrize("form", ["bag", "mcap"])
def test_livox_messages_run(tmp_path, form):
    done = nvm("run", write(tmp_path / "livox", form, seeded(livox=True)), "--out", tmp_path / "out")
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


def test_a_bag_that_breaks_off_is_an_error_in_one_line(tmp_path):
    folder = write(tmp_path / "still", "mcap", seeded())
    file = next(folder.glob("*.mcap"))
    data = file.read_bytes()
    file.write_bytes(data[: len(data) // 2] + bytes(200) + data[len(data) // 2 + 200 :])
    done = nvm("run", folder, "--out", tmp_path / "out")
    assert done.returncode != 0
    assert "Traceback" not in done.stderr and str(folder) in done.stderr


def test_other_commands_go_to_the_program(tmp_path):
    done = nvm("run", tmp_path / "missing", "--out", tmp_path / "out")
    assert done.returncode != 0 and "does not exist" in done.stderr
    done = nvm("run", "--help")
    assert done.returncode == 0 and "--print-config" in done.stdout


def test_without_the_program_it_says_what_to_install(tmp_path):
    done = nvm("run", tmp_path, NVM_PROGRAM=str(tmp_path / "none"))
    assert done.returncode == 1 and "none" in done.stderr and "Traceback" not in done.stderr
    assert shutil.which(PROGRAM) or pathlib.Path(PROGRAM).is_file()


def test_finds_the_program_on_the_path_behind_scripts_of_its_name(tmp_path, monkeypatch):
    monkeypatch.delenv("NVM_PROGRAM", raising=False)
    script, compiled = tmp_path / "a" / "nvm", tmp_path / "b" / "nvm"
    for path in (script, compiled):
        path.parent.mkdir()
    script.write_text("#!/usr/bin/env python3\n")
    script.chmod(0o755)
    shutil.copy(PROGRAM, compiled)
    monkeypatch.setenv("PATH", f"{script.parent}{os.pathsep}{compiled.parent}")
    assert find_program() == str(compiled)
    assert not is_compiled(script)
    monkeypatch.setenv("PATH", str(script.parent))
    with pytest.raises(RuntimeError, match="nvm-tools"):
        find_program()
