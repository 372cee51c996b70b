# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Tile stores behind URLs: the same bytes, and one line when the other side fails."""

import io
from pathlib import Path

import numpy as np
import pytest
from test_distributed import TILE, alone, build_at, cluster, contents, sessions  # noqa: F401: fixtures

import nvm
from nvm.cli import main
from nvm.distributed import Session, build
from nvm.folders import LocalFolder

fsspec = pytest.importorskip("fsspec")
from fsspec.implementations.memory import MemoryFileSystem  # noqa: E402
from fsspec.registry import known_implementations  # noqa: E402


class FailingFileSystem(MemoryFileSystem):
    """One that takes `room` more files and reads `reads` more, as a full disk or a bad line would have it."""

    protocol = "failing"
    store = {}
    pseudo_dirs = [""]
    room = reads = 10**9

    @classmethod
    def _strip_protocol(cls, path):
        return super()._strip_protocol(path.replace("failing://", "memory://"))

    def pipe_file(self, path, value, **options):
        FailingFileSystem.room -= 1
        if FailingFileSystem.room < 0:
            raise OSError(28, "No space left on device")
        super().pipe_file(path, value, **options)

    def cat_file(self, path, *args, **options):
        FailingFileSystem.reads -= 1
        if FailingFileSystem.reads < 0:
            raise ConnectionResetError("the line went dead\nand more of it")
        return super().cat_file(path, *args, **options)


@pytest.fixture(autouse=True)
def empty():
    fsspec.register_implementation("failing", FailingFileSystem, clobber=True)
    for kind in (MemoryFileSystem, FailingFileSystem):
        kind.store.clear()
    FailingFileSystem.room = FailingFileSystem.reads = 10**9


def stored(kind, folder: str) -> dict[str, bytes]:
    files = kind().find(folder)
    return {file.removeprefix(f"{folder}/"): kind().cat_file(file) for file in files}


def test_a_store_behind_a_url_has_the_bytes_of_one_in_a_folder(alone, sessions):
    store = build_at("memory://campus/store", sessions)
    assert stored(MemoryFileSystem, "/campus/store") == contents(alone.path)
    assert store.path == "memory://campus/store" and store.check() == []
    assert repr(store) == repr(alone)
    points = np.random.default_rng(0).uniform((-5, -1, -1), (5, 1, 1), (500, 3))
    one_tile = nvm.open_store("memory://campus/store", max_tiles=1)
    for found, expected in zip(one_tile.nearest(points, k=3), alone.nearest(points, k=3)):
        np.testing.assert_array_equal(found, expected)
    with pytest.raises(ValueError, match="memory://campus/store: holds a store already"):
        build_at("memory://campus/store", sessions)


def test_queries_fetch_the_tiles_that_they_need_alone(sessions):
    build_at("failing://store", sessions)
    FailingFileSystem.reads = 2  # the index, and one tile
    store = nvm.open_store("failing://store")
    assert store.nearest([[1.5, 0.99, 0.1], [1.6, 0.99, 0.1]], k=1)[2].tolist() == [1, 1]
    with pytest.raises(OSError, match="^failing://store/tiles/.*nvm: the line went dead$"):
        store.nearest([[-4.5, 0.99, 0.1]])
    FailingFileSystem.reads = 10**9
    assert store.nearest([[-4.5, 0.99, 0.1]], k=1)[2].tolist() == [1]


@pytest.mark.filterwarnings("ignore")  # of the cluster's own shutdown
def test_workers_build_the_same_bytes_at_a_url_from_scans_at_urls(alone, sessions, tmp_path):
    urls = []
    for i, session in enumerate(sessions):
        for j, points in enumerate(session.scans):
            np.save(tmp_path / f"{i}-{j} of them.npy", points)
        urls.append([f"file://{tmp_path}/{i}-{j} of them.npy" for j in range(len(session.scans))])
    there = [Session(scans, session.poses) for scans, session in zip(urls, sessions)]
    with cluster(2) as local, local.get_client() as client:
        store = build_at(f"file://{tmp_path}/store", there, client=client)
        assert store.path == tmp_path / "store" and contents(store.path) == contents(alone.path)
        with pytest.raises(RuntimeError, match="memory://.*workers see another folder"):
            build_at("memory://elsewhere", there, client=client)
        client.cluster.scale(1)
        client.wait_for_workers(1)
        with pytest.raises(RuntimeError, match="memory://.*workers see another folder"):
            build_at("memory://elsewhere", there, client=client)
    with pytest.raises(RuntimeError, match="memory://elsewhere: is no store"):
        nvm.open_store("memory://elsewhere")


def test_scans_in_memory_are_read(alone, sessions):
    for i, points in enumerate(sessions[0].scans):
        file = io.BytesIO()
        np.save(file, points)
        MemoryFileSystem().pipe_file(f"/scans/{i}.npy", file.getvalue())
    urls = [f"memory://scans/{i}.npy" for i in range(len(sessions[0].scans))]
    build_at("memory://store", [Session(urls, sessions[0].poses), sessions[1]])
    assert stored(MemoryFileSystem, "/store") == contents(alone.path)
    MemoryFileSystem().pipe_file("/scans/0.npy", file.getvalue()[:200])
    with pytest.raises(ValueError, match="memory://scans/0.npy: is no .npy file, or is damaged"):
        build_at("memory://other", [Session(urls, sessions[0].poses)])
    with pytest.raises(FileNotFoundError, match="memory://scans/gone.npy: does not exist"):
        build_at("memory://third", [Session(["memory://scans/gone.npy"], sessions[0].poses[:1])])


@pytest.mark.parametrize("share", [0.2, 0.8, 1.0])
def test_a_store_that_cannot_be_written_to_its_end_is_none_and_is_built_anew(alone, sessions, share):
    build_at("failing://whole", sessions)
    needed = 10**9 - FailingFileSystem.room
    FailingFileSystem.room = int(share * needed) - 1  # 1.0: all but the index
    with pytest.raises(OSError, match="^failing://store/.*: .*No space left on device$"):
        build_at("failing://store", sessions)
    FailingFileSystem.room = 10**9
    with pytest.raises(RuntimeError, match="failing://store: is no store: its build has not come to its end"):
        nvm.open_store("failing://store")
    build_at("failing://store", sessions)
    assert stored(FailingFileSystem, "/store") == contents(alone.path)


def test_tiles_that_are_not_those_of_the_index_are_found(sessions):
    store = build_at("memory://store", sessions)
    tiles = sorted(MemoryFileSystem().find("/store/tiles"))
    whole = MemoryFileSystem().cat_file(tiles[0])
    MemoryFileSystem().pipe_file(tiles[1], whole)  # a map, but of another tile
    MemoryFileSystem().pipe_file(tiles[2], whole[:-1])
    MemoryFileSystem().rm(tiles[3])
    problems = store.check()
    assert len(problems) == 3
    for problem, tile in zip(sorted(problems), tiles[1:]):
        assert problem.startswith(f"memory:/{tile}: ")
    with pytest.raises(RuntimeError, match="build again"):
        for tile in store.tiles:
            store.load(tile)


def test_files_of_others_are_never_removed(sessions, tmp_path):
    (tmp_path / "tiles").mkdir()
    (tmp_path / "tiles" / "floor.png").write_bytes(b"mine")
    MemoryFileSystem().pipe_file("/mine/parts/1_2_3.txt", b"mine")
    for place, file in ((tmp_path, "tiles/floor.png"), ("memory://mine", "parts/1_2_3.txt")):
        with pytest.raises(ValueError, match=f"{file}: is of no build"):
            build_at(place, sessions)
    assert (tmp_path / "tiles" / "floor.png").read_bytes() == b"mine"
    assert MemoryFileSystem().cat_file("/mine/parts/1_2_3.txt") == b"mine"


def test_what_a_killed_worker_left_goes(alone, sessions, tmp_path, monkeypatch):
    left = tmp_path / "tiles" / "0_0_0.nvm.0123abcd.part"
    left.parent.mkdir()
    left.touch()  # by a build before
    make = LocalFolder.make

    def make_and_be_killed(folder, name):
        make(folder, name)
        (folder.path / name / left.name).touch()

    monkeypatch.setattr(LocalFolder, "make", make_and_be_killed)
    build_at(tmp_path, sessions)
    assert contents(tmp_path) == contents(alone.path)


def test_urls_that_cannot_be_opened_are_refused_in_one_line(sessions, monkeypatch):
    for open_it in (nvm.open_store, nvm.survey, lambda url: build_at(url, sessions)):
        with pytest.raises(ValueError, match="^nothing://x/y: Protocol not known: nothing$"):
            open_it("nothing://x/y")
        monkeypatch.setitem(known_implementations, "far", {"class": "no_such.F", "err": "Install farfs"})
        with pytest.raises(RuntimeError, match="^far://x/y: Install farfs$"):
            open_it("far://x/y")
    for open_it in (nvm.open_store, lambda url: build_at(url, sessions)):
        with pytest.raises(ValueError, match="^s3:/x/y: give a URL as text"):
            open_it(Path("s3://x/y"))
    with pytest.raises(RuntimeError, match="^memory://empty: is no store: has no index.json$"):
        nvm.open_store("memory://empty")


def test_the_command_and_the_survey_take_urls(alone, sessions, tmp_path, capsys):
    build_at("memory://store", sessions)
    assert main(["info", "memory://store", "--check"]) == 0
    assert f"all {len(alone.tiles)} tiles are whole" in capsys.readouterr().out
    assert main(["info", "memory://none"]) == 1
    assert capsys.readouterr().err == "nvm: memory://none: is no store: has no index.json\n"
    assert nvm.survey("memory://store") == nvm.survey(alone.path)
    assert main(["walls", str(alone.path), "--out", str(tmp_path / "a")]) == 0
    assert main(["walls", "memory://store", "--out", str(tmp_path / "b")]) == 0
    assert contents(tmp_path / "a")["walls.json"] == contents(tmp_path / "b")["walls.json"]
    assert main(["walls", "memory://none", "--out", str(tmp_path / "c")]) == 1
