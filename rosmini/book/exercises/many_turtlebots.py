"""Checks of the exercises in the chapter Many TurtleBots: launch files and a script for several robots."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import Launched
from rosmini.book.trials import Trial
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist
from rosmini.msgs.tf2_msgs.msg import TFMessage
from rosmini.navigation.nav_core import pose_stamped

if TYPE_CHECKING:
    from rosmini.core.graph import Graph
    from rosmini.sim.simulator import Simulator

# ---- third_robot: one more robot in Gazebo ----

GAZEBO = """
<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
{group}
</launch>
"""
PLACE = (1.0, -0.5, 1.57)


@exercise("third_robot", praise="The third robot has its own topics and its own frames.")
def third_robot(answer: Any) -> Any:
    """A group that brings a robot into Gazebo, with a namespace and a prefix."""
    expect_type(answer, str, "third_robot is", "a text")
    with Launched(GAZEBO.format(group=answer), "/gazebo", settle=2.0) as trial:
        models = set(trial.graph.nodes["/gazebo"].program.world.models) - {"ground_plane"}
        expect(
            "tb3_2" in models,
            f"Gazebo has no robot tb3_2; its models are {', '.join(sorted(models)) or 'none'}.",
            "spawn_model needs -urdf, -model, -param and a parameter robot_description in the same group",
        )
        found = trial.simulation.truth("tb3_2")
        expect(
            math.dist(found, PLACE) < 0.05,
            f"tb3_2 should be at x = 1, y = -0.5 with heading 1.57, and is at ({found[0]:.1f}, {found[1]:.1f}) "
            f"with heading {found[2]:.2f}.",
            "set -x and -y in metres, and -Y, the heading, in radians",
        )
        topics = {topic for topic, _ in trial.graph.master.getTopicTypes("/check")[2]}
        expect("/tb3_2/scan" in topics, "There is no topic /tb3_2/scan.", 'begin with <group ns="tb3_2">')
        frames = _frames_of(trial.graph)
        expect(
            "tb3_2/base_link" in frames,
            f"There is no frame tb3_2/base_link; the frames are {', '.join(sorted(frames)[:6]) or 'none'}.",
            "a robot_state_publisher in the group, with the parameter tf_prefix inside its node tag",
        )
        _drive(trial.graph, "tb3_2/cmd_vel", 0.15, 4.0)
        expect(
            trial.simulation.truth("tb3_2")[1] > PLACE[1] + 0.3,
            "tb3_2 does not obey /tb3_2/cmd_vel.",
            "the namespace of spawn_model is that of the robot's topics",
        )
        return trial.view()


def _frames_of(graph: Graph) -> set[str]:
    """Return the names of the frames that are published within a second."""
    frames: set[str] = set()
    listener = graph.node("frame_listener")
    for topic in ("/tf", "/tf_static"):
        listener.subscriber(
            topic, TFMessage, lambda message: frames.update(each.child_frame_id for each in message.transforms)
        )
    graph.run(1.0)
    listener.shutdown("it has heard enough")
    return frames


def _drive(graph: Graph, topic: str, speed: float, seconds: float) -> None:
    """Publish a speed [m/s] ten times a second."""
    driver = graph.node("checking_driver", anonymous=True)
    cmd_vel = driver.publisher(topic, Twist, queue_size=1)
    cmd_vel.wait_for_subscribers()
    command = Twist()
    command.linear.x = speed
    for _ in range(round(10 * seconds)):
        cmd_vel.publish(command)
        graph.run(0.1)
    driver.shutdown("it has arrived")


# ---- follow: follow me ----

ALONE = "[{name: alone}, {name: nearby, x: -0.35}]"
ROW = "[{name: leader}, {name: middle, x: -0.7}, {name: back, x: -1.4}]"


def _gap(sim: Simulator, robot: str) -> float:
    """Return the shortest range ahead of a robot."""
    ranges = sim.last_scan(robot).ranges
    return float(min(ranges[-10:].min(), ranges[:11].min()))


@exercise("follow", gaps=2, praise="Three robots drive in a row, and one script drives two of them.")
def follow(answer: Script) -> Any:
    """A script that keeps a robot 0.4 m behind the object ahead of it, in whichever namespace it runs."""
    with Trial("empty", f"_robots:={ALONE}") as trial:
        trial.start(answer, "__ns:=/alone")
        trial.run(5.0)
        trial.expect_no_errors()
        expect(
            math.dist(trial.robot.truth("alone")[:2], (0.0, 0.0)) < 0.02,
            "The follower moved with nothing ahead of it and a robot right behind it.",
            "use only beams ahead, and stop if nothing is within a metre",
        )
    with Trial("empty", f"_robots:={ROW}") as trial:
        sim = trial.robot
        for robot in ("middle", "back"):
            trial.start(answer, f"__ns:=/{robot}")
        trial.run(2.0)
        trial.expect_no_errors()
        for _ in range(20):
            _drive(trial.graph, "leader/cmd_vel", 0.1, 1.0)
            touched = [robot for robot in sim.robots if sim.engine.touching(robot)]
            expect(not touched, "The follower drove into the robot ahead.", "stop at a distance of 0.4 m")
        for robot in ("middle", "back"):
            gap = _gap(sim, robot)
            expect(
                0.3 < gap < 0.6,
                f"While the leader drives at 0.1 m/s, {robot} should be about 0.4 m behind; it is {gap:.1f} m behind.",
                "let the speed grow with the distance beyond 0.4 m, and use relative topic names",
            )
        trial.run(8.0)
        before = sim.truth("back")
        trial.run(2.0)
        expect(
            math.dist(before, sim.truth("back")) < 0.02 and 0.3 < _gap(sim, "back") < 0.5,
            "The leader has stopped, but the last follower did not stop 0.4 m behind the robot ahead.",
            "the speed is 0 at 0.4 m",
        )
        return trial.view()


# ---- two_stacks: a launch file with two faults ----

STARTS = {"tb3_0": (-3.0, 1.0), "tb3_1": (0.5, 1.0)}
GOALS = {"tb3_0": (-0.3, 0.8, 0.0), "tb3_1": (-2.3, 1.1, 3.14)}
DRIVE_S = 32.0
"""Time for both robots to arrive [s]."""


@exercise("two_stacks", praise="Both robots share one map, know where they are, and pass each other.")
def two_stacks(answer: Any) -> Any:
    """A launch file with which two robots change places."""
    expect_type(answer, str, "two_stacks is", "a text")
    with Launched(answer) as trial:
        for robot, place in STARTS.items():
            expect(robot in trial.robot.robots, f"There is no robot {robot}.", "keep the robots as they are")
            x, y, _ = trial.simulation.truth(robot)
            expect(
                math.dist((x, y), place) < 0.1,
                f"{robot} is at ({x:.1f}, {y:.1f}), not at {place}.",
                "keep the robots as they are: the faults are elsewhere",
            )
            node = f"/{robot}/move_base"
            expect(node in trial.graph.nodes, f"There is no node {node}.", "include the file once for each robot")
        trial.run(2.0)
        published = (topic for topic, _ in trial.graph.master.getSystemState("/check")[2][0])
        found = {topic for topic in published if topic.endswith("/map")}
        expect(
            "/map" in found,
            f"No node publishes /map; there is {', '.join(sorted(found)) or 'none'}.",
            "both robots use one map, so do not put the map server in a namespace",
        )
        desk = trial.graph.node("desk")
        for robot, goal in GOALS.items():
            goals = desk.publisher(f"/{robot}/move_base_simple/goal", PoseStamped, queue_size=1)
            goals.wait_for_subscribers()
            goals.publish(pose_stamped("map", Time(), goal))
        trial.run(DRIVE_S)
        for robot, goal in GOALS.items():
            x, y, _ = trial.simulation.truth(robot)
            off = math.dist((x, y), goal[:2])
            expect(
                off < 0.35,
                f"After {DRIVE_S:g} s {robot} is {off:.1f} m from its goal.",
                "compare the pose at which amcl begins with the robot's position and heading",
            )
        return trial.view()
