"""``.cfg`` files: the shapes that are published, what is wrong in others, and that nothing in them is ever run."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.dynamic_reconfigure import Description
from rosmini.core.errors import DefinitionError
from rosmini.ros.catkin.cfg_file import MAX_BYTES, CfgFile, read_cfg

HEAD = """#!/usr/bin/env python3
PACKAGE = "robot"
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
"""
END = 'exit(gen.generate(PACKAGE, "node", "Robot"))\n'

PLANNER = '''#!/usr/bin/env python
"""Limits of a local planner."""
PACKAGE = 'robot'

from math import pi
import math

from dynamic_reconfigure.parameter_generator_catkin import ParameterGenerator, double_t, bool_t, int_t

gen = ParameterGenerator()
gen.add("max_vel_x", double_t, 0, "Greatest speed ahead, in m/s", 0.22, 0)
gen.add("max_rot_vel", double_t, 0, "Greatest turn rate, in rad/s", 2 * pi / 3, 0, 2 * pi)
gen.add("heading", double_t, 1 << 3, "Direction", default=0, min=-math.pi, max=math.pi)

goal = gen.add_group("Goal tolerance", type="tab", state=False)
goal.add("xy_goal_tolerance", double_t, 2, "Distance, in m", 0.1)
inner = goal.add_group("Turning")
inner.add("latch", bool_t, 4, "Whether a goal once reached stays so", True)
gen.add("vx_samples", int_t, 0, "How many speeds are tried", 3, 1)

exit(gen.generate(PACKAGE, "planner", "Robot"))
'''

CAMERA = """#! /usr/bin/env python
# A camera's driver
PACKAGE='robot'
import roslib; roslib.load_manifest(PACKAGE)

from driver_base.msg import SensorLevels
from dynamic_reconfigure.parameter_generator import *

gen = ParameterGenerator()

modes = gen.enum([gen.const("mono8", str_t, "mono8", "grey"),
                  gen.const("rgb8",  str_t, "rgb8",  "colours"),],
                 "How pixels are coded")
no_auto = gen.const("Off", int_t, 0, "By hand")
auto = gen.enum([no_auto, gen.const("Once", int_t, 1, "Now"), gen.const("Always", int_t, 2, "All the time")], "Who")
gen.const("GAMMA", double_t, 2.2, "A constant of no enumeration")
gen.const("DEBUG", bool_t, False, "Another one")

#       name       type      level                          description  default  min  max
gen.add("encoding", str_t, SensorLevels.RECONFIGURE_STOP, "Pixels", "mono8", edit_method = modes)
gen.add("auto_gain", int_t, SensorLevels.RECONFIGURE_RUNNING, "Who sets the gain", 1, 0, 2, auto)
gen.add("frame_id", str_t, SensorLevels.RECONFIGURE_CLOSE, "The camera's frame", "camera")

exit(gen.generate(PACKAGE, "driver_of_camera", "Robot"))
"""


def read(text: str) -> CfgFile:
    with TemporaryDirectory() as folder:
        path = Path(folder, "Robot.cfg")
        path.write_text(text, encoding="utf-8", newline="")
        return read_cfg(path)


def described(text: str) -> Description:
    return Description.of(read(text).tree)


def test_a_planner() -> None:
    found = described(PLANNER)
    assert found.defaults == {
        "max_vel_x": 0.22,
        "max_rot_vel": 2 * math.pi / 3,
        "heading": 0.0,
        "vx_samples": 3,
        "xy_goal_tolerance": 0.1,
        "latch": True,
    }
    assert found["max_vel_x"].max == math.inf
    assert found["heading"].min == -math.pi
    assert found["heading"].level == 8
    assert found["vx_samples"].max == 2**31 - 1
    rows = [(each.name, each.type, each.state, each.id, each.parent) for each in found.groups]
    assert rows == [("Default", "", True, 0, 0), ("Goal_tolerance", "tab", False, 1, 0), ("Turning", "", True, 2, 1)]


def test_a_camera() -> None:
    found = read(CAMERA)
    assert found.constants == {
        "mono8": "mono8", "rgb8": "rgb8", "Off": 0, "Once": 1, "Always": 2, "GAMMA": 2.2, "DEBUG": False,
    }  # fmt: skip
    by_name = Description.of(found.tree)
    assert [by_name[name].level for name in ("encoding", "auto_gain", "frame_id")] == [1, 0, 3]
    assert "'enum_description': 'Who'" in by_name["auto_gain"].edit_method
    assert (found.name, found.notes) == ("Robot", [])


def test_what_comes_after_exit_is_not_read() -> None:
    assert read(HEAD + END + "import socket\n").name == "Robot"


def test_a_list_may_be_calculated() -> None:
    text = 'gen.enum([gen.const("M%d" % i, int_t, i, "mode") for i in range(3)], "modes")\n'
    assert read(HEAD + text + END).constants == {"M0": 0, "M1": 1, "M2": 2}


def test_a_default_out_of_its_range_is_limited_and_noted_as_servers_do() -> None:
    found = read(HEAD + 'gen.add("count", int_t, 0, "How many", 0, 1, 9)\n' + END)
    assert Description.of(found.tree).defaults == {"count": 1}
    [(note, line)] = found.notes
    assert line == 5 and "count" in note and "1 ... 9" in note


WRONG = [
    ("import os\n", "import os is not understood; a .cfg file is read and not run"),
    ('__import__("os").system("true")\n', "is not understood|there is no|not allowed"),
    ("from os import system\n", "from os import ... is not understood"),
    ("from local_limits import add_all\n", "from local_limits import ... is not understood"),
    ("for i in range(3):\n    pass\n", "the statement `for i in range(3):` is not understood"),
    ("def more(gen):\n    pass\n", "the statement `def more(gen):` is not understood"),
    ("gen.name = 1\n", "the statement `gen.name = 1` is not understood"),
    ("gen.__class__\n", "two underscores"),
    ('gen.ad("x", int_t, 0, "")\n', "did you mean add?"),
    ('gen.add("x", int_tt, 0, "")\n', "did you mean int_t?"),
    ('gen.add("x", "float", 0, "")\n', "parameter x has the type 'float'; types are bool, int, str, double"),
    ('gen.add("x", int_t, 0, "", 1.5)\n', "parameter x has the type int and cannot be set to the float 1.5"),
    ('gen.add("x", int_t, 0, "", True)\n', "cannot be set to the bool True"),
    ('gen.add("x", int_t, 0, "", 2**31)\n', "does not fit into the 32 bits"),
    ('gen.add("x", int_t, "", "")\n', "the level of x is a number of 32 bits, not ''"),
    ('gen.add("x", int_t, 2**32, "")\n', "the level of x is a number of 32 bits"),
    ('gen.add("x", int_t, 0)\n', "missing 1 required positional argument: 'description'"),
    ('gen.add("x", int_t, 0, 5)\n', "the description of the parameter x is a text, not 5"),
    ('gen.add("a b", int_t, 0, "")\n', "the name of a parameter begins with a letter"),
    ('gen.add("groups", int_t, 0, "")\n', "cannot be named groups"),
    ('gen.add("x", str_t, 0, "", "a", "a", "b")\n', "x is a str_t, which has no minimum"),
    ('gen.add("x", double_t, 0, "", 0, 2, 1)\n', "the minimum of x, 2.0, is above its maximum, 1.0"),
    ('gen.add("x", double_t, 0, "", float("nan"))\n', "a value of x is not a number"),
    ('gen.const("x", int_t, 0, "it\'s")\n', "cannot have quotes"),
    ('gen.const("x", int_t, "0", "")\n', "cannot be set to the str '0'"),
    ('gen.enum([], "")\n', "takes a list of what gen.const() gives"),
    ('gen.enum([{"type": "int"}], "")\n', "takes a list of what gen.const() gives, and nothing else"),
    (
        'gen.enum([gen.const("a", int_t, 0, ""), gen.const("b", str_t, "", "")], "")\n',
        "the constants of an enumeration are of one type",
    ),
    ("other = ParameterGenerator()\n", "a second ParameterGenerator()"),
    ("x = 10 ** 10 ** 10\n", "a whole number of more than"),
    ('x = "a" * 10 ** 9\n', "a value of more than"),
    ("x = [i for i in range(10**9)]\n", "range() of 1000000000|elements|too many steps"),
]


@pytest.mark.parametrize(("text", "message"), WRONG)
def test_what_is_wrong_is_told_with_its_line(text: str, message: str) -> None:
    with pytest.raises(DefinitionError) as caught:
        read(HEAD + text + END)
    assert caught.value.line == 5
    assert any(part in caught.value.message for part in message.split("|")), caught.value.message


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("print 'x'\n", 1, "this is not Python 3"),
        ("x = " + "(" * 5000 + ")" * 5000, None, "this is not Python 3"),
        ("\0", None, "this is not Python 3"),
        (HEAD, None, "the file makes nothing"),
        ("gen.add()\n", 1, "there is no 'gen'"),
        (HEAD + 'gen.add("x", int_t, 0, "")\n' * 2 + END, 6, "the parameter x already exists, in line 5"),
        (
            HEAD + 'a = gen.add_group("G")\nb = gen.add_group("G")\n' + END,
            6,
            "the group G already exists, in line 5",
        ),
        (HEAD + 'gen.generate(PACKAGE, "n", "A")\n' + END, 6, "generate() was called before, in line 5"),
        (HEAD + 'gen.generate(PACKAGE, "n", "../A")\n', 5, "a module cannot be named '../A'"),
        (HEAD + 'g = gen.add_group("g")\n' + "".join(
            f'g = g.add_group("g{number}")\n' for number in range(30)), 25, "groups are nested deeper than 20"),
        (HEAD + "".join(f'gen.const("c{number}", int_t, 0, "")\n' for number in range(2100)), 2004,
         "more than 2000 parameters, groups and constants"),
        (HEAD + 't = "a" * 900000\n' + "".join(
            f'gen.add("x{number}", str_t, 0, t)\n' for number in range(9)), None, "too many steps"),
        ("#" * (MAX_BYTES + 1), None, "cannot be read"),
    ],
)  # fmt: skip
def test_files_that_are_wrong_as_a_whole(text: str, line: int | None, message: str) -> None:
    with pytest.raises(DefinitionError) as caught:
        read(text)
    assert message in caught.value.message
    assert line is None or caught.value.line == line


CALLS = (
    "open", "exec", "eval", "os.system", "gen.add", "gen.const", "print", "getattr", "gen.add.call", "Spy",
)  # fmt: skip
HOSTILE = st.recursive(
    st.sampled_from(["gen", "PACKAGE", "int_t", "1", "'x'", "[]", "().__class__", "Spy", "gen.__init__"]),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(CALLS), inner, inner).map(lambda parts: f"{parts[0]}({parts[1]}, {parts[2]})"),
        st.tuples(inner, st.sampled_from("+*%.")).map(lambda parts: f"({parts[0]}) {parts[1]} x"),
        inner.map(lambda text: f"[{text} for x in {text}]"),
        inner.map(lambda text: f"(lambda: {text})()"),
    ),
    max_leaves=6,
)
FORMS = ("{}", "x = {}", "import {}", "from {} import *", "with {} as y: pass", "@{}\ndef f(): pass",
         "class A({}): pass", "assert {}", "raise {}", "x = f'{{{}}}'", "{} if {} else 1")  # fmt: skip


@given(st.lists(st.tuples(st.sampled_from(FORMS), HOSTILE), max_size=4), st.booleans())
def test_nothing_is_ever_run(lines: list[tuple[str, str]], with_head: bool) -> None:
    with TemporaryDirectory() as folder:
        mark = Path(folder, "mark")
        spy = f"(lambda *_: open({str(mark)!r}, 'w').close())"
        text = "\n".join(form.replace("{}", value).replace("Spy", spy) for form, value in lines)
        text += f"\nopen({str(mark)!r}, 'w')\n__import__('os').mkdir({str(mark)!r})\n"
        path = Path(folder, "Robot.cfg")
        path.write_text((HEAD if with_head else "") + text + END, encoding="utf-8")
        with pytest.raises(DefinitionError):
            read_cfg(path)
        assert not mark.exists()
