"""Our reading of ``.cfg`` files beside the real generator, which runs them."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import pytest

from rosmini.ros.catkin.cfg_file import read_cfg

from ..processes import run
from ..ros.catkin.test_cfg_file import CAMERA, PLANNER
from .conftest import SYSTEM_PYTHON, need_ros

need_ros(modules="dynamic_reconfigure.parameter_generator_catkin")

PEER = """
import runpy, sys, types
from dynamic_reconfigure import parameter_generator_catkin as real

def show(self, pkgname, nodename, name):
    print(repr([name, self.replace_infinity(self.group.to_dict()), self.constants]).replace("inf", "1e999"))

real.ParameterGenerator.generate = show
sys.modules["dynamic_reconfigure.parameter_generator"] = real
sys.modules["roslib"] = types.SimpleNamespace(load_manifest=lambda name: None)
sys.modules["driver_base"] = types.ModuleType("driver_base")
import dynamic_reconfigure.msg
sys.modules["driver_base.msg"] = dynamic_reconfigure.msg
path = sys.argv[1]
sys.argv = [path, "a", "b", "c", "d"]
runpy.run_path(path, run_name="__main__")
"""


def plain(tree: dict[str, Any]) -> dict[str, Any]:
    """A group without the lines and files, which the real generator has of itself, and without the names of C++."""
    keys = ("name", "type", "state", "cstate", "id", "parent")
    parameters = [
        {key: value for key, value in each.items() if key not in ("srcline", "srcfile", "edit_method")}
        for each in tree["parameters"]
    ]
    enums = [ast.literal_eval(each["edit_method"]) for each in tree["parameters"] if each["edit_method"]]
    for enum in enums:
        for constant in enum["enum"]:
            del constant["srcline"]
    groups = [plain(each) for each in tree["groups"]]
    return {**{key: tree[key] for key in keys}, "parameters": parameters, "enums": enums, "groups": groups}


@pytest.mark.parametrize("text", [PLANNER, CAMERA], ids=["planner", "camera"])
def test_the_same_groups_parameters_and_constants(tmp_path: Path, text: str) -> None:
    path = tmp_path / "Robot.cfg"
    path.write_text(text, encoding="utf-8")
    done = run([SYSTEM_PYTHON, "-c", PEER, path], check=True)
    name, tree, constants = ast.literal_eval(done.stdout.splitlines()[-1])
    ours = read_cfg(path)
    assert ours.name == name
    assert plain(ours.tree) == plain(tree)
    assert ours.constants == {each["name"]: each["value"] for each in constants}
