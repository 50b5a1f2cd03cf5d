"""``%load_ext rosmini`` and ``%roscore``: a notebook's graph begins, and begins again."""

import os
import sys

import pytest

import rosmini
from rosmini.core.errors import RosminiError
from rosmini.notebook.session import session_of

from .conftest import Notebook
from .test_node_cell import LISTENER, TALKER

RUN_ALL = (
    "%roscore",
    f"%%node talker.py\n{TALKER}",
    f"%%node listener.py\n{LISTENER}",
    "import rosmini, random; rosmini.wait(3)",
    "%%node dice.py\nimport random\nprint(random.random())",
    "%rostopic echo -n 2 /chatter",
    "%rosnode list",
    "%rosrun rosmini_sim simulator",
    "%rostopic echo -n 1 /odom",
    "%rosnode info /talker",
)


def test_run_all_twice_gives_equal_outputs(notebook):
    first = [notebook.ok(cell) for cell in RUN_ALL]
    assert first[0] == "ROS_MASTER_URI=http://localhost:11311/\nstarted core service [/rosout]\n"
    assert [notebook.ok(cell) for cell in RUN_ALL] == first


def test_roscore_ends_all_runs_as_ros_does(notebook):
    notebook.ok("ended = []")
    notebook.ok(
        "%%node tidy.py\nimport atexit, rospy\nrospy.init_node('tidy')\n"
        "rospy.on_shutdown(lambda: rospy.set_param('/seen', rospy.core.is_shutdown_requested()))\n"
        "rospy.on_shutdown(lambda: print('bye'))\nrospy.spin()"
    )
    graph = notebook.session.graph
    assert notebook.ok("%roscore").startswith("ROS_MASTER_URI=")
    assert graph.nodes == {}
    assert graph.scheduler.waiting() == ()
    assert notebook.session.graph is not graph
    assert notebook.session.graph.now().to_sec() == 1000
    assert notebook.ok("%rosnode list") == "/rosout\n"


def test_imports_are_those_of_a_robot(notebook):
    notebook.ok("import rospy\nfrom std_msgs.msg import String\nfrom geometry_msgs.msg import Twist")
    assert notebook.ok("print(rospy.__name__, String._type)") == "rosmini.ros.rospy std_msgs/String\n"


def test_the_notebook_can_itself_be_a_node(notebook):
    notebook.ok(f"%%node listener.py\n{LISTENER}")
    notebook.ok("import rospy\nfrom std_msgs.msg import String\nrospy.init_node('notebook')")
    notebook.ok("pub = rospy.Publisher('chatter', String, queue_size=1)\nrospy.sleep(0.1)")
    assert notebook.ok("pub.publish('from a cell')\nrospy.sleep(0.1)") == "heard from a cell\n"
    assert notebook.ok("%rosnode list") == "/listener\n/notebook\n/rosout\n"
    notebook.ok("%roscore")
    notebook.ok("rospy.init_node('notebook')")
    assert notebook.ok("%rosnode list") == "/notebook\n/rosout\n"


def test_unloading_leaves_nothing(notebook):
    folder, before = notebook.session.package.workspace, list(sys.meta_path)
    assert folder.is_dir()
    notebook.ok("%unload_ext rosmini")
    assert not folder.exists()
    assert len(sys.meta_path) < len(before)
    assert str(folder) not in os.environ.get("ROS_PACKAGE_PATH", "")
    with pytest.raises(RosminiError, match="%load_ext rosmini"):
        session_of(notebook.shell)
    assert "begin it with %load_ext rosmini" in notebook.fails("%roscore")


def test_it_works_in_a_folder_without_write_permission(notebook, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tmp_path.chmod(0o500)
    assert notebook.ok("%%node a.py\nprint(1)") == "1\n"
    tmp_path.chmod(0o700)
    assert list(tmp_path.iterdir()) == []


def test_wait_takes_seconds(notebook):
    with pytest.raises(RosminiError, match="the time to wait is a number of seconds"):
        rosmini.wait(-1)
    before = notebook.session.graph.now().to_sec()
    assert notebook.ok("import rosmini; rosmini.wait(2.5)") == ""
    assert notebook.session.graph.now().to_sec() == before + 2.5


def test_where_ros_is_installed_too_one_line_says_whose_rospy_it_is(shell, capsys, tmp_path, monkeypatch):
    (tmp_path / "rospy.py").write_text("ours = False", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    notebook = Notebook(shell, capsys)
    written = notebook.ok("%load_ext rosmini")
    assert written.startswith("rosmini: `import rospy` ") and written.count("\n") == 1
    assert notebook.ok("import rospy\nprint(rospy.__name__)") == "rosmini.ros.rospy\n"


def test_a_rospy_that_was_imported_before_is_named(shell, capsys, tmp_path, monkeypatch):
    (tmp_path / "rospy.py").write_text("ours = False", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    notebook = Notebook(shell, capsys)
    notebook.ok("import rospy")
    assert "restart the kernel" in notebook.ok("%load_ext rosmini")
    del sys.modules["rospy"]


def test_a_graph_that_the_reader_chooses_is_the_notebooks(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    notebook.ok("import rosmini\nchosen = rosmini.Graph(seed=3)\nbefore = rosmini.set_default_graph(chosen)")
    assert notebook.ok(f"%%node talker.py\n{TALKER}") == "said hello at 1000.0\n"
    assert notebook.ok("print(*chosen.nodes)") == "/rosout /talker\n"
    notebook.ok("before.shutdown()\n%roscore")
    assert notebook.ok("print(*chosen.nodes)") == "\n"


DRIVER = """%%node driver.py
import rospy
from std_msgs.msg import Int32
rospy.init_node("driver")
orders = rospy.Publisher("/orders", Int32, queue_size=10)
def on_count(message):
    orders.publish(message.data)
rospy.Subscriber("/count", Int32, on_count)
rospy.spin()
"""
COUNTER = """%%node counter.py
import rospy
from std_msgs.msg import Int32
rospy.init_node("counter")
count = rospy.Publisher("/count", Int32, queue_size=10)
rate = rospy.Rate(10)
number = 0
while not rospy.is_shutdown():
    count.publish(number)
    number += 1
    rate.sleep()
"""


def test_a_notebook_knows_why_and_all_again_is_the_same(notebook):
    def run_all():
        notebook.ok("%load_ext rosmini\n%roscore\nimport rosmini")
        notebook.ok(DRIVER)
        notebook.ok(COUNTER)
        notebook.ok("rosmini.wait(0.5)")
        cells = ["%fault /count --lose 0.5 --seed 1", "rosmini.wait(2)", "%fault list", "%roswhy /orders"]
        return [notebook.ok(cell) for cell in [*cells, "%rossequence -n 60 /count"]]

    first = run_all()
    for part in ("/count ", " 50% ", "seed 1"):
        assert part in first[0]
    assert "20 messages, " in first[2]
    assert "    driver.py, line 7, in on_count: orders.publish(message.data)\nbecause /driver got message" in first[3]
    assert "    counter.py, line 9: count.publish(number)" in first[3]
    assert "(lost)" in first[4]
    assert run_all() == first


def test_a_script_whose_node_is_killed_has_no_last_words(notebook):
    notebook.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    notebook.ok(
        '%%node talker.py\nimport rospy\nrospy.init_node("talker")\n'
        'rospy.on_shutdown(lambda: print("goodbye"))\nrospy.spin()\nprint("after")\n'
    )
    said = notebook.ok("%fault talker --kill") + notebook.ok("rosmini.wait(1)")
    assert "/talker was killed" in said
    assert "goodbye" not in said
    assert "after" not in said
    assert "/talker" in notebook.ok("%rosnode list")
    assert notebook.session.graph.unreachable == ("/talker",)


def test_what_is_amiss_is_printed_in_order_with_the_rest(notebook, capsys):
    """A notebook shows standard error after standard output; a terminal's file takes the latter only."""
    notebook.shell.run_cell("print('first')\n%rostopic echo -n 1 /nowhere\nprint('last')")
    out, err = capsys.readouterr()
    assert out.index("first") < out.index("WARNING: topic [/nowhere]") < out.index("last")
    assert err == ""
    written = notebook.ok("%%terminal --new\nrostopic echo -n 1 /nowhere > heard.txt\ncat heard.txt")
    assert written.count("WARNING: topic [/nowhere]") == 1


@pytest.mark.parametrize(
    ("line", "words"), [("rostopic list --bogus", "no such option"), ("rosmsg show std_msgs/Strng", "did you mean")]
)
def test_an_error_of_a_tool_stands_alone(notebook, line, words):
    error, written = notebook.run(f"%{line}")
    assert words in written
    assert "exception" not in written  # what happened within is nothing to somebody who mistyped
    assert error.__cause__ is not None or error.__context__ is not None


def test_the_tools_of_a_terminal_obey_the_masters_address(notebook):
    """Another Master than the notebook's is none that they reach, as on a robot whose Master is off."""
    said = notebook.ok(
        "%%terminal --new\nsource /opt/ros/noetic/setup.bash\nexport ROS_MASTER_URI=http://robot:11311\n"
        "rosnode list\nrosrun rosmini_sim simulator\nrosmsg md5 std_msgs/String\n"
        "ROS_MASTER_URI=http://127.0.0.1:11311 rosnode list\nexport ROS_MASTER_URI=robot\nrosnode list\n"
        "unset ROS_MASTER_URI\nrosnode list\n"
    )
    refused = "ERROR: Unable to communicate with master!\nROS_MASTER_URI is http://robot:11311, and the only Master"
    assert said.count(refused) == 2
    assert said.count("`export ROS_MASTER_URI=http://localhost:11311`\n") == 2
    assert "$ rosmsg md5 std_msgs/String\n992ce8a1687cec8c8bd883ec73ca41d1\n" in said
    assert "$ ROS_MASTER_URI=http://127.0.0.1:11311 rosnode list\n/rosout\n" in said
    assert "rosnode: ROS_MASTER_URI is 'robot', which is not the address of a Master" in said
    assert said.endswith("$ unset ROS_MASTER_URI\n$ rosnode list\n/rosout\n")
