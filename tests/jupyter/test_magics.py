"""``%load_ext rosmini`` in a real kernel."""

from __future__ import annotations

from typing import Any


def test_commands_are_line_magics(new_kernel: Any) -> None:
    new_kernel.ok(
        "%load_ext rosmini\nfrom rosmini import default_graph\ngraph = default_graph()\n_ = graph.node('talker')"
    )
    cell = new_kernel.ok("%rosnode list\nname = '/talker'\n%rosnode info -q $name")
    assert cell.stdout.startswith("/rosout\n/talker\n")
    assert "Node [/talker]" in cell.stdout
    assert cell.shown == []
    cell = new_kernel.ok(
        "before = graph.now()\nfound = %rosparam set /gains '{p: 1.0, i: {max: 2}}'\n%rosparam get /gains"
    )
    assert cell.stdout == "i:\n  max: 2\np: 1.0\n\n"
    assert new_kernel.ok("found.names, graph.now() == before").shown == [
        "(('/gains/p', '/gains/i/max'), True)"
    ]
    assert (
        new_kernel.ok("%rossrv show std_srvs/SetBool").stdout
        == "bool data\n---\nbool success\nstring message\n\n"
    )
    assert new_kernel.ok("nodes = %rosnode list").stdout == "/rosout\n/talker\n"
    assert new_kernel.ok("nodes").stdout == "/rosout\n/talker\n"


def test_what_is_wrong_is_said_and_the_notebook_goes_on(new_kernel: Any) -> None:
    new_kernel.ok("%load_ext rosmini")
    for line, said in (
        ("%rosnode lsit", "did you mean list"), ("%rostopic list | head", "runs no shell"),
        ("%rostopic type /nope", "`rostopic list`"), ("%rosparam get --prety /x", "no such option"),
    ):  # fmt: skip
        cell = new_kernel.run(line)
        assert len(cell.errors) == 1
        assert said in cell.tracebacks[0]
        assert "site-packages" not in cell.tracebacks[0]
    assert new_kernel.ok("%rosnode list").stdout == "/rosout\n"


def test_words_are_completed(new_kernel: Any) -> None:
    new_kernel.ok("%load_ext rosmini\nfrom rosmini import default_graph\n_ = default_graph().node('talker')")
    for line, word in (
        ("%rosnode inf", "info"),
        ("%rosnode info /tal", "/talker"),
        ("%rosmsg show std_msgs/Strin", "std_msgs/String"),
    ):
        reply = new_kernel.client.complete(line, len(line), reply=True, timeout=300)
        assert word in reply["content"]["matches"], reply


def test_below_a_traceback_stands_what_roswtf_knows(new_kernel: Any) -> None:
    new_kernel.ok("%load_ext rosmini\nfrom rosmini import default_graph, install\ninstall()\nimport rospy")
    new_kernel.ok(
        "from std_msgs.msg import String\n_ = default_graph().node('talker').publisher('chatter', String)"
    )
    cell = new_kernel.run("rospy.init_node('me')\nrospy.wait_for_message('/chater', String, timeout=2)")
    assert len(cell.errors) == 1
    assert cell.stdout.endswith(
        "roswtf: ERROR Nothing in the graph is called /chater; did you mean /chatter?\n"
    )
    assert new_kernel.run("1 / 0").stdout == ""
