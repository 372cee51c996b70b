#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Draws the walls of a map from above, each point in the colour of the direction it faces, so that
the two faces of a wall differ.

usage: plot_map.py MAP.ply PICTURE.png [--trajectory TRAJECTORY.tum] [--heights MIN MAX]
                   [--detail X Y SIZE]

--heights keeps the points between MIN and MAX [m]. --detail adds a close-up of SIZE x SIZE m around
(X, Y), with the normals as arrows.
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import hsv_to_rgb
from matplotlib.patches import Rectangle

TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "ushort": "<u2", "int": "<i4"}
MAX_WALL_NORMAL_Z = 0.5


def read_ply(path):
    """The vertices of a binary little-endian PLY file as a structured array."""
    with open(path, "rb") as file:
        count = 0
        fields = []
        for line in iter(file.readline, b"end_header\n"):
            words = line.decode("ascii").split()
            if not words:
                raise SystemExit(f"{path}: is no PLY file")
            if words[:2] == ["element", "vertex"]:
                count = int(words[2])
            elif words[0] == "property":
                fields.append((words[2], TYPES[words[1]]))
        return np.fromfile(file, dtype=fields, count=count)


def colours(points):
    """The hue of a colour wheel for the direction that each normal faces in the plan."""
    hue = np.arctan2(points["ny"], points["nx"]) / (2.0 * np.pi) % 1.0
    return hsv_to_rgb(np.column_stack([hue, np.full_like(hue, 0.85), np.full_like(hue, 0.75)]))


def draw_overview(axes, points, trajectory):
    axes.scatter(points["x"], points["y"], s=0.15, c=colours(points), linewidths=0, rasterized=True)
    if trajectory is not None:
        axes.plot(trajectory[:, 1], trajectory[:, 2], color="black", linewidth=0.8)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


def draw_detail(axes, points, x, y, size):
    inside = (np.abs(points["x"] - x) < size / 2) & (np.abs(points["y"] - y) < size / 2)
    near = points[inside]
    axes.quiver(
        near["x"], near["y"], near["nx"], near["ny"], color=colours(near), scale=25, width=0.003
    )
    axes.scatter(near["x"], near["y"], s=4, c=colours(near), linewidths=0)
    axes.set_aspect("equal")
    axes.set_title(f"{size:g} m close-up: points and their normals", fontsize=9)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("map")
    parser.add_argument("picture")
    parser.add_argument("--trajectory")
    parser.add_argument("--heights", type=float, nargs=2, default=[-np.inf, np.inf])
    parser.add_argument("--detail", type=float, nargs=3, metavar=("X", "Y", "SIZE"))
    arguments = parser.parse_args()

    points = read_ply(arguments.map)
    lowest, highest = arguments.heights
    is_wall = np.abs(points["nz"]) < MAX_WALL_NORMAL_Z
    points = points[is_wall & (points["z"] >= lowest) & (points["z"] <= highest)]
    trajectory = np.loadtxt(arguments.trajectory, ndmin=2) if arguments.trajectory else None

    panels = 2 if arguments.detail else 1
    figure, axes = plt.subplots(1, panels, figsize=(6 * panels, 6), squeeze=False)
    draw_overview(axes[0, 0], points, trajectory)
    if arguments.detail:
        x, y, size = arguments.detail
        corner = (x - size / 2, y - size / 2)
        axes[0, 0].add_patch(Rectangle(corner, size, size, fill=False, linewidth=0.8))
        draw_detail(axes[0, 1], points, x, y, size)
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=110)


if __name__ == "__main__":
    main()
