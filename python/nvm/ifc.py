# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Measured walls as IFC, for programs of building design: takes ``pip install 'nvm[ifc]'``."""

from __future__ import annotations

import json
import os

import numpy as np

BEYOND = 0.05  # [m]; openings are cut from beyond both faces, so that no skin is left


def write_ifc(walls, out) -> dict:
    """Write the walls, doors and slabs of a survey as IFC 4.

    Walls and partitions become boxes (IfcWall) between their two faces, with their openings cut out
    (IfcOpeningElement); door leaves IfcDoor, slabs and panels IfcSlab with the outline of their first face. Up is z,
    whatever it is in the map, and lengths are metres. What was measured stands in the property set ``Nvm_Survey``.

    Parameters
    ----------
    walls : dict or path
        What `nvm.survey` returns, or the walls.json that ``nvm walls`` writes.
    out : path
        The file, ``.ifc``.

    Returns
    -------
    dict
        How many of each class were written, and under "left out" how many pairs have no class: sloped ones, columns and
        furniture.

    Raises
    ------
    ImportError
        Without ifcopenshell.
    ValueError
        When `walls` is no list of walls.
    """
    survey = read_survey(walls)
    model = Model()
    upright = rotation_to_z(survey["up"])
    makers = {"wall": model.wall, "partition": model.wall, "door": model.door, "slab": model.slab, "panel": model.slab}
    written = {"IfcWall": 0, "IfcDoor": 0, "IfcSlab": 0, "IfcOpeningElement": 0, "left out": len(survey["bodies"])}
    for index, wall in enumerate(survey["walls"]):
        make = makers.get(wall["kind"])
        if make is None:
            written["left out"] += 1
            continue
        product, openings = make(f"{wall['kind']} {index}", wall, upright)
        model.describe(product, wall)
        written[product.is_a()] += 1
        written["IfcOpeningElement"] += openings
    model.file.write(os.fspath(out))
    return written


def read_survey(walls) -> dict:
    """`walls`, or what its file holds; refuses anything else."""
    name = "walls"
    if isinstance(walls, (str, os.PathLike)):
        name = os.fspath(walls)
        with open(walls, encoding="utf-8") as file:
            try:
                walls = json.load(file)
            except ValueError as error:
                raise ValueError(f"{name}: is not JSON: {error}") from error
    if not isinstance(walls, dict) or not {"walls", "bodies", "up"} <= walls.keys():
        raise ValueError(f"{name}: is not a walls.json of nvm walls")
    return walls


def rotation_to_z(up) -> np.ndarray:
    """The least rotation (3, 3) that takes the unit vector `up` to z."""
    up = np.asarray(up, float)
    if up[2] < -0.999999:
        return np.diag([1.0, -1.0, -1.0])
    v = np.cross(up, [0.0, 0.0, 1.0])
    skew = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return np.eye(3) + skew + skew @ skew / (1.0 + up[2])


class Model:
    """An IFC file with a project, a site, a building and a storey, and what it takes to add to them."""

    def __init__(self):
        import ifcopenshell.api.aggregate
        import ifcopenshell.api.context
        import ifcopenshell.api.feature
        import ifcopenshell.api.geometry
        import ifcopenshell.api.project
        import ifcopenshell.api.pset
        import ifcopenshell.api.root
        import ifcopenshell.api.spatial
        import ifcopenshell.api.unit

        self.api = ifcopenshell.api
        self.file = self.api.project.create_file(version="IFC4")
        project = self.entity("IfcProject", "nvm walls")
        self.api.unit.assign_unit(self.file, length={"is_metric": True, "raw": "METERS"})
        model = self.api.context.add_context(self.file, context_type="Model")
        self.body = self.api.context.add_context(
            self.file, context_type="Model", context_identifier="Body", target_view="MODEL_VIEW", parent=model
        )
        whole = project
        for name in ("Site", "Building", "BuildingStorey"):
            part = self.entity(f"Ifc{name}", name)
            self.api.aggregate.assign_object(self.file, products=[part], relating_object=whole)
            whole = part
        self.storey = whole

    def entity(self, ifc_class: str, name: str):
        return self.api.root.create_entity(self.file, ifc_class=ifc_class, name=name)

    def wall(self, name, wall, upright):
        product = self.box("IfcWall", name, wall, upright)
        frame = frame_of(wall, upright)
        for number, opening in enumerate(wall["openings"]):
            feature = self.entity("IfcOpeningElement", f"{opening['kind']} {number} of {name}")
            low, high = extent(frame, [opening["polygon"]], upright)
            self.shape(feature, frame, low, high, -BEYOND, wall["thickness"] + 2.0 * BEYOND)
            self.api.feature.add_feature(self.file, feature=feature, element=product)
        return product, len(wall["openings"])

    def door(self, name, wall, upright):
        return self.box("IfcDoor", name, wall, upright), 0

    def slab(self, name, wall, upright):
        polygon = np.asarray(wall["faces"][0]["polygon"]) @ upright.T
        looks_up = (upright @ wall["faces"][0]["normal"])[2] > 0.0
        product = self.entity("IfcSlab", name)
        origin = np.eye(4)
        origin[2, 3] = polygon[:, 2].mean() - (wall["thickness"] if looks_up else 0.0)
        shape = self.api.geometry.add_slab_representation(
            self.file, context=self.body, depth=wall["thickness"], polyline=[(p[0], p[1]) for p in polygon.tolist()]
        )
        self.place(product, origin, shape)
        self.contain(product)
        return product, 0

    def box(self, ifc_class, name, wall, upright):
        product = self.entity(ifc_class, name)
        frame = frame_of(wall, upright)
        low, high = extent(frame, [face["polygon"] for face in wall["faces"]], upright)
        self.shape(product, frame, low, high, 0.0, wall["thickness"])
        self.contain(product)
        return product

    def shape(self, product, frame, low, high, offset, thickness):
        """A box from `low` to `high` along the wall and up, from `offset` behind its first face."""
        matrix = frame.copy()
        matrix[:3, 3] += frame[:3, 0] * low[0] + frame[:3, 2] * low[1]
        length, height = (float(x) for x in high - low)
        shape = self.api.geometry.add_wall_representation(
            self.file, context=self.body, length=length, height=height, offset=offset, thickness=thickness
        )
        self.place(product, matrix, shape)

    def place(self, product, matrix, shape):
        self.api.geometry.edit_object_placement(self.file, product=product, matrix=matrix)
        self.api.geometry.assign_representation(self.file, product=product, representation=shape)

    def contain(self, product):
        self.api.spatial.assign_container(self.file, products=[product], relating_structure=self.storey)

    def describe(self, product, wall):
        properties = {
            "Thickness": wall["thickness"],
            "ThicknessStandardUncertainty": wall["thickness_std"],
            "AreaSeenFromBothSides": wall["area"],
            "Passes": wall["passes"],
            "Bent": wall["bent"],
        }
        pset = self.api.pset.add_pset(self.file, product=product, name="Nvm_Survey")
        self.api.pset.edit_pset(self.file, pset=pset, properties=properties)


def frame_of(wall, upright) -> np.ndarray:
    """T_map_wall (4, 4): x along the wall, y from its first face to its second, z up; on the first face."""
    face = wall["faces"][0]
    normal = upright @ face["normal"]
    normal[2] = 0.0
    normal /= np.linalg.norm(normal)
    frame = np.eye(4)
    frame[:3, 0] = np.cross([0.0, 0.0, 1.0], normal)
    frame[:3, 1] = -normal
    # Where the first face is in the middle: the box is upright, the face may lean a little.
    middle = (np.asarray(face["polygon"]) @ upright.T).mean(axis=0)
    frame[:3, 3] = normal * (normal @ middle)
    return frame


def extent(frame, polygons, upright) -> tuple[np.ndarray, np.ndarray]:
    """The least and the greatest coordinates of `polygons` along the wall and up, from the frame's origin."""
    points = np.concatenate([np.asarray(polygon, float) for polygon in polygons]) @ upright.T
    coordinates = (points - frame[:3, 3]) @ frame[:3, [0, 2]]
    return coordinates.min(axis=0), coordinates.max(axis=0)
