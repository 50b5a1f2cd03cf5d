"""``%load_ext rosmini`` in a real kernel."""


def test_commands_are_line_magics(shared_kernel):
    shared_kernel.ok(
        "%load_ext rosmini\n%roscore\n"
        "from rosmini import default_graph\ngraph = default_graph()\n_ = graph.node('talker')"
    )
    cell = shared_kernel.ok("%rosnode list\nname = '/talker'\n%rosnode info -q $name")
    assert cell.stdout.startswith("/rosout\n/talker\n")
    assert "Node [/talker]" in cell.stdout
    assert cell.shown == []
    cell = shared_kernel.ok(
        "before = graph.now()\nfound = %rosparam set /gains '{p: 1.0, i: {max: 2}}'\n%rosparam get /gains"
    )
    assert cell.stdout == "i:\n  max: 2\np: 1.0\n\n"
    assert shared_kernel.ok("found.names, graph.now() == before").shown == ["(('/gains/p', '/gains/i/max'), True)"]
    assert (
        shared_kernel.ok("%rossrv show std_srvs/SetBool").stdout == "bool data\n---\nbool success\nstring message\n\n"
    )
    assert shared_kernel.ok("nodes = %rosnode list").stdout == "/rosout\n/talker\n"
    assert shared_kernel.ok("nodes").stdout == "/rosout\n/talker\n"


def test_what_is_wrong_is_said_and_the_notebook_goes_on(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore")
    for line, said in (
        ("%rosnode lsit", "did you mean list"), ("%rostopic list | head", "runs no shell"),
        ("%rostopic type /nope", "`rostopic list`"), ("%rosparam get --prety /x", "no such option"),
    ):  # fmt: skip
        cell = shared_kernel.run(line)
        assert len(cell.errors) == 1
        assert said in cell.tracebacks[0]
        assert "site-packages" not in cell.tracebacks[0]
    assert shared_kernel.ok("%rosnode list").stdout == "/rosout\n"


def test_words_are_completed(shared_kernel):
    shared_kernel.ok(
        "%load_ext rosmini\n%roscore\nfrom rosmini import default_graph\n_ = default_graph().node('talker')"
    )
    shared_kernel.ok("%%node talker.py\nimport rospy\nrospy.init_node('other')\nrospy.spin()")
    for line, word in (
        ("%rosrun note", "notebook"),
        ("%rosrun notebook ta", "talker.py"),
        ("%rosrun rosmini_sim s", "simulator"),
        ("%rosnode inf", "info"),
        ("%rosnode info /tal", "/talker"),
        ("%rosmsg show std_msgs/Strin", "std_msgs/String"),
    ):
        reply = shared_kernel.client.complete(line, len(line), reply=True, timeout=300)
        assert word in reply["content"]["matches"], reply


def test_a_cell_shows_what_is_being_compiled(shared_kernel):
    shared_kernel.ok("%load_ext rosmini")
    cell = shared_kernel.ok(
        "from rosmini.core.geometry import machine_code\n"
        "with machine_code.show_progress('compiling the planner'):\n    pass"
    )
    assert cell.shown == ["compiling the planner"]
