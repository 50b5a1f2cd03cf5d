"""Checks of the exercises in the chapter rqt."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import Float32
from rosmini.viz.rqt.graph import rqt_graph
from rosmini.viz.rqt.plot import rqt_plot
from rosmini.viz.rqt.publisher import MessagePublisher
from rosmini.viz.view import ViewError

MEASURED = ("/odom/twist/twist/angular/z", "/imu/angular_velocity/z")
"""Fields with the robot's measured angular velocity."""

SWING_RAD, FAR_M = 0.3, 1.0
"""Smallest turn to either side [rad] and smallest forward distance [m]."""


@exercise("options", praise="The picture shows a node that publishes without a subscriber.")
def options(answer: object) -> Any:
    """Options of rqt_graph that draw the spare node and its topic, and no topics of the simulator."""
    expect_type(answer, dict, "options is", "a dictionary from option to value")
    with Trial("maze", is_shown=False) as trial:
        node = trial.graph.node
        for name, topic in (("eyes", "nearest"), ("spare", "closest")):
            eyes = node(name)
            eyes.subscriber("scan", LaserScan, lambda _: None)
            eyes.publisher(topic, Float32)
        pilot = node("pilot")
        pilot.subscriber("nearest", Float32, lambda _: None)
        pilot.publisher("cmd_vel", Twist)
        shown = _graph(dict(answer), trial)  # type: ignore[call-overload]
        drawn = {word.rstrip(",") for line in shown.text.splitlines() for word in line.split()}
        expect(
            {"/spare", "/closest"} <= drawn,
            "/spare and its topic are not in the picture.",
            "a topic without a subscriber is a leaf: choose the mode, and what to hide",
        )
        for topic in ("/rosout", "/imu", "/tf"):
            expect(
                topic not in drawn,
                f"{topic} is also in the picture.",
                "hide debug, and choose the nodes: --nodes /eyes,/pilot,...",
            )
        return shown


def _graph(given: dict[str, Any], trial: Trial) -> Any:
    """Draw the picture of the command with these options."""
    extra = given.keys() - {"mode", "hide", "nodes", "topics"}
    expect(not extra, f"{', '.join(map(str, extra))} is not needed.", "mode, hide and nodes are enough")
    mode = str(given.get("mode", "nodes"))
    expect(mode in ("nodes", "active", "all"), f"There is no mode {mode!r}.", "use nodes, active or all")
    words: dict[str, Any] = {"mode": "nodes_only" if mode == "nodes" else f"nodes_topics_{mode}"}
    if "hide" in given:
        words["hide"] = tuple(part for part in str(given["hide"]).split(",") if part != "none")
    try:
        nodes, topics = (str(given.get(each, "/")) for each in ("nodes", "topics"))
        return rqt_graph(trial.graph, namespace=nodes, topics=topics, **words)
    except ViewError as error:
        raise Wrong(f"rqt_graph refuses these options: {error}") from error


@exercise("field", praise="The plot shows that the wheels follow the command with a delay.")
def field(answer: object) -> Any:
    """The field with the robot's actual angular velocity."""
    expect_type(answer, str, "field is", "a string")
    name = "/" + str(answer).lstrip("/")
    with Trial("arena", is_shown=False) as trial:
        node = trial.graph.node("driver")
        cmd_vel, command = node.publisher("cmd_vel", Twist), Twist()
        node.timer(0.1, lambda _: cmd_vel.publish(command))
        trial.run(1.0)
        command.angular.z = 0.8
        try:
            view = rqt_plot(trial.graph, "/cmd_vel/angular/z", name, duration=2.0, title="Command and robot")
        except ViewError as error:
            raise Wrong(f"rqt_plot cannot plot it: {error}") from error
        expect("cmd_vel" not in name, "This is the command, not what the robot measures.", "look in /odom")
        expect("ground_truth" not in name, "Only a simulator publishes this field.", "look in /odom or /imu")
        expect(name in MEASURED, "This is not the angular velocity.", "look for twist, angular and z")
        return view


@exercise("wave", praise="The robot weaves from side to side and keeps its direction.")
def wave(answer: object) -> Any:
    """Expressions for the fields of a Twist that make the robot weave."""
    expect_type(answer, dict, "wave is", "a dictionary from field to expression")
    seen: list[float] = []
    with Trial("arena") as trial:
        form = MessagePublisher(trial.graph)
        made = form.add("/cmd_vel", "geometry_msgs/Twist", rate=10)
        try:
            for path, expression in dict(answer).items():  # type: ignore[call-overload]
                made.fill(str(path), str(expression))
            made.enable()
        except RosminiError as error:
            raise Wrong(f"The form refuses it: {error}") from error
        start_x, start_y, _ = trial.robot.truth()
        for _ in range(130):
            trial.run(0.1)
            seen.append(trial.robot.truth()[2])
        expect(not made.problem, f"The form has stopped: {made.problem}")
        x, y, _ = trial.robot.truth()
        expect(abs(x - start_x) + abs(y - start_y) > 0.1, "The robot does not drive.", "give linear/x a value")
        expect(max(seen) > SWING_RAD, "The robot does not turn to the left.", "angular/z must alternate")
        expect(
            min(seen) < -SWING_RAD,
            "The robot never faces to the right of its initial heading.",
            "with a cosine the turn is fastest to the left at i = 0; where does the swing start then?",
        )
        expect(
            x - start_x > FAR_M and abs(y - start_y) < 0.5,
            f"The robot leaves its direction: it is {x - start_x:.2f} m ahead and {y - start_y:.2f} m to the side.",
            "make the turns smaller or the wave quicker",
        )
        return trial.view()
