"""Cells that are messages, services, actions and launch files."""

import pytest

from ..conftest import nightly

TALKER = """%%node talker.py
import rospy
from notebook.msg import Num
rospy.init_node("talker")
pub = rospy.Publisher("numbers", Num, queue_size=1, latch=True)
pub.publish(Num(7))
rospy.spin()
"""


def test_a_message_type_of_ones_own(notebook):
    assert notebook.ok("%%msg Num\nint64 num\n") == ""
    assert notebook.ok("from notebook.msg import Num\nprint(Num(num=3))") == "num: 3\n"
    assert notebook.ok("%rosmsg show notebook/Num") == "int64 num\n\n"
    notebook.ok(TALKER)
    assert notebook.ok("%rostopic echo -n 1 /numbers").endswith("num: 7\n---\n")


def test_services_and_actions(notebook):
    notebook.ok("%%srv Add.srv\nint64 a\nint64 b\n---\nint64 sum\n")
    notebook.ok("%%action Dock\nstring station\n---\nbool done\n---\nfloat32 distance\n")
    written = notebook.ok(
        "from notebook.srv import Add, AddResponse\nfrom notebook.msg import DockAction, DockGoal\n"
        "print(AddResponse(sum=4), DockGoal(station='a'))"
    )
    assert written == 'sum: 4 station: "a"\n'


def test_another_definition_is_told_and_taken(notebook):
    notebook.ok("%%msg Num\nint64 num\n")
    notebook.ok("%%msg Pair\nNum a\nNum b\n")
    notebook.ok("from notebook.msg import Num, Pair\nold = Pair(Num(1), Num(2))")
    assert notebook.ok("%%msg Num\nint64 num  # a comment\n") == ""
    assert notebook.ok("from notebook.msg import Num as Same\nprint(Same is Num)") == "True\n"
    assert "notebook/Num is now a different type" in notebook.ok("%%msg Num\nfloat64 value\n")
    written = notebook.ok("from notebook.msg import Num, Pair\nprint(Pair(Num(1.5), Num(2)).a, old.a)")
    assert written == "value: 1.5 num: 1\n"


@pytest.mark.parametrize(
    ("cell", "what"),
    [
        ("%%msg Num\nint64 num\nint65 x\n", "Num.msg:3: "),
        ("%%msg ../Num\nint64 a\n", "is not a file name"),
        ('%%launch a.launch\n<?xml version="1.0"?>\n<launch>\n  <node/>\n</launch>', "a.launch:4: "),
        *nightly(
            ("%%srv Add\nint64 a\n", "Add.srv"),
            ("%%msg num\nint64 a\n", "begin with a capital letter"),
            ("%%msg Num Two\nint64 a\n", "usage: %%msg NAME"),
            ("%%launch a.launch\n<launch>\n  <param/>\n</launch>", "a.launch:3: "),
            ("%%launch a.launch\n<launch>\n", "a.launch:"),
            ("%%launch a.xml\n<launch/>", "call it a.launch"),
        ),
    ],
)
def test_what_is_wrong_is_told_with_the_line_of_the_cell(notebook, cell, what):
    assert what in notebook.fails(cell)
    folder = notebook.session.package.folder
    assert not [path for kind in ("msg", "srv", "launch") for path in (folder / kind).glob("*")]


def test_a_wrong_definition_leaves_the_old_one(notebook):
    notebook.ok("%%msg Num\nint64 num\n")
    notebook.fails("%%msg Num\nint65 num\n")
    assert notebook.ok("from notebook.msg import Num\nprint(Num(1))") == "num: 1\n"


def test_a_launch_file(notebook):
    notebook.ok("%%msg Num\nint64 num\n")
    notebook.ok(TALKER)
    text = '<launch>\n  <arg name="who"/>\n  <node pkg="notebook" type="talker.py" name="$(arg who)"/>\n</launch>\n'
    assert notebook.ok(f"%%launch two.launch\n{text}") == ""
    notebook.ok("%roscore")
    notebook.ok("%roslaunch notebook two.launch who:=anna")
    assert "/anna" in notebook.ok("%rosnode list")


def test_what_a_launch_file_lacks_is_told(notebook):
    written = notebook.ok('%%launch a.launch\n<launch>\n  <include file="$(find nowhere)/x.launch"/>\n</launch>')
    assert written.startswith("WARNING: a.launch:3: ")
    assert "nowhere" in written
    written = notebook.ok("%%launch a.launch\n<launch>\n  <nod/>\n</launch>")
    assert written.startswith("WARNING: a.launch:3: ") and "<nod>" in written and "did you mean node?" in written


def test_a_launch_file_may_include_others_of_its_folder(notebook):
    notebook.ok('%%launch one.launch\n<launch><param name="speed" value="2"/></launch>')
    assert notebook.ok('%%launch two.launch\n<launch>\n<include file="$(dirname)/one.launch"/>\n</launch>') == ""
    assert notebook.ok("%roslaunch --dump-params notebook two.launch").startswith("/speed: 2\n")
