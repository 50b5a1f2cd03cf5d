"""Advice about a magic that IPython does not find, before and after `%load_ext rosmini`."""

from __future__ import annotations

from typing import Any

import pytest

from rosmini.notebook import unknown_magics

from .conftest import Notebook


@pytest.fixture
def bare(shell: Any, capsys: pytest.CaptureFixture[str]) -> Notebook:
    """A notebook in a kernel of `rosmini lab`, before its first cell."""
    unknown_magics.load_ipython_extension(shell)
    return Notebook(shell, capsys)


@pytest.mark.parametrize("cell", ["%rostopic list", "%roscore", "%%node a.py\npass", "%%terminal\nls"])
def test_before_rosmini_is_loaded_its_magics_say_what_to_run(bare: Notebook, cell: str) -> None:
    name = cell.split(maxsplit=1)[0]
    assert f"{name} comes with rosmini: run `%load_ext rosmini`" in bare.fails(cell)


def test_a_mistyped_magic_before_rosmini_is_loaded(bare: Notebook) -> None:
    written = bare.fails("%rostopc list")
    assert "did you mean %rostopic?" in written
    assert "%load_ext rosmini" in written


@pytest.mark.parametrize(("cell", "meant"), [("%rostopc list", "%rostopic"), ("%%nod a.py\npass", "%%node")])
def test_a_mistyped_magic_is_answered_with_the_nearest(notebook: Notebook, cell: str, meant: str) -> None:
    written = notebook.fails(cell)
    assert written.count(f"did you mean {meant}") == 1
    assert "load_ext" not in written


@pytest.mark.parametrize("cell", ["%xyzzy", "1 / 0", "%load_ext nosuch"])
def test_other_errors_get_no_advice(bare: Notebook, cell: str) -> None:
    assert "rosmini:" not in bare.fails(cell)


def test_reloading_says_which_nodes_end(notebook: Notebook) -> None:
    assert notebook.ok("%reload_ext rosmini") == ""
    notebook.ok("%%node talker.py\nimport rospy\nrospy.init_node('talker')\nrospy.spin()")
    assert "/talker" in notebook.ok("%reload_ext rosmini")
    assert notebook.session.graph.nodes.keys() <= {"/rosout"}
