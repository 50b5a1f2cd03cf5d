"""The node has the topics, services, parameters, replies and texts of the real one (turtlesim 0.10.2)."""

import contextlib
import itertools
import math
import re
import shlex

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini import Graph, rosrun
from rosmini.core.errors import ParameterError, ServiceException
from rosmini.core.verbs import VerbError
from rosmini.msgs import message_class, service_class
from rosmini.sim.turtlesim import frame
from rosmini.sim.turtlesim.turtle import LIMIT
from rosmini.tools import rosmsg, rossrv
from rosmini.tools.rosnode import TOOL as ROSNODE
from rosmini.tools.rosparam import TOOL as ROSPARAM
from rosmini.tools.rosservice import TOOL as ROSSERVICE
from rosmini.tools.rostopic import TOOL as ROSTOPIC

from ...tools.transcripts import in_order, masked

TOOLS = {
    "rosnode": ROSNODE, "rostopic": ROSTOPIC, "rosservice": ROSSERVICE, "rosparam": ROSPARAM, "rosmsg": rosmsg.TOOL,
    "rossrv": rossrv.TOOL,
}  # fmt: skip
RECORDED = in_order("turtlesim")
Twist, Pose, Color = (message_class(kind) for kind in ("geometry_msgs/Twist", "turtlesim/Pose", "turtlesim/Color"))


def start(*arguments):
    graph = Graph()
    return graph, rosrun("turtlesim", "turtlesim_node", *arguments, graph=graph).instance()


@pytest.fixture
def sim():
    graph, made = start()
    with graph:
        yield made


def call(sim, service, kind, *fields):
    graph = sim.node.graph
    caller = graph.nodes.get("/caller") or graph.node("caller")
    return caller.service_client(service, service_class(kind))(*fields)


def drive(sim, linear=0.0, angular=0.0, *, y=0.0, seconds=2.0):
    graph = sim.node.graph
    driver = graph.node("driver", anonymous=True)
    publisher = driver.publisher("/turtle1/cmd_vel", Twist)
    publisher.wait_for_subscribers()
    twist = Twist()
    twist.linear.x, twist.linear.y, twist.angular.z = linear, y, angular
    publisher.publish(twist)
    graph.run(seconds)
    driver.shutdown()


def printed(graph, line):
    """What a terminal would show of both streams, and the exit status."""
    tool, *words = shlex.split(line)
    said = []
    try:
        result = TOOLS[tool].run(*words, graph=graph, say=said.append)
    except VerbError as error:
        return f"{error}\n", error.status
    text = str(result)
    said += [text] if text or result.always_printed else []
    return "".join(f"{part}\n" for part in [*said, *result.complaints]), result.status


def comparable(text):
    """The lines without what differs from run to run, and without what only the real roscore and roslaunch have."""
    text = masked(re.sub(r"b'(.*)'$", r"\1", text, flags=re.MULTILINE))
    text = re.sub(r"(?<=/rosout )(.*) \d+ publishers?", r"\1", text)  # a tool in the process is one, too
    foreign = ("/rosdistro", "/rosversion", "/run_id", "/roslaunch/", " * /rosout_agg", "/rosout/")
    return sorted(line.rstrip() for line in text.splitlines() if line.strip() and not line.startswith(foreign))


def test_a_session_in_a_terminal_is_that_with_the_real_one(sim):
    graph = sim.node.graph
    different = {}
    for line, (text, status) in RECORDED:
        ours, our_status = printed(graph, line)
        if (comparable(ours), our_status) != (comparable(text), status):
            different[line] = ours
    assert different == {}


def test_it_logs_what_the_real_one_logs(capfd):
    graph, sim = start()
    with graph:
        for service, kind, fields in (
            ("/spawn", "turtlesim/Spawn", (1.0, 2.0, 0.5, "ann")),
            ("/spawn", "turtlesim/Spawn", (1.0, 2.0, 0.5, "ann")),
            ("/kill", "turtlesim/Kill", ("bob",)),
            ("/clear", "std_srvs/Empty", ()),
            ("/reset", "std_srvs/Empty", ()),
        ):
            with contextlib.suppress(ServiceException):
                call(sim, service, kind, *fields)
        out, err = capfd.readouterr()
    assert [line.partition("]: ")[2] for line in out.splitlines()] == [
        "Starting turtlesim with node name /turtlesim",
        "Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
        "Spawning turtle [ann] at x=[1.000000], y=[2.000000], theta=[0.500000]",
        "Clearing turtlesim.",
        "Resetting turtlesim.",
        "Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
    ]
    assert [line.partition("]: ")[2] for line in err.splitlines()] == [
        "A turtled named [ann] already exists",
        "Tried to kill turtle [bob], which does not exist",
    ]


def test_against_a_wall_it_warns_at_each_update(sim, capfd):
    drive(sim, 20.0)
    assert sim.turtles["turtle1"].x == LIMIT
    warnings = [line for line in capfd.readouterr().err.splitlines() if "Oh no! I hit the wall!" in line]
    assert warnings[0].endswith("(Clamping from [x=11.304445, y=5.544445])")
    assert warnings[-1].endswith("(Clamping from [x=11.408889, y=5.544445])")
    assert len(warnings) == 63 - 17


def test_poses_come_at_62_5_hz_and_colours_with_them(sim):
    graph = sim.node.graph
    times = []
    colours = []
    ear = graph.node("ear")
    ear.subscriber("/turtle1/pose", Pose, lambda _: times.append(graph.now().to_sec()))
    ear.subscriber("/turtle1/color_sensor", Color, lambda each: colours.append((each.r, each.g, each.b)))
    graph.run(10.0)
    assert len(times) == len(colours) >= 623
    assert {round(after - before, 9) for before, after in itertools.pairwise(times)} == {0.016}
    assert set(colours) == {(69, 86, 255)}


def test_the_colour_sensor_sees_what_was_drawn(sim):
    graph = sim.node.graph
    seen = []
    graph.node("ear").subscriber("/turtle1/color_sensor", Color, lambda each: seen.append((each.r, each.g, each.b)))
    call(sim, "/turtle1/set_pen", "turtlesim/SetPen", 255, 0, 0, 5, 0)
    drive(sim, 1.0)
    assert seen[-1] == (255, 0, 0)
    call(sim, "/turtle1/set_pen", "turtlesim/SetPen", 0, 0, 0, 0, 1)
    drive(sim, 1.0)
    assert seen[-1] == (69, 86, 255)
    assert (255, 0, 0) in seen
    for name, value in (("r", 1), ("g", 2), ("b", 3)):
        sim.node.set_param(f"/turtlesim/background_{name}", value)
    graph.run(0.1)
    assert seen[-1] == (69, 86, 255)
    call(sim, "/clear", "std_srvs/Empty")
    graph.run(0.1)
    assert seen[-1] == (1, 2, 3)


@pytest.mark.parametrize(("argument", "y"), [("_holonomic:=true", 1.008), ("_holonomic:=false", 0.0)])
def test_it_goes_sideways_unless_it_may_not(argument, y):
    graph, sim = start(argument)
    with graph:
        before = sim.turtles["turtle1"].y
        drive(sim, y=1.0)
        assert sim.turtles["turtle1"].y - before == pytest.approx(y)


def test_names_and_namespaces_are_those_of_the_node():
    graph, sim = start("__name:=sim", "__ns:=/left")
    with graph:
        assert sim.node.name == "/left/sim"
        assert sim.node.get_param("/left/sim") == {"background_r": 69, "background_g": 86, "background_b": 255}
        assert {"/left/spawn", "/left/turtle1/set_pen"} <= set(sim.node.services)
        assert {"/left/turtle1/pose", "/left/turtle1/color_sensor"} <= set(sim.node.publications)


@pytest.mark.parametrize(
    ("arguments", "background"),
    [
        (("_background_r:=7",), (7, 86, 255)),
        (("_background_r:=300", "_background_g:=-1", "_background_b:=2.5"), (44, 255, 3)),  # the lowest bytes
    ],
)
def test_a_background_can_be_set_before(arguments, background):
    graph, sim = start(*arguments)
    with graph:
        assert sim.frame.paper.background == background
    with pytest.raises(ParameterError, match="background_r"):
        start("_background_r:=red")


def test_a_background_that_is_none_is_told_and_the_paper_is_cleared(sim, capfd):
    drive(sim, 1.0)
    sim.node.set_param("/turtlesim/background_r", "red")
    call(sim, "/clear", "std_srvs/Empty")
    assert "the background stays as it is: parameter /turtlesim/background_r" in capfd.readouterr().err
    assert (sim.frame.paper.background, sim.frame.paper.count) == ((69, 86, 255), 0)


def test_a_killed_turtle_leaves_nothing_but_its_drawing(sim):
    drive(sim, 1.0)
    call(sim, "/kill", "turtlesim/Kill", "turtle1")
    sim.node.graph.run(0.1)
    assert set(sim.node.publications) == {"/rosout"}
    assert not sim.node.subscriptions
    assert [name for name in sim.node.services if "turtle1" in name] == []
    assert sim.frame.paper.count == 63
    assert call(sim, "/spawn", "turtlesim/Spawn", 1.0, 1.0, 0.0, "").name == "turtle2"
    call(sim, "/reset", "std_srvs/Empty")
    assert list(sim.turtles) == ["turtle1"]
    assert sim.frame.paper.count == 0
    drive(sim, 1.0)
    assert sim.frame.paper.count == 63


numbers = st.floats(width=32)


@given(x=numbers, y=numbers, theta=numbers, kind=st.sampled_from(["spawn", "absolute", "relative", "command"]))
def test_whatever_number_comes_the_simulation_goes_on(x, y, theta, kind):
    graph, sim = start()
    with graph:
        values = x, y, theta
        finite = all(map(math.isfinite, values[: 2 if kind == "relative" else 3]))
        service, spec, fields = {
            "spawn": ("/spawn", "Spawn", (*values, "ann")),
            "absolute": ("/turtle1/teleport_absolute", "TeleportAbsolute", values),
            "relative": ("/turtle1/teleport_relative", "TeleportRelative", values[:2]),
        }.get(kind, ("", "", ()))
        if kind == "command":
            drive(sim, x, theta, y=y, seconds=0.1)
        elif finite:
            call(sim, service, f"turtlesim/{spec}", *fields)
        else:
            with pytest.raises(ServiceException, match="is not a valid number for a turtle"):
                call(sim, service, f"turtlesim/{spec}", *fields)
        ear = graph.node("ear")
        for name in sim.turtles:
            ear.wait_for_message(f"/{name}/pose", Pose)
            pose = ear.wait_for_message(f"/{name}/pose", Pose)
            assert 0 <= pose.x <= LIMIT and 0 <= pose.y <= LIMIT and abs(pose.theta) <= 3.1416
            ear.wait_for_message(f"/{name}/color_sensor", Color)
        assert ("ann" in sim.turtles) == (kind == "spawn" and finite)
        assert str(sim.show())


def test_names_that_no_topic_can_have_are_refused(sim):
    for name in ("a b", "1st", "é", "a-b"):
        with pytest.raises(ServiceException, match="illegal turtle name"):
            call(sim, "/spawn", "turtlesim/Spawn", 1.0, 1.0, 0.0, name)
    for name in ("/turtle1", "turtle1/", "/turtle1/"):
        with pytest.raises(ServiceException, match="would have the topics of turtle1"):
            call(sim, "/spawn", "turtlesim/Spawn", 1.0, 1.0, 0.0, name)
    assert list(sim.turtles) == ["turtle1"]


@given(name=st.text("a/~_1é .", max_size=5) | st.text(max_size=5))
def test_whatever_name_is_asked_for_the_simulation_goes_on(sim, name):
    before = list(sim.turtles)
    try:
        given = call(sim, "/spawn", "turtlesim/Spawn", 1.0, 1.0, 0.0, name).name
    except ServiceException:
        assert list(sim.turtles) == before
    else:
        assert given == name or not name
        call(sim, "/kill", "turtlesim/Kill", given)
    assert set(sim.node.subscriptions) == {"/turtle1/cmd_vel"}
    drive(sim, 0.1, seconds=0.1)


def test_so_many_turtles_and_no_more(sim, monkeypatch):
    monkeypatch.setattr(frame, "MAX_TURTLES", 100)  # 1,000 take twenty seconds
    for _ in range(99):
        call(sim, "/spawn", "turtlesim/Spawn", 1.0, 1.0, 0.0, "")
    with pytest.raises(ServiceException, match="no window has more"):
        call(sim, "/spawn", "turtlesim/Spawn", 1.0, 1.0, 0.0, "")
    drive(sim, 1.0)
    assert sim.turtles["turtle1"].x == pytest.approx(5.544445 + 1.008)
    call(sim, "/reset", "std_srvs/Empty")
    assert list(sim.turtles) == ["turtle1"]
