"""Advice about a magic or module that a cell does not find, before and after `%load_ext rosmini`."""

import pytest

from rosmini.notebook import unknown_magics

from .conftest import Notebook


@pytest.fixture
def bare(shell, capsys):
    """A notebook in a kernel of `rosmini lab`, before its first cell."""
    unknown_magics.load_ipython_extension(shell)
    return Notebook(shell, capsys)


@pytest.mark.parametrize("cell", ["%rostopic list", "%roscore", "%%node a.py\npass", "%%terminal\nls"])
def test_before_rosmini_is_loaded_its_magics_say_what_to_run(bare, cell):
    name = cell.split(maxsplit=1)[0]
    assert f"{name} comes with rosmini: run `%load_ext rosmini`" in bare.fails(cell)


@pytest.mark.parametrize("package", ["rospy", "sensor_msgs"])
def test_before_rosmini_is_loaded_the_modules_of_ros_say_what_to_run(bare, package):
    missing = f"raise ModuleNotFoundError(name='{package}.msg')"  # a computer with ROS has the module
    assert f"{package} comes with rosmini: run `%load_ext rosmini`" in bare.fails(missing)
    assert "load_ext" not in bare.fails("import numpyy")
    bare.ok("%load_ext rosmini")
    assert "load_ext" not in bare.fails(missing)


@pytest.mark.parametrize(("cell", "meant"), [("%rostopc list", "%rostopic"), ("%%nod a.py\npass", "%%node")])
def test_a_mistyped_magic_is_answered_with_the_nearest(notebook, cell, meant):
    written = notebook.fails(cell)
    assert written.count(f"did you mean {meant}") == 1
    assert "load_ext" not in written


@pytest.mark.parametrize(
    "cell",
    [
        "%rosrun notebook a.py",
        "%roslaunch notebook a.launch",
        "from notebook.msg import Order",
        "%rosmsg show notebook/A",
    ],
)
def test_what_an_earlier_cell_writes_is_asked_for(notebook, cell):
    assert "run them first" in notebook.fails(cell)
    notebook.ok("%%msg Other\nbool fragile")
    assert "run them first" in notebook.fails(cell)


@pytest.mark.parametrize(
    ("cell", "hint"),
    [
        ("check('stop')", "the cell near the top of the chapter that imports `check` has not run: run it first"),
        ("rosmini.wait(1)", "that imports `rosmini` has not run"),
        ("print(total)", "if a cell above defines `total`, run that cell first"),
    ],
)
def test_a_cell_that_runs_too_early_says_which_cell_to_run(bare, cell, hint):
    assert hint in bare.fails(cell)


def test_other_name_errors_are_left_alone(notebook):
    assert "run" not in notebook.fails("def f():\n    print(x)\n    x = 1\nf()")
    assert "above" not in notebook.fails("raise NameError('no parameter a')")


def test_reloading_says_which_nodes_end(notebook):
    assert notebook.ok("%reload_ext rosmini") == ""
    notebook.ok("%%node talker.py\nimport rospy\nrospy.init_node('talker')\nrospy.spin()")
    assert "/talker" in notebook.ok("%reload_ext rosmini")
    assert notebook.session.graph.nodes.keys() <= {"/rosout"}
