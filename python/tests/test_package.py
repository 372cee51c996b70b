# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What editors, help() and an impatient user see of the package."""

import ast
import inspect
import pathlib
import pydoc
import subprocess
import sys

import pytest

import nvm

PUBLIC = [name for name in nvm.__all__ if name != "__version__"]
PACKAGE = pathlib.Path(nvm.__file__).parent


def methods_of(cls):
    return {name for name, member in vars(cls).items() if callable(member) and not name.startswith("_")}


def test_importing_brings_nothing_but_numpy():
    """What would make it slow comes with the command or the function that needs it."""
    code = "import sys, nvm; print(*{name.split('.')[0] for name in sys.modules})"
    imported = set(subprocess.check_output([sys.executable, "-c", code], text=True).split())
    assert not imported & {"rosbags", "mcap", "ruamel", "matplotlib", "jinja2", "rerun", "distributed", "fsspec"}
    assert "numpy" in imported


@pytest.mark.parametrize("name", PUBLIC)
def test_everything_public_is_documented(name):
    thing = getattr(nvm, name)
    assert inspect.getdoc(thing)
    if inspect.isclass(thing):
        assert all(inspect.getdoc(getattr(thing, method)) for method in methods_of(thing)), methods_of(thing)


def test_help_is_enough_to_use_a_map():
    text = pydoc.plain(pydoc.render_doc(nvm.VoxelMap))
    for words in ("voxel_size", "(N, 3) float", "[m]", "Returns", "Raises", "insert(", "nearest(", "within(", "erase_box("):
        assert words in text, words


def test_the_stubs_have_all_that_is_compiled():
    assert (PACKAGE / "py.typed").exists()
    classes = {
        node.name: {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
        for node in ast.parse((PACKAGE / "_nvm.pyi").read_text()).body
        if isinstance(node, (ast.ClassDef, ast.FunctionDef))
    }
    for name in (name for name in PUBLIC if getattr(nvm, name).__module__ == "nvm._nvm"):
        assert name in classes
        assert not inspect.isclass(getattr(nvm, name)) or methods_of(getattr(nvm, name)) <= classes[name]
