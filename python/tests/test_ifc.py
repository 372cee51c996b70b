# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Walls as IFC, read back by ifcopenshell."""

import json

import numpy as np
import pytest
from support import nvm as program

ifcopenshell = pytest.importorskip("ifcopenshell")

from nvm.ifc import rotation_to_z, write_ifc  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")


def wall_of(tilt=None):
    """A wall of 80 mm along (0.8, 0.6), 4 m long and 2.5 m high, with a door of 0.9 by 2 m."""
    tilt = np.eye(3) if tilt is None else tilt
    along, up = np.array([0.8, 0.6, 0.0]), np.array([0.0, 0.0, 1.0])
    normal = np.cross(along, up)

    def rectangle(origin, width, height):
        corners = [(0, 0), (width, 0), (width, height), (0, height)]
        return [list(tilt @ (origin + a * along + b * up)) for a, b in corners]

    origin = np.array([10.0, -3.0, 0.2])
    faces = [
        {"normal": list(tilt @ (sign * normal)), "polygon": rectangle(origin - shift * normal, 4.0, 2.5)}
        for sign, shift in ((1.0, 0.0), (-1.0, 0.08))
    ]
    door = {"kind": "door", "width": 0.9, "height": 2.0, "polygon": rectangle(origin + 1.5 * along, 0.9, 2.0)}
    return {
        "kind": "wall", "thickness": 0.08, "thickness_std": 0.0004, "passes": "one", "bent": False, "area": 8.2,
        "faces": faces, "openings": [door],
    }  # fmt: skip


def slab():
    outline = [[0.0, 0.0, 3.0], [5.0, 0.0, 3.0], [5.0, 4.0, 3.0], [2.0, 4.0, 3.0], [0.0, 2.0, 3.0]]
    return {
        **wall_of(), "kind": "slab", "thickness": 0.2, "openings": [],
        "faces": [{"normal": [0.0, 0.0, 1.0], "polygon": outline}, {"normal": [0.0, 0.0, -1.0], "polygon": outline}],
    }  # fmt: skip


def survey_of(*walls, up=(0.0, 0.0, 1.0)):
    return {"walls": list(walls), "bodies": [], "up": list(up)}


def solid_of(path, ifc_class):
    """Vertices (N, 3) [m] and volume [m^3] of the only product of that class, in the frame of the model."""
    import ifcopenshell.geom

    model = ifcopenshell.open(path)
    (product,) = model.by_type(ifc_class)
    settings = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    shape = ifcopenshell.geom.create_shape(settings, product).geometry
    vertices = np.reshape(shape.verts, (-1, 3))
    a, b, c = (vertices[np.reshape(shape.faces, (-1, 3))[:, i]] for i in range(3))
    return vertices, abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0


def test_a_wall_has_its_faces_its_thickness_and_its_door(tmp_path):
    written = write_ifc(survey_of(wall_of()), tmp_path / "walls.ifc")
    assert written == {"IfcWall": 1, "IfcDoor": 0, "IfcSlab": 0, "IfcOpeningElement": 1, "left out": 0}
    model = ifcopenshell.open(tmp_path / "walls.ifc")
    (wall,) = model.by_type("IfcWall")
    assert wall.HasOpenings[0].RelatedOpeningElement.is_a("IfcOpeningElement")
    vertices, volume = solid_of(tmp_path / "walls.ifc", "IfcWall")
    corners = np.concatenate([np.array(face["polygon"]) for face in wall_of()["faces"]])
    for corner in corners:
        assert np.linalg.norm(vertices - corner, axis=1).min() < 1e-6
    assert volume == pytest.approx(0.08 * (4.0 * 2.5 - 0.9 * 2.0), abs=1e-6)
    pset = wall.IsDefinedBy[0].RelatingPropertyDefinition
    values = {p.Name: p.NominalValue.wrappedValue for p in pset.HasProperties}
    assert values["Thickness"] == pytest.approx(0.08) and values["Passes"] == "one"


def test_what_is_up_in_a_tilted_map_is_up_in_the_model(tmp_path):
    up = np.array([0.1, -0.2, 0.97]) / np.linalg.norm([0.1, -0.2, 0.97])
    tilt = rotation_to_z(up).T
    write_ifc(survey_of(wall_of(tilt), up=up), tmp_path / "walls.ifc")
    vertices, _ = solid_of(tmp_path / "walls.ifc", "IfcWall")
    assert vertices[:, 2].min() == pytest.approx(0.2, abs=1e-6)
    assert vertices[:, 2].max() == pytest.approx(2.7, abs=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_slab_lies_behind_its_first_face(tmp_path, sign):
    level = slab()
    level["faces"][0]["normal"] = [0.0, 0.0, sign]
    write_ifc(survey_of(level), tmp_path / "walls.ifc")
    vertices, volume = solid_of(tmp_path / "walls.ifc", "IfcSlab")
    assert volume == pytest.approx(0.2 * 18.0, abs=1e-6)
    middle = 3.0 - sign * 0.1
    assert vertices[:, 2].min() == pytest.approx(middle - 0.1) and vertices[:, 2].max() == pytest.approx(middle + 0.1)


def test_the_command_and_what_it_leaves_out(tmp_path):
    sloped = {**wall_of(), "kind": "sloped"}
    door = {**wall_of(), "kind": "door", "openings": []}
    (tmp_path / "walls.json").write_text(json.dumps(survey_of(sloped, door)))
    done = program("ifc", tmp_path / "walls.json")
    assert done.returncode == 0, done.stderr
    assert "1 IfcDoor" in done.stdout and "1 left out" in done.stdout
    assert len(ifcopenshell.open(tmp_path / "walls.ifc").by_type("IfcDoor")) == 1
    (tmp_path / "other.json").write_text("[]")
    done = program("ifc", tmp_path / "other.json")
    assert done.returncode == 1 and "is not a walls.json" in done.stderr and done.stderr.count("\n") == 1
