"""`%%terminal`: the walk of the first hours, what stays within the home folder, and what is refused."""

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pytest

from rosmini import Graph, set_default_graph
from rosmini.core.errors import UsageError
from rosmini.core.packages import PackageIndex
from rosmini.notebook.terminal import Terminals
from rosmini.tools import magics
from rosmini.tools.main import COMMANDS

Cell = Callable[..., str]

MANIFEST = """\
cat > package.xml << 'EOF'
<?xml version="1.0"?>
<package format="2">
  <name>example_pkg</name>
  <version>0.0.0</version>
  <description>An example.</description>
  <maintainer email="reader@example.com">Reader</maintainer>
  <license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <depend>std_msgs</depend>
  <exec_depend>message_runtime</exec_depend>
</package>
EOF
cat > CMakeLists.txt << 'EOF'
cmake_minimum_required(VERSION 3.0.2)
project(example_pkg)
find_package(catkin REQUIRED COMPONENTS std_msgs message_generation)
add_message_files(FILES Num.msg)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)
EOF
"""


def environment():
    return {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}


@pytest.fixture
def graph():
    with Graph() as made:
        before = set_default_graph(made)
        yield made
        set_default_graph(before)


@pytest.fixture
def cell(graph, capsys):
    """Runs a cell and returns what it prints."""
    shell = SimpleNamespace(user_ns={}, execution_count=1, graph=graph)
    shell.find_line_magic = lambda name: name if COMMANDS[name].is_magic else None
    shell.run_line_magic = partial(magics.run, shell)
    terminals = Terminals(shell)
    before, folder = environment(), Path.cwd()

    def run(text, line=""):
        capsys.readouterr()
        terminals.run(line, text)
        captured = capsys.readouterr()
        assert captured.err == ""
        return captured.out

    yield run
    terminals.close()
    assert environment() == before
    assert Path.cwd() == folder


def outputs(text):
    """What was printed, without the lines that were typed."""
    return [line for line in text.splitlines() if not line.startswith("$ ")]


def test_the_walk_from_an_empty_folder_to_a_message(cell):
    assert cell("source /opt/ros/noetic/setup.bash\nmkdir -p ~/example_ws/src\ncd ~/example_ws/\npwd") == (
        "$ source /opt/ros/noetic/setup.bash\n$ mkdir -p ~/example_ws/src\n$ cd ~/example_ws/\n$ pwd\n~/example_ws\n"
    )
    assert "Base path: ~/example_ws\n" in cell("catkin_make")
    assert outputs(cell("ls\nsource devel/setup.bash\necho $ROS_PACKAGE_PATH")) == [
        "build  devel  src",
        "~/example_ws/src:/opt/ros/noetic/share",
    ]
    cell("cd src && catkin_create_pkg example_pkg std_msgs rospy roscpp\ncd example_pkg")
    cell('mkdir msg\necho "int64 num" > msg/Num.msg\n' + MANIFEST)
    assert "Built target example_pkg" in cell("cd ~/example_ws\ncatkin_make && source ./devel/setup.bash")
    assert outputs(cell("rosmsg show example_pkg/Num")) == ["int64 num", ""]
    assert outputs(cell("roscd example_pkg/msg\npwd\nrospack find example_pkg")) == [
        "~/example_ws/src/example_pkg/msg",
        "~/example_ws/src/example_pkg",
    ]
    assert PackageIndex().path("example_pkg").name == "example_pkg"  # the line magics find it, too


def test_a_second_terminal_has_to_source_for_itself(cell):
    cell("mkdir -p ws/src && cd ws/src && catkin_create_pkg my_pkg && cd .. && catkin_make && source devel/setup.bash")
    assert outputs(cell("rospack find my_pkg")) == ["~/ws/src/my_pkg"]
    there = outputs(cell("pwd\nls\nrospack find my_pkg\nprintenv", "--at robot"))
    assert there[:2] == ["~", "ws"]
    assert there[2] == "[rospack] Error: package 'my_pkg' not found"
    assert there[-2:] == ["HOME=~", "PATH=/usr/local/bin:/usr/bin:/bin"]
    cell('echo "source ~/ws/devel/setup.bash" >> ~/.bashrc')
    assert outputs(cell("rospack find my_pkg", "--at another")) == ["~/ws/src/my_pkg"]
    assert outputs(cell("rospack find my_pkg", "--at robot")) != ["~/ws/src/my_pkg"]


def test_the_environment(cell):
    cell("export TURTLEBOT3_MODEL=waffle\nexport ROS_IP='10.0.0.7'")
    assert os.environ["TURTLEBOT3_MODEL"] == "waffle"
    assert outputs(cell("printenv | grep -i turtle\nunset ROS_IP\nprintenv ROS_IP")) == ["TURTLEBOT3_MODEL=waffle"]
    assert "ROS_IP" not in os.environ
    assert outputs(cell("A=~/maps B=2\necho $A/x ${B}\nROS_NAMESPACE=/robot1 printenv ROS_NAMESPACE\nprintenv -x")) == [
        "~/maps/x 2",
        "/robot1",
    ]
    assert outputs(cell("source /opt/ros/noetic/setup.bash\necho $ROS_DISTRO")) == ["noetic"]


def test_files(cell):
    assert outputs(cell("echo -e 'b\\na' > f\necho c >> f\ncat f\nsort f | head -n 1\nwc -l f\ngrep -n b f")) == [
        "b", "a", "c", "a", "3", "1:b",
    ]  # fmt: skip
    assert outputs(cell("cp f g\nmkdir d\nmv f g d\nls d *\ncat d/*\nrm -r d\nls -a\nls *.py")) == [
        "d:", "f  g", "", "d:", "f  g", "b", "a", "c", "b", "a", "c", "ls: *.py: No such file or directory",
    ]  # fmt: skip
    assert outputs(cell("mkdir -p a/b && touch a/b/c a/d\nchmod +x a/d\ntree\nls -F a")) == [
        ".", "└── a", "    ├── b", "    │   └── c", "    └── d", "", "2 directories, 2 files", "b/  d*",
    ]  # fmt: skip


def test_an_error_is_printed_and_the_next_line_runs(cell):
    assert outputs(cell("cd nowhere && pwd\npwd\nmkdir a/b\nls nowhere || echo none\necho $?\nrostopic lst")) == [
        "cd: nowhere: No such file or directory",
        "~",
        "mkdir: cannot create directory 'a/b': No such file or directory; mkdir -p makes both folders",
        "ls: nowhere: No such file or directory",
        "none",
        "0",
        "Unknown command: 'lst'",
        "rostopic: there is no command 'lst'; did you mean list?",
    ]


def test_nothing_is_written_outside(cell, tmp_path):
    (tmp_path / "kept").touch()
    for line in (
        f"rm -rf {tmp_path}",
        f"touch {tmp_path}/x",
        f"echo x > {tmp_path}/kept",
        f"mkdir {tmp_path}/d",
        f"mv {tmp_path}/kept .",
        f"cp -r . {tmp_path}/d",
        f"rosbag record -O {tmp_path}/x /chatter",
        f"catkin_make -C {tmp_path}",
        f"catkin_make --directory={tmp_path}",
        "rosparam dump ../x.yaml",
        "rm -rf /opt/ros/noetic/share/std_msgs",
    ):
        assert "Permission denied" in cell(line), line
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
    assert (tmp_path / "kept").read_bytes() == b""


def test_a_new_one(cell):
    cell("touch x\nexport TURTLEBOT3_MODEL=waffle\nmkdir d && cd d")
    assert outputs(cell("pwd\nls\nprintenv TURTLEBOT3_MODEL", "--new")) == ["~"]
    assert os.environ.get("TURTLEBOT3_MODEL") != "waffle"


def test_a_tool_acts_on_the_notebooks_graph_and_its_output_goes_where_it_is_sent(cell, graph):
    graph.node("talker").set_param("~rate", 5)
    assert outputs(cell("rosnode list\nrosnode list | grep talk > nodes\ncat nodes")) == [
        "/rosout", "/talker", "/talker",
    ]  # fmt: skip
    assert outputs(cell("cd ~\nrosparam dump p.yaml /talker\ncat p.yaml")) == ["rate: 5"]


def test_time_passes_with_sleep(cell, graph):
    before = graph.scheduler.now_ns()
    cell("sleep 1.5")
    assert graph.scheduler.now_ns() - before == 1_500_000_000


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("touch x\nnano x", "line 2: there is no command 'nano' here; a cell has no editor"),
        ("rosmmsg show x", "did you mean rosmsg"),
        ("sudo apt install x", "nothing to install"),
        ("for x in *", "there is no command 'for'"),
        ("frobnicate", "it knows ROS's commands .*cat, cd"),
        ("echo 'a", "is not closed"),
    ],
)
def test_what_is_not_known_is_refused_before_anything_is_done(cell, text, what):
    with pytest.raises(UsageError, match=what):
        cell(text)
    assert outputs(cell("ls")) == []


def test_a_help_does_not_end_the_cell(cell):
    said = cell("catkin_make --help\ncatkin_make --nonsense\necho still here\n")
    assert "usage:" in said
    assert said.endswith("$ echo still here\nstill here\n")


def test_a_message_that_was_changed_and_built_is_shown_as_it_is_now(cell):
    cell(f"mkdir -p src/example_pkg/msg\ncd src/example_pkg\n{MANIFEST}\necho int32 num > msg/Num.msg")
    assert "1 built" in cell("cd ~\ncatkin_make")
    cell("source devel/setup.bash")
    assert "int32 num" in cell("rosmsg show example_pkg/Num")
    said = cell("echo int64 big > src/example_pkg/msg/Num.msg\ncatkin_make\nrosmsg show example_pkg/Num")
    assert "1 built" in said
    assert "int64 big" in said.partition("$ rosmsg")[2]
