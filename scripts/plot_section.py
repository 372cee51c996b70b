#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Draws upright cross-sections of a map beside the faces that `nvm walls` found in it, each point in the
colour of the side it faces.

usage: plot_section.py MAP.ply WALLS.json PICTURE.png [--at Y] [--thickness M] [--detail X Z SIZE]

The section is across y, at --at, of all points within half of --thickness [m]. Up is that of the
survey. --detail adds a close-up of SIZE x SIZE m around (X, Z).
"""

import argparse
import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from plot_map import read_ply


def levelled(up):
    """The least rotation that takes `up` to z."""
    v = np.cross(up, [0.0, 0.0, 1.0])
    skew = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return np.eye(3) + skew + skew @ skew / (1.0 + up[2])


def cut(polygon, y):
    """Where the outline of a face crosses y, in pairs: x and z."""
    crossings = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0)):
        if (a[1] < y) != (b[1] < y):
            crossings.append(a + (y - a[1]) / (b[1] - a[1]) * (b - a))
    crossings.sort(key=lambda p: (p[0], p[2]))
    return np.array(crossings)[:, [0, 2]].reshape(-1, 2, 2) if crossings else []


def draw(axes, points, normals, faces, y):
    facing = np.where(np.abs(normals[:, 0]) > np.abs(normals[:, 2]), normals[:, 0], normals[:, 2])
    colours = np.where(facing > 0.0, "tab:orange", "tab:blue")
    axes.scatter(points[:, 0], points[:, 2], s=0.8, c=colours, linewidths=0, rasterized=True)
    for polygon in faces:
        for line in cut(polygon, y):
            axes.plot(line[:, 0], line[:, 1], color="black", linewidth=0.7)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m]")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("map")
    parser.add_argument("walls")
    parser.add_argument("picture")
    parser.add_argument("--at", type=float, default=0.0)
    parser.add_argument("--thickness", type=float, default=1.0)
    parser.add_argument("--detail", type=float, nargs=3, metavar=("X", "Z", "SIZE"))
    arguments = parser.parse_args()

    with open(arguments.walls, encoding="utf-8") as file:
        survey = json.load(file)
    turn = levelled(np.array(survey["up"])).T
    cloud = read_ply(arguments.map)
    points = np.column_stack([cloud[axis] for axis in ("x", "y", "z")]) @ turn
    normals = np.column_stack([cloud[axis] for axis in ("nx", "ny", "nz")]) @ turn
    inside = np.abs(points[:, 1] - arguments.at) < 0.5 * arguments.thickness
    points, normals = points[inside], normals[inside]
    listed = survey["faces"] + [face for wall in survey["walls"] + survey["bodies"] for face in wall["faces"]]
    faces = [np.array(polygon) @ turn for face in listed for polygon in [face["polygon"], *face["parts"]]]

    panels = 2 if arguments.detail else 1
    ratios = {"width_ratios": [2.2, 1.0][:panels]}
    figure, axes = plt.subplots(1, panels, figsize=(4.6 * panels, 3.2), squeeze=False, gridspec_kw=ratios)
    draw(axes[0, 0], points, normals, faces, arguments.at)
    if arguments.detail:
        x, z, size = arguments.detail
        draw(axes[0, 1], points, normals, faces, arguments.at)
        axes[0, 1].set_xlim(x - size / 2, x + size / 2)
        axes[0, 1].set_ylim(z - size / 2, z + size / 2)
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=90)


if __name__ == "__main__":
    main()
