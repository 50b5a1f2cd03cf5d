"""Checks of the exercises in the chapter RViz."""

from __future__ import annotations

import math
from contextlib import contextmanager
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.tf import StaticTransformBroadcaster
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.visualization_msgs.msg import Marker
from rosmini.viz.rviz import Config, Level, Scene, still

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.viz.rviz import Display

BLUE = (0, 0, 255)
FRIENDS = {"Laser": "rviz/LaserScan", "Path": "rviz/Odometry", "Frames": "rviz/TF"}
"""The displays of the file to correct."""


def _robot(trial: Trial) -> None:
    """Publish the transforms of the laser, and drive a gentle curve."""
    StaticTransformBroadcaster(trial.graph.node("state")).send("base_footprint", "base_scan", (-0.03, 0, 0.18))
    node = trial.graph.node("driver")
    cmd_vel, command = node.publisher("cmd_vel", Twist), Twist()
    command.linear.x, command.angular.z = 0.15, 0.3
    node.timer(0.1, lambda _: cmd_vel.publish(command))


@contextmanager
def _scene(trial: Trial, answer: Any) -> Iterator[Scene]:
    """Return the scene of a file's text."""
    expect_type(answer, str, "It is", "the text of a .rviz file", 'text = """..."""')
    try:
        with Scene(trial.graph, Config.parse(answer)) as scene:
            expect(not scene.warning, f"RViz says: {scene.warning}", "compare the names with those of drive.rviz")
            yield scene
    except RosminiError as error:
        if isinstance(error, Wrong):
            raise
        raise Wrong(f"RViz cannot use it: {error}", "compare it with drive.rviz; mind the indentation") from error


# ---- properties: a display's properties ----


@exercise("properties", praise="Scans stay for ten seconds, so each wall is drawn fifty times.")
def properties(answer: Any) -> Any:
    """A file with a LaserScan display that is blue, has points of 5 cm, and keeps scans for ten seconds."""
    with Trial(is_shown=False) as trial:
        _robot(trial)
        with _scene(trial, answer) as scene:
            trial.run(4.0)
            shown = still(scene, title="What your file shows", fit=True)
            expect(scene.fixed_frame == "odom", f"Its fixed frame is {scene.fixed_frame}, not odom.")
            displays = list(scene)
            expect(
                [each.plugin_name for each in displays] == ["rviz/LaserScan"],
                f"Its displays are: {', '.join(each.plugin_name for each in displays) or 'none'}.",
                "one display, of the class rviz/LaserScan",
            )
            _check_laser(displays[0])
            return shown


def _check_laser(laser: Display) -> None:
    expect(laser["Topic"].lstrip("/") == "scan", "It does not subscribe to /scan.", "set Topic")
    expect(
        laser["Color Transformer"] == "FlatColor",
        f"The points are coloured by {laser['Color Transformer']}, which ignores the property Color.",
        "set Color Transformer to FlatColor",
    )
    expect(tuple(laser["Color"]) == BLUE, "The colour is not blue.", "red; green; blue, each up to 255")
    expect(
        laser["Style"] != "Points",
        "In the style Points a point has a size in pixels, and Size (m) has no effect.",
        "do not change Style",
    )
    expect(math.isclose(laser["Size (m)"], 0.05), f"A point is {laser['Size (m)']:g} m wide, not 5 cm.", "set Size (m)")
    expect(
        math.isclose(laser["Decay Time"], 10.0),
        f"A scan stays for {laser['Decay Time']:g} s, not 10.",
        "set Decay Time; 0 keeps only the last scan",
    )


# ---- correct: a file with four faults ----


@exercise("correct", praise="The fixed frame, both topics and the disabled display are correct now.")
def correct(answer: Any) -> Any:
    """A file in which the fixed frame, two topics and a disabled display are corrected."""
    with Trial(is_shown=False) as trial:
        _robot(trial)
        with _scene(trial, answer) as scene:
            trial.run(3.0)
            shown = still(scene, title="The scene of your file", fit=True)
            found = {display.name: display for display in scene}
            kinds = {name: display.plugin_name for name, display in found.items()}
            expect(kinds == FRIENDS, "Displays were added, removed or renamed.", "change the existing ones")
            for status in scene.global_status:
                expect(status.level is Level.OK, f"Global Status says: {status}", "set Fixed Frame")
            frame = scene.fixed_frame
            expect(frame == "odom", f"{frame} moves with the robot, so the room turns around it.", "use odom")
            for name, display in found.items():
                expect(display.enabled, f"{name} is still disabled.", "set Enabled to true")
                bad = [str(each) for each in display.statuses if each.level is not Level.OK]
                expect(not bad, f"{name} says: {'; '.join(bad)}", "which topic carries messages of its type?")
            return shown


# ---- trail: a marker that grows ----


@exercise("trail", praise="One marker is enough: each new message replaces it with a longer line.", gaps=2)
def trail(answer: Script) -> Any:
    """One LINE_STRIP marker through all positions of the odometry so far."""
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
        trial.expect_no_errors()
        expect(heard, "There was no marker on /visualization_marker.", "publish in the callback")
        last = heard[-1]
        expect(
            last.type == Marker.LINE_STRIP,
            "The marker is not a line through its points.",
            "set type to Marker.LINE_STRIP",
        )
        expect(
            {(each.ns, each.id) for each in heard} == {(last.ns, last.id)},
            "There is more than one marker.",
            "with the same ns and id, each message replaces the previous one",
        )
        expect(
            last.header.frame_id == "odom",
            f"Its frame is {last.header.frame_id!r}, not 'odom'.",
            "use the frame of the odometry",
        )
        line = [_xy(point) for point in last.points]
        expect(len(line) > 1, f"After 8 s the line has {len(line)} points.", "keep earlier points in a list")
        expect(
            math.dist(line[-1], places[-1]) < 0.1 and math.dist(line[0], places[0]) < 0.1,
            "The line does not lead from the start to the robot's position.",
            "append each position",
        )
        expect(
            max(math.dist(a, b) for a, b in pairwise(line)) < 0.3,
            "The line leaves out parts of the path.",
            "append each position",
        )
        expect(
            math.isclose(last.scale.x, 0.03, abs_tol=1e-6),
            f"The line is {last.scale.x:g} m wide, not 0.03 m.",
            "set scale.x",
        )
        expect(last.color.a > 0.1, "The line is transparent.", "set color.a, its opacity, to 1")
        shown = still(scene, title="Your trail", fit=True)
        bad = [str(each) for each in scene["Trail"].statuses if each.level is not Level.OK]
        expect(not bad, f"RViz says: {'; '.join(bad)}", "set the orientation of the pose: w = 1")
        return shown


def _xy(point: Any) -> tuple[float, float]:
    return point.x, point.y
