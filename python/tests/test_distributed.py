# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Maps built in tiles, by one process and by the workers of a cluster."""

import json
import os
import signal
import threading
import time

import numpy as np
import pytest

import nvm
from nvm.cli import main
from nvm.distributed import Session, build

OPTIONS = {"voxel_size": 0.3, "min_point_distance": 0.1, "capacity": 20_000}
TILE = 3.0


def corridor(count: int, seed: int) -> Session:
    """A sensor that goes along a corridor, 12 x 2 x 2 m around zero."""
    random = np.random.default_rng(seed)
    scans, poses = [], []
    for k in range(count):
        pose = np.eye(4)
        pose[0, 3] = -5.0 + 10.0 * k / count
        directions = random.normal(size=(2500, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        half = np.array([6.0, 1.0, 1.0])
        with np.errstate(divide="ignore"):
            reach = (np.where(directions > 0, half, -half) - pose[:3, 3]) / directions
        points = directions * reach.min(axis=1)[:, None] + random.normal(scale=0.003, size=(2500, 3))
        scans.append(points.astype(np.float32))
        poses.append(pose)
    return Session(scans, np.stack(poses))


@pytest.fixture(scope="module")
def sessions():
    return [corridor(6, 1), corridor(5, 2)]


@pytest.fixture(scope="module")
def alone(sessions, tmp_path_factory):
    return build_at(tmp_path_factory.mktemp("alone") / "store", sessions)


def build_at(path, sessions, **more):
    return build(sessions, path, tile_size=TILE, scans_per_task=2, map_options=OPTIONS, **more)


def contents(path) -> dict[str, bytes]:
    return {str(f.relative_to(path)): f.read_bytes() for f in path.rglob("*") if f.is_file()}


def test_a_store_answers_as_one_map_would(alone, sessions):
    whole = nvm.VoxelMap(**OPTIONS)
    for session in sessions:
        for points, pose in zip(session.scans, session.poses):
            whole.insert(points, nvm.estimate_normals(points), pose)
    assert len(alone) == len(whole)
    assert len(alone.tiles) > 4
    rows = np.random.default_rng(0).permutation(len(whole))[:3000]
    points, normals = whole.points[rows] + 0.02, whole.normals[rows]
    for given in (normals, None):
        distances, positions, counts = alone.nearest(points, given, k=4)
        expected = whole.nearest(points, given, k=4)
        np.testing.assert_array_equal(counts, expected[2])
        np.testing.assert_array_equal(distances, expected[0])
    stored = whole.points
    np.testing.assert_array_equal(positions[:, 0], stored[expected[1][:, 0]])


def test_queries_far_away_or_not_finite_find_nothing(alone):
    distances, positions, counts = alone.nearest([[1e4, 0, 0], [np.nan, 0, 0], [1e300, 0, 0]], k=2)
    assert np.isinf(distances).all() and np.isnan(positions).all() and not counts.any()


def test_few_tiles_in_memory_give_the_same_answers(alone):
    points = np.linspace([-5, 0.9, 0], [5, 0.9, 0], 50)
    small = nvm.open_store(alone.path, max_tiles=1)
    np.testing.assert_array_equal(small.nearest(points)[0], alone.nearest(points)[0])


def test_every_tile_is_checked(sessions, tmp_path):
    store = build_at(tmp_path / "store", sessions)
    assert store.check() == []
    damaged, lost = sorted((tmp_path / "store/tiles").iterdir())[:2]
    data = bytearray(damaged.read_bytes())
    data[len(data) // 2] ^= 1
    damaged.write_bytes(data)
    lost.unlink()
    problems = store.check()
    assert len(problems) == 2
    assert damaged.name in problems[0] + problems[1] and lost.name in problems[0] + problems[1]


def test_a_build_that_fails_leaves_no_store_and_the_next_one_begins_anew(alone, sessions, tmp_path):
    broken = Session([*sessions[1].scans[:-1], tmp_path / "missing.npy"], sessions[1].poses)
    with pytest.raises(OSError, match="missing.npy"):
        build_at(tmp_path / "store", [sessions[0], broken])
    with pytest.raises(RuntimeError, match="build again"):
        nvm.open_store(tmp_path / "store")
    build_at(tmp_path / "store", sessions)
    assert contents(tmp_path / "store") == contents(alone.path)


def test_bad_input_is_refused(sessions, alone, tmp_path):
    with pytest.raises(ValueError, match="holds a store already"):
        build_at(alone.path, sessions)
    with pytest.raises(ValueError, match="no scans"):
        build([], tmp_path / "store")
    with pytest.raises(ValueError, match="5 scans and 6 poses"):
        Session(sessions[1].scans, sessions[0].poses)
    with pytest.raises(ValueError, match="smaller tile_size"):
        build(sessions, tmp_path / "full", map_options={**OPTIONS, "capacity": 10})
    with pytest.raises(ValueError, match="carry points and no intensity"):
        build(sessions, tmp_path / "bright", map_options={**OPTIONS, "intensity": True})
    with pytest.raises(ValueError, match="voxels of"):
        build(sessions, tmp_path / "small", tile_size=0.5, map_options=OPTIONS)
    with pytest.raises(RuntimeError, match="no store"):
        nvm.open_store(tmp_path)
    with pytest.raises(ValueError, match="k = -1"):
        alone.nearest(np.zeros((3, 3)), k=-1)
    with pytest.raises(ValueError, match=r"shape \(N, 3\)"):
        alone.nearest(np.zeros((3, 4)))


def test_newer_and_damaged_indices_are_refused(alone, tmp_path):
    index = json.loads((alone.path / "index.json").read_text())
    for change, message in [({"version": 99}, "version 99"), ({"format": "other"}, "damaged")]:
        (tmp_path / "index.json").write_text(json.dumps({**index, **change}))
        with pytest.raises(RuntimeError, match=message):
            nvm.open_store(tmp_path)
    (tmp_path / "index.json").write_text(json.dumps(index)[:-40])
    with pytest.raises(RuntimeError, match="damaged"):
        nvm.open_store(tmp_path)


def cluster(workers: int):
    distributed = pytest.importorskip("distributed")
    return distributed.LocalCluster(
        n_workers=workers, threads_per_worker=1, dashboard_address=None, silence_logs=50
    )


@pytest.mark.filterwarnings("ignore")  # of the cluster's own shutdown
@pytest.mark.parametrize("workers", [1, 2])
def test_any_number_of_workers_builds_the_same_bytes(workers, alone, sessions, tmp_path):
    with cluster(workers) as local, local.get_client() as client:
        build_at(tmp_path / "store", sessions, client=client)
    assert contents(tmp_path / "store") == contents(alone.path)


@pytest.mark.filterwarnings("ignore")
def test_a_worker_that_is_killed_changes_nothing(alone, sessions, tmp_path):
    with cluster(2) as local, local.get_client() as client:
        victim = next(iter(client.run(os.getpid).values()))

        def kill():
            while not any((tmp_path / "store").glob("parts/*.npz")):
                time.sleep(0.001)
            os.kill(victim, signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        build_at(tmp_path / "store", sessions, client=client)
        killer.join()
    assert contents(tmp_path / "store") == contents(alone.path)


def test_the_command_says_what_a_store_holds_and_whether_it_is_whole(sessions, tmp_path, capsys):
    store = build_at(tmp_path / "store", sessions)
    assert main(["info", str(store.path), "--check"]) == 0
    assert f"all {len(store.tiles)} tiles are whole" in capsys.readouterr().out
    next((store.path / "tiles").iterdir()).unlink()
    assert main(["info", str(store.path), "--check"]) == 1
    assert main(["info", str(tmp_path)]) == 1
    assert len(capsys.readouterr().err.splitlines()) == 2
