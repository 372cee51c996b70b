# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What is no whole number in range is refused by name, wherever one is taken."""

import functools

import numpy as np
import pytest

import nvm

POINTS = np.zeros((2, 3))
CLASSES = (nvm.VoxelMap, nvm.NormalEstimator, nvm.ScanAligner)
ARGUMENTS = {
    "k": lambda value: nvm.VoxelMap().nearest(POINTS, k=value),
    "threads": lambda value: nvm.VoxelMap().nearest(POINTS, threads=value),
    "threads of an estimator": lambda value: nvm.NormalEstimator().estimate(POINTS, threads=value),
    "threads of an aligner": lambda value: nvm.ScanAligner().align(
        nvm.VoxelMap(), POINTS, POINTS, threads=value
    ),
}
OPTIONS = {
    f"{name} of {kind.__name__}": functools.partial(lambda kind, name, value: kind(**{name: value}), kind, name)
    for kind in CLASSES
    for name, default in kind().options.items()
    if type(default) is int
}
TAKERS = ARGUMENTS | OPTIONS | {"min_neighbors": lambda value: nvm.estimate_normals(POINTS, min_neighbors=value)}


@pytest.mark.parametrize("value", [-1, -(2**70), 2**70, 2.5, 3.0, np.nan, 1j, np.zeros(2)], ids=repr)
@pytest.mark.parametrize("taker", TAKERS)
def test_other_numbers_are_refused(taker, value):
    name = taker.split()[0]
    with pytest.raises(ValueError, match=rf"^nvm: {name} = .* must be .*\d"):
        TAKERS[taker](value)


@pytest.mark.parametrize("value", ["3", b"3", None, [3]], ids=repr)
@pytest.mark.parametrize("taker", TAKERS)
def test_other_objects_are_refused(taker, value):
    with pytest.raises(TypeError if taker in ARGUMENTS else ValueError):
        TAKERS[taker](value)


@pytest.mark.parametrize("value", [3, np.int16(3), np.uint64(3), np.array(3)], ids=repr)
@pytest.mark.parametrize("taker", ["k", "threads", "capacity of VoxelMap", "min_neighbors"])
def test_whole_numbers_of_any_type_are_taken(taker, value):
    TAKERS[taker](value)


@pytest.mark.parametrize("value", [-1, 2.5, 2**70, "many"])
def test_settings_of_odometry_are_refused_as_those_of_the_program(value):
    with pytest.raises((ValueError, RuntimeError), match="map.capacity"):
        nvm.Odometry({"map.capacity": value})


def test_ranges_reach_their_ends():
    for name, value in (("capacity", 1), ("points_per_surface", 1)):
        assert nvm.VoxelMap(**{name: value}).options[name] == value
    assert nvm.VoxelMap().nearest(POINTS, k=64)[0].shape == (2, 64)
    with pytest.raises(ValueError, match="from 1 to 64"):
        nvm.VoxelMap().nearest(POINTS, k=65)
