# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Every command of the program that the package brings, on a walk around a wall of 0.1 m, against its truth."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from sequences import WALL, scan, write_sequence, write_truth
from support import nvm, wall

from nvm import VoxelMap, export, load

COMMANDS = ("run", "map", "merge", "walls", "export", "evaluate")


def done(*arguments):
    """What a command prints; it must succeed."""
    result = nvm(*arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def walks(tmp_path_factory):
    """Two walks as sequences, walk_0 and walk_1, and their runs, run_0 and run_1."""
    folder = tmp_path_factory.mktemp("walks")
    for i in range(2):
        write_sequence(folder / f"walk_{i}", np.random.default_rng(i))
        done("run", folder / f"walk_{i}", "--out", folder / f"run_{i}")
    return folder


def test_an_interruption_is_no_traceback(monkeypatch):
    from nvm import cli

    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(cli, "is_recording", interrupted)
    assert cli.main(["info", "anything"]) == 130


INTERRUPTED = """
import os, signal, sys

class Interrupter:
    def find_spec(self, name, *_):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)

module = sys.argv.pop()
sys.meta_path.insert(0, Interrupter())
from nvm_command import main
sys.exit(main())
"""


@pytest.mark.parametrize("module", ["nvm", "nvm._nvm", "numpy", "nvm.cli", "rosbags.rosbag1"])
def test_an_interruption_of_imports_is_no_traceback(module, tmp_path):
    bag = tmp_path / "empty.bag"
    bag.touch()
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, "info", bag, module],
        capture_output=True,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # else ignored beside others
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


@pytest.mark.parametrize("send", [os.kill, os.killpg])
def test_an_interruption_reaches_the_program_once(tmp_path, send):
    program = tmp_path / "program"
    program.write_text(
        "#!/bin/sh\ncount=0\ntrap 'count=$((count + 1))' INT\necho started > started\n"
        "for i in 1 2 3 4 5 6 7 8 9 10; do sleep 0.1; done\necho $count > count\nexit 130\n"
    )
    program.chmod(0o755)
    process = subprocess.Popen(
        [sys.executable, "-c", "import sys; from nvm_command import main; sys.exit(main())", "run", "scans"],
        cwd=tmp_path,
        env=os.environ | {"NVM_PROGRAM": str(program)},
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # else ignored beside others
    )
    while not (tmp_path / "started").exists():
        time.sleep(0.02)
    time.sleep(0.1)
    send(process.pid, signal.SIGINT)
    assert process.wait(20) == 130
    assert (tmp_path / "count").read_text() == "1\n"


def test_the_viewer_needs_no_matplotlib():
    code = "import sys; sys.modules['matplotlib'] = None; import nvm.viewer"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_run_and_evaluate(walks, tmp_path):
    done("evaluate", walks / "run_0", "--truth", walks / "walk_0", "--out", tmp_path / "report")
    report = json.loads((tmp_path / "report" / "evaluation.json").read_text())
    assert report["runs"][0]["trajectory"]["ate_m"]["rmse"] < 0.002


def test_walls_measures_the_wall(walks, tmp_path):
    text = done("walls", walks / "run_0" / "map.nvm", "--out", tmp_path / "walls")
    rows = [line.split() for line in text.splitlines() if " wall " in line]
    assert len(rows) == 1 and float(rows[0][2]) == pytest.approx(100.0, abs=2.0), text


def test_merge_and_info(walks, tmp_path):
    done("merge", walks / "run_0", walks / "run_1", "--out", tmp_path / "all.nvm")
    assert "VoxelMap" in done("info", tmp_path / "all.nvm")
    for folder in ("walk_0", "run_0"):
        assert "go to nvm run" in nvm("info", walks / folder).stderr


def test_map_from_poses_and_export(tmp_path, rng):
    (tmp_path / "scans").mkdir()
    times = np.array([1.0, 2.5, 3.5, 4.5, 6.0])
    for time in times:
        write_ply(tmp_path / "scans" / f"{time:.6f}.ply", scan(rng, time, 20_000, sweep=0.0)[0])
    write_truth(tmp_path / "poses.tum", times)
    done("map", tmp_path / "scans", "--poses", tmp_path / "poses.tum", "--out", tmp_path / "out")
    points = load(tmp_path / "out" / "map.nvm").points
    wall = points[(np.abs(points[:, 0]) < 0.8) & (np.abs(points[:, 1]) < 0.3) & (np.abs(points[:, 2]) < 1.0)]
    assert len(wall) > 200
    np.testing.assert_allclose(np.abs(wall[:, 1]), WALL[1, 1], atol=0.02)
    done("export", tmp_path / "out" / "map.nvm", "--out", tmp_path / "map.pcd")
    assert (tmp_path / "map.pcd").stat().st_size > 10_000


def test_maps_and_files_of_them_are_exported(tmp_path, rng):
    voxel_map = VoxelMap()
    voxel_map.insert(*wall(rng, 500, 1.0, -1.0))
    voxel_map.save(tmp_path / "map.nvm")
    written = export(voxel_map, tmp_path / "of_map.ply")
    assert written == tmp_path / "of_map.ply" and f"element vertex {len(voxel_map)}\n".encode() in written.read_bytes()
    assert export(str(tmp_path / "map.nvm"), tmp_path / "of_file.ply").read_bytes() == written.read_bytes()
    assert np.array_equal(load(export(voxel_map, tmp_path / "map.image")).points, voxel_map.points)
    (tmp_path / "map_origin.txt").write_text("# x y z\n1000 0 0\n")
    assert export(tmp_path / "map.nvm", tmp_path / "far.ply").read_bytes() != written.read_bytes()
    with pytest.raises(RuntimeError, match="missing.nvm"):
        export(tmp_path / "missing.nvm", tmp_path / "no.ply")
    with pytest.raises(RuntimeError, match="map.txt"):
        export(voxel_map, tmp_path / "map.txt")


def write_ply(path, points):
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    path.write_bytes(head.encode() + points.astype("<f4").tobytes())


@pytest.mark.parametrize("command", COMMANDS)
def test_help(command):
    assert "--out" in done(command, "--help")
    failed = nvm(command, "--no-such-option")
    assert failed.returncode == 2 and f"nvm {command} has no option" in failed.stderr


def test_the_help_of_the_command_names_all():
    text = done("--help")
    assert all(f"    {name} " in text for name in (*COMMANDS, "info", "simulate", "view", "plot")), text


def test_the_default_config_can_be_printed():
    assert "voxel_size:" in done("run", "--print-config")
