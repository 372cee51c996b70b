# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The notebooks of docs/notebooks, each run from its first cell to its last in an empty folder."""

import os
import pathlib
import sys

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")

TESTS = pathlib.Path(__file__).parent
NOTEBOOKS = TESTS.parents[1] / "docs" / "notebooks"
WHAT_HOLDS = {
    "first_map": """
assert voxel_map.stats().two_sided_voxels > 20 and len(nvm.load("wall.nvm")) == len(voxel_map)
assert abs(y[faces_front].mean() - 0.075) < 0.001 and abs(y[~faces_front].mean() - 0.125) < 0.001
""",
    "sides": """
assert np.ptp(y_without) > 0.03
assert np.all(y_with < 0.1)
""",
    "odometry": """
import numpy as np
assert statuses.count("tracking") > 60
moved = results.trajectory.positions[-1] - results.trajectory.positions[0]
assert np.linalg.norm(moved) < 0.05  # once around
""",
    "pipeline": """
assert result.status == "converged" and error < 3.0
assert result_of_wall.degenerate_directions == 3
""",
    "measuring": """
assert [abs(wall["thickness"] - 0.1) < 0.002 for wall in found["walls"]] == [True]
""",
}


def test_there_are_five_without_outputs():
    assert {path.stem for path in NOTEBOOKS.glob("*.ipynb")} == set(WHAT_HOLDS)
    for path in NOTEBOOKS.glob("*.ipynb"):
        notebook = nbformat.read(path, as_version=4)
        nbformat.validate(notebook)
        assert not any(cell.get("outputs") for cell in notebook.cells), path
        assert path.read_text() == nbformat.writes(notebook) + "\n", path


@pytest.mark.filterwarnings("ignore")  # of Jupyter's own
@pytest.mark.parametrize("name", WHAT_HOLDS)
def test_a_notebook_runs(name, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", os.pathsep.join([str(pathlib.Path(sys.executable).parent), os.environ["PATH"]]))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")]))
    notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
    notebook.cells.append(nbformat.v4.new_code_cell(WHAT_HOLDS[name]))
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": tmp_path}}).execute()
