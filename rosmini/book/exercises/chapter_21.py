"""What is right in the exercises of chapter 21, RViz."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.tf import StaticTransformBroadcaster
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.visualization_msgs.msg import Marker
from rosmini.viz.rviz import Level, Scene, still

RED = (255, 0, 0)


def _robot(trial: Trial) -> None:
    """What a robot_state_publisher tells of the laser, and a gentle curve."""
    StaticTransformBroadcaster(trial.graph.node("state")).send(
        "base_footprint", "base_scan", (-0.03, 0, 0.18)
    )
    node = trial.graph.node("driver")
    cmd_vel, command = node.publisher("cmd_vel", Twist), Twist()
    command.linear.x, command.angular.z = 0.15, 0.3
    node.timer(0.1, lambda _: cmd_vel.publish(command))


# ---- 21.1: a display's properties ----

SWITCHES = (
    "Autocompute Intensity Bounds",
    "Autocompute Value Bounds",
    "Enabled",
    "Invert Rainbow",
    "Selectable",
    "Unreliable",
    "Use Fixed Frame",
    "Use rainbow",
    "Value",
)
"""Properties of the display that are true or false."""


@exercise("21.1", praise="Ten seconds of scans, and each wall is drawn fifty times.", truths=SWITCHES)
def properties(answer: Any) -> Any:
    """Properties of a LaserScan display that is red, has points of 5 cm, and keeps scans for ten seconds."""
    expect_type(answer, dict, "properties is", "a dictionary: a property, and its value")
    expect(
        all(isinstance(key, str) for key in answer), "The name of a property is a text.", '"Topic": "/scan"'
    )
    with Trial(is_shown=False) as trial, Scene(trial.graph, fixed_frame="odom") as scene:
        _robot(trial)
        try:
            laser = scene.add("LaserScan", answer)
        except RosminiError as error:
            raise Wrong(f"The display refuses it: {error}", "print(laser.tree()) has all names") from error
        trial.run(4.0)
        shown = still(scene, title="What your display shows", fit=True)
        expect(laser["Topic"].lstrip("/") == "scan", "It does not listen on /scan.", "Topic")
        expect(
            laser["Color Transformer"] == "FlatColor",
            f"The points are coloured by {laser['Color Transformer']}, whatever the colour is.",
            "Color Transformer",
        )
        expect(
            tuple(laser["Color"]) == RED, "The colour is not red.", "Color: red, green and blue, up to 255"
        )
        expect(
            laser["Style"] != "Points",
            "In the style Points a point has a size in pixels, whatever Size (m) is.",
            "leave the Style as it is",
        )
        expect(
            math.isclose(laser["Size (m)"], 0.05),
            f"A point has {laser['Size (m)']:g} m, not 5 cm.",
            "Size (m)",
        )
        expect(
            math.isclose(laser["Decay Time"], 10.0),
            f"A scan stays for {laser['Decay Time']:g} s, not 10.",
            "Decay Time; 0 keeps just the last scan",
        )
        return shown


# ---- 21.2: a scene with four faults ----


@exercise("21.2", praise="Fixed frame first, then topics, then the ticks: all four are there.")
def mend(answer: Any) -> Any:
    """A function that mends the fixed frame, two topics and a display that is off."""
    with Trial(is_shown=False) as trial, Scene(trial.graph, fixed_frame="odon") as scene:
        _robot(trial)
        scene.add("LaserScan", {"Topic": "/scans"}, name="Laser")
        scene.add("Odometry", {"Topic": "/imu", "Covariance": False}, name="Way")
        scene.add("TF", name="Frames").enabled = False
        trial.run(1.0)
        names = [display.name for display in scene]
        answer(scene)
        trial.run(3.0)
        shown = still(scene, title="The scene after your function", fit=True)
        found = {display.name: display for display in scene}
        expect(list(found) == names, "Displays have come or gone.", "change those that are there")
        for status in scene.global_status:
            expect(status.level is Level.OK, f"Global Status says: {status}", "scene.fixed_frame")
        frame = scene.fixed_frame
        expect(frame == "odom", f"{frame} moves with the robot, so nothing stands still.", "odom")
        for name, display in found.items():
            expect(display.enabled, f"{name} is still off.", "enabled")
            bad = [str(each) for each in display.statuses if each.level is not Level.OK]
            expect(not bad, f"{name} says: {'; '.join(bad)}", "which topic has messages of its type?")
        return shown


# ---- 21.3: a marker that grows ----


@exercise("21.3", praise="One marker, sent again and again, a little longer each time.", gaps=2)
def trail(answer: Script) -> Any:
    """One LINE_STRIP through all positions of the odometry so far."""
    heard: list[Any] = []
    places: list[tuple[float, float]] = []
    with Trial() as trial, Scene(trial.graph, fixed_frame="odom") as scene:
        _robot(trial)
        scene.add("Marker", {"Marker Topic": "/visualization_marker"}, name="Trail")
        ear = trial.graph.node("ear")
        ear.subscriber("odom", Odometry, lambda odom: places.append(_xy(odom.pose.pose.position)))
        ear.subscriber("visualization_marker", Marker, heard.append)
        trial.start(answer)
        trial.run(8.0)
        expect(heard, "No marker came on /visualization_marker.", "publish in the callback")
        last = heard[-1]
        expect(last.type == Marker.LINE_STRIP, "It is no line through its points.", "type: Marker.LINE_STRIP")
        expect(
            {(each.ns, each.id) for each in heard} == {(last.ns, last.id)},
            "There is more than one marker.",
            "the same ns and id: then each message replaces the one before",
        )
        expect(last.header.frame_id == "odom", f"Its frame is {last.header.frame_id!r}.", "the odometry's")
        line = [_xy(point) for point in last.points]
        expect(len(line) > 1, f"After 8 s the line has {len(line)} points.", "keep the points of before")
        expect(
            math.dist(line[-1], places[-1]) < 0.1 and math.dist(line[0], places[0]) < 0.1,
            "It does not lead from the start to where the robot is.",
            "append each position",
        )
        expect(
            max(math.dist(a, b) for a, b in pairwise(line)) < 0.3,
            "It leaves out parts of the way.",
            "append each position",
        )
        expect(math.isclose(last.scale.x, 0.03, abs_tol=1e-6), f"It is {last.scale.x:g} m wide.", "scale.x")
        expect(last.color.a > 0.1, "It cannot be seen: a is how opaque it is.", "color.a")
        shown = still(scene, title="Your trail", fit=True)
        bad = [str(each) for each in scene["Trail"].statuses if each.level is not Level.OK]
        expect(not bad, f"RViz says: {'; '.join(bad)}", "a pose needs an orientation: w = 1")
        return shown


def _xy(point: Any) -> tuple[float, float]:
    return point.x, point.y
