"""Checks of the exercises in the chapter Beyond: a launch file, a drive home, and the publishers of a topic."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import Drive
from rosmini.core.geometry.poses import compose
from rosmini.msgs.geometry_msgs.msg import PointStamped
from rosmini.sim.worlds import world

# ---- hall: a launch file with which a robot explores ----

NODES = ("/turtlebot3_slam_gmapping", "/move_base", "/explore_server", "/explore_client", "/robot_state_publisher")
POLYGON = ((-1.0, -2.5), (5.0, -2.5), (5.0, 3.5), (-1.0, 3.5), (-1.0, -2.5), (0.3, 0.0))
"""Points to click in the frame map: a polygon around the hall, and a point inside [m]."""


@exercise("hall", praise="Each node runs once, and the robot explores.")
def hall(answer: Any) -> Any:
    """A launch file with simulator, mapper, move_base and explorer."""
    expect_type(answer, str, "hall is", "a text")
    with Drive(answer) as drive:
        start = drive.robot.truth()
        expect(
            math.dist(start[:2], world("pillars").starts[0][:2]) < 0.1,
            f"The robot starts at ({start[0]:.1f}, {start[1]:.1f}): that is not the world pillars.",
            "simulator.launch has an argument world",
        )
        missing = [name for name in NODES if name not in drive.graph.nodes]
        expect(
            not missing, f"These nodes are missing: {', '.join(missing)}.", "which launch file starts the first one?"
        )
        clicks = drive.graph.node("clicks").publisher("/clicked_point", PointStamped, queue_size=10)
        drive.run(0.5)
        for x, y in POLYGON:
            point = PointStamped()
            point.header.frame_id, point.point.x, point.point.y = "map", x, y
            clicks.publish(point)
            drive.run(0.2)
        drive.run(10.0)
        gone = math.dist(start[:2], drive.robot.truth()[:2])
        expect(
            gone > 0.5,
            f"10 s after the clicks the robot is {gone:.2f} m from where it started.",
            "the simulator hears /cmd_vel: where does move_base send its commands?",
        )
        return drive.view()


# ---- come_home: to a place and back, on a map that is being made ----

SLAM = """
<launch>
  <include file="$(find rosmini_sim)/launch/simulator.launch"> <arg name="world" value="pillars"/> </include>
  <include file="$(find turtlebot3_slam)/launch/turtlebot3_slam.launch">
    <arg name="open_rviz" value="false"/>
  </include>
  <include file="$(find turtlebot3_navigation)/launch/move_base.launch"/>
  <param name="turtlebot3_slam_gmapping/particles" value="5"/>
</launch>
"""
FIRST, PLACE = (0.6, 0.3, 0.8), (1.3, -0.2, 0.0)
"""In the frame map: where the robot is when the script starts, and where the script should send it."""


@exercise("come_home", praise="The robot came back to where the script had started.")
def come_home(answer: Script) -> Any:
    """A script that drives to a place and returns to the pose at which the robot was when the script started."""
    with Drive(SLAM) as drive:
        origin = drive.robot.truth()
        drive.go(FIRST, 20.0)
        x, y, yaw = drive.robot.truth()
        drive.results.clear()
        drive.start(answer, f"_x:={PLACE[0]}", f"_y:={PLACE[1]}")
        drive.finish(25.0)
        expect(
            drive.results, "25 s after the start of the script move_base has finished no goal.", "send the first goal"
        )
        there = math.dist(drive.robot.truth()[:2], compose(origin, PLACE)[:2])
        expect(
            there < 0.25,
            f"move_base has finished its first goal, and the robot is {there:.1f} m from the place ({PLACE[0]}, "
            f"{PLACE[1]}).",
            "is the goal in the frame map, and does the script wait for its result?",
        )
        drive.results.clear()
        drive.finish(25.0)
        here = drive.robot.truth()
        off, turned = math.dist(here[:2], (x, y)), abs(math.remainder(here[2] - yaw, math.tau))
        expect(
            off < 0.25,
            f"In the end the robot is {off:.1f} m from where the script started.",
            "look up the pose before the first goal, and send it after the result",
        )
        expect(turned < 0.4, f"It is at home, but its heading is {turned:.1f} rad off.", "also use the rotation")
        return drive.view()


# ---- drivers: the publishers of a topic ----

State = list[list[list[Any]]]

ROBOT: State = [
    [["/odom", ["/simulator"]], ["/cmd_vel", ["/move_base"]], ["/rosout", ["/simulator", "/move_base"]]],
    [["/cmd_vel", ["/simulator"]], ["/odom", ["/move_base"]]],
    [["/move_base/make_plan", ["/move_base"]]],
]
STEERED: State = [
    [*ROBOT[0][:1], ["/cmd_vel", ["/teleop", "/move_base", "/a_script"]], ["/rosout", ["/teleop"]]],
    [*ROBOT[1], ["/scan", ["/watcher"]]],
    [*ROBOT[2], ["/map_server/get", ["/server"]]],
]


@exercise("drivers", praise="If this list has two names, two nodes are fighting over the robot.")
def drivers(answer: Any) -> None:
    """The publishers of a topic."""
    for state, topic, wanted in (
        (STEERED, "/cmd_vel", ["/a_script", "/move_base", "/teleop"]),
        (ROBOT, "/odom", ["/simulator"]),
        (ROBOT, "/scan", []),
        (STEERED, "/scan", []),
    ):
        try:
            found = answer(state, topic)
        except KeyError:
            expect(wanted, f"It raised KeyError for {topic}, on which no node publishes.", "return an empty list then")
            raise
        expect(
            found == wanted,
            f"The publishers of {topic} are {wanted}; your function returned {found!r}.",
            "take the nodes from the first list, the publishers, and sort them",
        )
