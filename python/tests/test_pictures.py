# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Results as arrays, their pictures, and runs in rerun's recordings."""

import numpy as np
import pytest
from support import wall

import nvm
from nvm.cli import main
from nvm.results import ResultError, read_results, read_trajectory

COUNT = 40
FRAMES = "time,status,why,unobserved_directions,unobserved,deskew_ms,normals_ms,optimize_ms,map_update_ms\n"


def poses():
    """Rows of a TUM file: a bow, turning about z."""
    angle = np.linspace(0.0, 1.0, COUNT)
    rows = np.zeros((COUNT, 8))
    rows[:, 0] = 100.0 + 0.1 * np.arange(COUNT)
    rows[:, 1:4] = np.stack([5 * np.sin(angle), 5 * np.cos(angle), 0.1 * angle], axis=1)
    rows[:, 6], rows[:, 7] = np.sin(angle / 2), np.cos(angle / 2)
    return rows


@pytest.fixture
def folder(tmp_path, rng):
    """What a run leaves behind."""
    folder = tmp_path / "out"
    folder.mkdir()
    np.savetxt(folder / "trajectory.tum", poses(), fmt="%.9f")
    rows = [f'{t:.9f},{"weak" if i == 5 else "tracking"},"a ""word"", or two",1,"",1,2,3,4\n' for i, t in enumerate(poses()[:, 0])]
    (folder / "frames.csv").write_text(FRAMES + "".join(rows))
    voxel_map = nvm.VoxelMap()
    for y, facing in ((0.0, -1.0), (0.1, 1.0)):
        voxel_map.insert(*wall(rng, 3000, y, facing))
    voxel_map.save(folder / "map.nvm")
    return folder


def test_results_are_what_was_written(folder):
    results = read_results(folder)
    np.testing.assert_allclose(results.trajectory.positions, poses()[:, 1:4], atol=1e-8)
    np.testing.assert_allclose(results.trajectory.quaternions, poses()[:, 4:], atol=1e-8)
    assert results.frames["status"][5] == "weak" and results.frames["why"][0] == 'a "word", or two'
    assert results.frames["optimize_ms"].tolist() == [3.0] * COUNT
    assert set(results.cloud.sides) == {0, 1}
    (folder / "map_origin.txt").write_text("# x y z\n1000 2000 0\n")
    moved = read_results(folder / "map.nvm").cloud.positions - results.cloud.positions
    np.testing.assert_allclose(moved, np.tile([1000.0, 2000.0, 0.0], (len(moved), 1)), atol=1e-9)


def test_what_is_no_result_is_named(tmp_path):
    with pytest.raises(ResultError, match="neither trajectory.tum nor map.nvm"):
        read_results(tmp_path)
    (tmp_path / "poses.txt").write_text("1 2 3\n")
    with pytest.raises(ResultError, match="8 numbers a line"):
        read_trajectory(tmp_path / "poses.txt")
    with pytest.raises(ResultError, match="none: does not exist"):
        read_results(tmp_path / "none")
    assert main(["plot", str(tmp_path)]) == 1
    assert main(["plot", str(tmp_path / "none")]) == 1


def test_pictures_of_all_that_there_is(folder, tmp_path):
    pytest.importorskip("matplotlib")
    truth = tmp_path / "truth.tum"
    np.savetxt(truth, poses())
    assert main(["plot", str(folder), "--truth", str(truth)]) == 0
    names = {path.name for path in (folder / "plots").iterdir()}
    assert names == {"top.png", "sections.png", "times.png", "errors.png"}
    assert all((folder / "plots" / name).stat().st_size > 10_000 for name in names)
    assert main(["plot", str(folder / "map.nvm"), "--out", str(tmp_path / "map")]) == 0
    assert {path.name for path in (tmp_path / "map").iterdir()} == {"top.png", "sections.png"}


def test_errors_are_those_after_the_best_rigid_alignment(folder):
    pytest.importorskip("matplotlib")
    from nvm.plots import position_errors

    estimate = read_trajectory(folder / "trajectory.tum")
    truth = read_trajectory(folder / "trajectory.tum")
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    truth.positions = truth.positions @ turn.T + [10.0, 20.0, 30.0]
    times, errors = position_errors(estimate, truth)
    assert len(times) == COUNT
    np.testing.assert_allclose(errors, 0.0, atol=1e-12)
    bumped = np.zeros((COUNT, 3))
    bumped[:, 2] = 0.01 * (-1.0) ** np.arange(COUNT)
    estimate.positions = estimate.positions + bumped
    errors = position_errors(estimate, truth)[1]
    rmse = np.sqrt(np.mean(np.sum(errors**2, axis=1)))
    assert 0.0097 < rmse <= 0.01  # the alignment takes a little of it
    truth.times = truth.times + 1e6
    with pytest.raises(ResultError, match="another clock"):
        position_errors(estimate, truth)


ENTITIES = (
    "/world/map/front",
    "/world/map/back",
    "/world/body",
    "/world/lidar/scan",
    "/world/unobserved_translations",
    "/world/body/unobserved_rotations",
    "/status/of_scan",
    "/times/optimize",
)


def recorded(path):
    """The entities of an .rrd file."""
    text = path.read_bytes()
    return {name for name in ENTITIES if name.encode() in text}


def test_a_finished_run_becomes_a_recording(folder, tmp_path):
    pytest.importorskip("rerun")
    assert main(["view", str(folder), "--record", str(tmp_path / "run.rrd")]) == 0
    expected = {"/world/map/front", "/world/map/back", "/world/body", "/status/of_scan", "/times/optimize"}
    assert recorded(tmp_path / "run.rrd") == expected


def test_a_run_is_shown_while_it_goes_on(tmp_path, rng, monkeypatch):
    pytest.importorskip("rerun")
    from sequences import write_sequence

    from nvm import viewer

    frames = []
    show = viewer.RunFollower._show

    def counted(self, *frame):
        frames.append(frame)
        show(self, *frame)

    monkeypatch.setattr(viewer.RunFollower, "_show", counted)
    sequence = write_sequence(tmp_path / "walk", rng)
    arguments = ["run", str(sequence), "--out", str(tmp_path / "out"), "--record", str(tmp_path / "live.rrd")]
    assert main(arguments) == 0
    rows = (tmp_path / "out" / "frames.csv").read_text().splitlines()
    assert len(frames) == len(rows) - 1
    placed = [frame for frame in frames if frame[0]["T_map_body"]]
    poses = read_results(tmp_path / "out").trajectory
    np.testing.assert_allclose([head["T_map_body"][:3] for head, *_ in placed], poses.positions, atol=1e-8)
    assert all(len(scan) > 1000 for _, scan, *_ in placed)
    maps = [(positions, sides) for _, _, positions, sides in frames if len(sides)]
    assert maps and set(maps[-1][1]) <= {0, 1}
    assert np.abs(maps[-1][0]).max() < 12.0  # within the room
    assert recorded(tmp_path / "live.rrd") == set(ENTITIES)


def test_what_a_scan_does_not_tell_is_drawn_and_cleared(tmp_path):
    rr = pytest.importorskip("rerun")
    from nvm.viewer import RunLog

    logged = {}

    class Stream:
        def log(self, entity, what, static=False):
            logged[entity] = what

    log = RunLog(Stream())
    log.unobserved((1.0, 2.0, 3.0), [[0.0, 1.0, 0.0]], [])
    arrows = logged["world/unobserved_translations"]
    assert isinstance(arrows, rr.Arrows3D)
    np.testing.assert_allclose(arrows.vectors.as_arrow_array().flatten().to_numpy(), [0, 1, 0, 0, -1, 0])
    assert isinstance(logged["world/body/unobserved_rotations"], rr.Clear)


def test_a_run_that_begins_again_is_drawn_anew():
    pytest.importorskip("rerun")
    from nvm.viewer import RunLog

    logged = {}

    class Stream:
        def set_time(self, *_, **__):
            pass

        def log(self, entity, what, static=False):
            logged[entity] = what

    log = RunLog(Stream())
    for time in (1.0, 2.0, 3.0, 1.0):
        log.pose(time, (time, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    assert logged["world/path"].strips.as_arrow_array().to_pylist() == [[[1.0, 0.0, 0.0]]]


def test_a_viewer_that_fails_does_not_end_the_run(tmp_path, rng, monkeypatch, capsys):
    pytest.importorskip("rerun")
    from sequences import write_sequence

    from nvm import viewer

    def fail(self, *frame):
        raise OSError("the viewer was closed")

    monkeypatch.setattr(viewer.RunFollower, "_show", fail)
    sequence = write_sequence(tmp_path / "walk", rng)
    arguments = ["run", str(sequence), "--out", str(tmp_path / "out"), "--record", str(tmp_path / "live.rrd")]
    assert main(arguments) == 0
    assert "no longer shown: the viewer was closed" in capsys.readouterr().err
    assert len(read_trajectory(tmp_path / "out" / "trajectory.tum").times) > 50


def test_watching_needs_rerun_and_says_so(folder, monkeypatch, capsys):
    import sys

    monkeypatch.setitem(sys.modules, "rerun", None)
    assert main(["view", str(folder)]) == 1
    assert "pip install rerun-sdk" in capsys.readouterr().err
