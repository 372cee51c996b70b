# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The report of an evaluation: figures, pictures, and what lacks."""

import json
import subprocess
import sys
import xml.dom.minidom
from html.parser import HTMLParser

import numpy as np
import pytest

pytest.importorskip("jinja2")
pytest.importorskip("matplotlib")
from sequences import write_sequence
from support import nvm

from nvm.cli import main
from nvm.report import file_name, write_report
from nvm.report.charts import drawn


def statistics(value):
    return {"count": 9, "rmse": value, "mean": value, "median": value, "max": 2 * value}


def relative(value):
    return {"translation_m": statistics(value), "rotation_deg": statistics(value)}


def wall(name, thickness, true=50.0, seen=True):
    error = None if thickness is None or true is None else thickness - true
    return {
        "name": name,
        "seen": seen,
        "true_thickness_mm": true,
        "thickness_mm": thickness,
        "error_mm": error,
        "error_percent": None if error is None else 100 * error / true,
    }


def run(name, thickness, sides="by normal"):
    return {
        "name": name,
        "trajectory": {
            "poses": 91,
            "unmatched_poses": 2,
            "ate_m": statistics(0.0123),
            "rpe_per_frame": relative(0.001),
            "rpe_per_second": relative(0.002),
            "rpe_per_metre": {"translation_m": None, "rotation_deg": None},
        },
        "map": {
            "points": 1234,
            "sides": sides,
            "crispness": None,
            "wall_summary": {"seen": 2, "measured": 1, "absolute_error_mm": statistics(1.5), "side_purity": None},
            "walls": [wall("thin & free", thickness), wall("hidden", None, seen=False)],
            "regions": [wall("box", 74.6, true=None)],
        },
        "cpu": {"map_update_ms": {"mean": 1.25, "max": 3.5}},
    }


def drawing_of(runs, rng):
    def points(thickness):
        side = rng.integers(0, 2, 300)
        return np.column_stack([rng.uniform(-1, 1, 300), (0.5 - side) * thickness, side]).tolist()

    def drawn_run(run):
        section = points(0.05) if run["map"]["walls"][0]["thickness_mm"] else []
        path = np.column_stack([np.linspace(0, 5, 91), np.zeros(91)]).tolist()
        return {"path": path, "errors": path, "walls": [section, []], "regions": [points(0.07)]}

    return {"truth": {"path": [[0, 0], [5, 0]], "walls": [[[1, 1], [2, 1]]]}, "runs": list(map(drawn_run, runs))}


@pytest.fixture
def folder(tmp_path, rng):
    """What an evaluation of three runs leaves, of which one has no map at all."""
    runs = [run("mine", 49.0), run("<b>other</b>", None, "by position"), run("bare", 49.0)]
    drawing = drawing_of(runs, rng)
    runs[2]["map"], drawing["runs"][2]["walls"], drawing["runs"][2]["regions"] = None, [], []
    (tmp_path / "evaluation.json").write_text(json.dumps({"runs": runs}))
    (tmp_path / "drawing.json").write_text(json.dumps(drawing))
    return tmp_path


class Page(HTMLParser):
    """The rows of the tables, and what the page loads."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.loads, self._is_in_cell = [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")
            self._is_in_cell = True
        self.loads += [value for name, value in attributes if name in ("src", "href", "xlink:href")]

    def handle_endtag(self, tag):
        self._is_in_cell = self._is_in_cell and tag not in ("td", "th")

    def handle_data(self, data):
        if self._is_in_cell:
            self.rows[-1][-1] += data.strip()


def test_figures_and_pictures_stand_in_one_page(folder):
    names = [path.name for path in write_report(folder)]
    assert names == ["report.html", "wall_box.svg", "wall_thin___free.svg"]
    text = (folder / "report.html").read_text()
    page = Page(text)
    assert ["", "mine", "<b>other</b>", "bare"] in page.rows
    assert ["ATE RMSE [mm]", "12.30", "12.30", "12.30"] in page.rows
    assert ["RPE RMSE per second", "2.00 mm, 0.002°", "2.00 mm, 0.002°", "2.00 mm, 0.002°"] in page.rows
    assert ["map points", "1234", "1234", "–"] in page.rows
    assert ["thin & free: 50.0", "49.00 (-1.00 mm, -2.0 %)", "not found", "–"] in page.rows
    assert ["hidden: 50.0", "not seen from both sides", "not seen from both sides", "–"] in page.rows
    assert ["box: –", "74.60", "74.60", "–"] in page.rows
    assert ["CPU per scan, mean (max) [ms]: map update", *3 * ["1.25 (3.50)"]] in page.rows
    assert not [row for row in page.rows if row and row[0] in ("RPE RMSE per metre", "crispness: mean map entropy")]
    assert "<b>other" not in text and all(link.startswith(("#", "data:")) for link in page.loads)
    for run_index in range(3):  # which its button hides
        assert text.count(f'id="path-run-{run_index}"') == text.count(f'id="error-run-{run_index}"') == 1
    for name in names[1:]:
        xml.dom.minidom.parse(str(folder / name))


def test_the_same_evaluation_gives_the_same_bytes(folder):
    first = {path: path.read_bytes() for path in write_report(folder)}
    assert all(path.read_bytes() == first[path] for path in write_report(folder))


def test_without_a_truth_there_are_no_trajectories(folder):
    evaluation = json.loads((folder / "evaluation.json").read_text())
    drawing = json.loads((folder / "drawing.json").read_text())
    drawing["truth"] = None
    for run_of, drawn_of in zip(evaluation["runs"], drawing["runs"]):
        run_of["trajectory"] = drawn_of["path"] = drawn_of["errors"] = None
    (folder / "evaluation.json").write_text(json.dumps(evaluation))
    (folder / "drawing.json").write_text(json.dumps(drawing))
    text = write_report(folder)[0].read_text()
    assert "Trajectories" not in text and "ATE" not in text and "Regions" in text


def test_the_worst_walls_are_drawn():
    errors = [1.0, None, *np.linspace(2.0, 4.0, 20)]
    walls = [wall(str(i), None if e is None else 50 + e) for i, e in enumerate(errors)]
    evaluation = {"runs": [{"map": {"walls": walls, "regions": []}}]}
    assert drawn(evaluation, "walls") == [1, *range(11, 22)]


def test_what_is_no_evaluation_is_named(folder):
    (folder / "drawing.json").write_text('{"truth": null}')
    with pytest.raises(RuntimeError, match="another version"):
        write_report(folder)
    (folder / "drawing.json").write_text("{")
    with pytest.raises(RuntimeError, match="drawing.json: is not JSON"):
        write_report(folder)
    (folder / "drawing.json").unlink()
    with pytest.raises(RuntimeError, match="drawing.json: is missing"):
        write_report(folder)


def test_it_is_drawn_without_the_compiled_package_too(folder):
    import nvm as package

    code = "import sys; sys.modules['nvm'] = None; import runpy; runpy.run_module('report', run_name='__main__')"
    environment = {"PYTHONPATH": package.__path__[0], "PATH": ""}
    done = subprocess.run([sys.executable, "-c", code, folder], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0] == str(folder / "report.html")


def test_the_command_evaluates_and_draws(tmp_path, rng):
    sequence = write_sequence(tmp_path / "walk", rng)
    done = nvm("evaluate", sequence / "groundtruth.tum", "--truth", sequence, "--out", tmp_path / "report")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == str(tmp_path / "report" / "report.html")
    page = Page((tmp_path / "report" / "report.html").read_text())
    assert ["ATE RMSE [mm]", "0.00"] in page.rows
    (tmp_path / "report" / "report.html").unlink()
    assert nvm("plot", tmp_path / "report").returncode == 0
    assert (tmp_path / "report" / "report.html").is_file()


def test_an_evaluation_becomes_a_recording(folder, tmp_path):
    rerun = pytest.importorskip("rerun")
    assert main(["view", str(folder), "--record", str(tmp_path / "seen.rrd")]) == 0
    data = (tmp_path / "seen.rrd").read_bytes()
    parts = ["/world/truth/path", "/world/truth/walls", "/world/runs/mine", "/errors/bare", "/walls/0/mine", "/walls/1/mine"]
    other = rerun.escape_entity_path_part("<b>other</b>")
    for entity in (*parts, "/walls/0/true faces".replace(" ", "\\ "), f"/world/runs/{other}", f"/walls/1/{other}"):
        assert entity.encode() in data, entity
    assert b"/walls/2" not in data and f"/walls/0/{other}".encode() not in data  # hidden, and not found
    (folder / "drawing.json").write_text('{"truth": null}')
    assert main(["view", str(folder), "--record", str(tmp_path / "old.rrd")]) == 1


def test_an_evaluation_without_a_truth_becomes_one_too(folder, tmp_path):
    pytest.importorskip("rerun")
    drawing = json.loads((folder / "drawing.json").read_text())
    drawing["truth"] = None
    for drawn_of in drawing["runs"]:
        drawn_of["path"] = drawn_of["errors"] = None
    (folder / "drawing.json").write_text(json.dumps(drawing))
    assert main(["view", str(folder), "--record", str(tmp_path / "seen.rrd")]) == 0
    data = (tmp_path / "seen.rrd").read_bytes()
    assert b"/walls/0/mine" in data and b"/world/truth" not in data and b"/errors" not in data


def test_names_become_file_names():
    assert file_name("wall 5/ä.b-c") == "wall_5__.b-c"
