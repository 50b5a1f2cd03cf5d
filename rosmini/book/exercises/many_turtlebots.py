"""Checks of the exercises in the chapter Many TurtleBots."""

from __future__ import annotations

import math
from contextlib import redirect_stdout
from io import StringIO
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Wrong, exercise, expect
from rosmini.core.graph import Graph
from rosmini.core.packages import PackageIndex
from rosmini.core.tf import Buffer
from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import Rigid, from_yaw
from rosmini.msgs.geometry_msgs.msg import Twist, Vector3
from rosmini.ros.scripts import rosrun
from rosmini.sim.simulator import Simulator
from rosmini.sim.urdf import xacro

if TYPE_CHECKING:
    from collections.abc import Sequence


def _twist(v: float, w: float = 0.0) -> Any:
    return Twist(Vector3(x=float(v)), Vector3(z=float(w)))


def _robots(graph: Graph, *starts: tuple[str, float, float, float], noise: float = 1.0) -> Simulator:
    """Start a simulator of an empty world; each robot has a name, a position and a heading."""
    node = graph.node("simulator")
    node.set_param("~robots", [dict(zip(("name", "x", "y", "yaw"), each, strict=True)) for each in starts])
    node.set_param("~noise", noise)
    return Simulator(node, world="empty")


def _drive(graph: Graph, topic: str, v: float, w: float, seconds: float) -> None:
    """Publish a command ten times a second."""
    driver = graph.node("checking_driver", anonymous=True)
    cmd_vel = driver.publisher(topic, Twist, queue_size=1)
    cmd_vel.wait_for_subscribers()
    for _ in range(round(10 * seconds)):
        cmd_vel.publish(_twist(v, w))
        graph.run(0.1)
    driver.shutdown("it has arrived")


# ---- spawn_words: one more robot ----


@exercise("spawn_words", praise="Two robots were spawned in a Gazebo world, each with topics in its namespace.")
def spawn_words(answer: Any) -> None:
    """The arguments with which rosrun starts spawn_model for another robot."""
    wanted = {"tb3_2": (1.0, -0.5, 1.5), "robby": (-1.0, 0.5, 0.0)}
    packages = PackageIndex()
    burger = packages.path("turtlebot3_description") / "urdf" / "turtlebot3_burger.urdf.xacro"
    with redirect_stdout(StringIO()), Graph() as graph:  # hide Gazebo's log
        server = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
        for name, (x, y, yaw) in wanted.items():
            graph.master.setParam("/checking", f"/{name}/robot_description", xacro.expand(burger))
            words = answer(name, x, y, yaw)
            if not isinstance(words, list | tuple) or not all(isinstance(word, str) for word in words):
                raise Wrong(
                    f"It returned a {type(words).__name__}, not a list of words.", "text.split() returns a list"
                )
            said = StringIO()
            done = rosrun("gazebo_ros", "spawn_model", *words, graph=graph, stdout=said, stderr=said).wait()
            expect(
                done == 0 and name in server.world.models,
                f"spawn_model ran, but did not spawn a model {name}.",
                "use -urdf, -model, -param and the namespace of the parameter, as in the launch file",
            )
            found = server.truth(name)
            expect(
                math.dist(found, (x, y, yaw)) < 0.05,
                f"{name} should be spawned at ({x}, {y}) with heading {yaw}, but is at "
                f"({found[0]:.1f}, {found[1]:.1f}) with heading {found[2]:.1f}.",
                "set -x and -y in metres, and -Y, the heading, in radians",
            )
            topics = [topic for topic, _ in graph.master.getTopicTypes("/checking")[2]]
            expect(f"/{name}/scan" in topics, f"There is no topic /{name}/scan.", "start it in its namespace")


# ---- follow: follow me ----


def _gap(sim: Simulator, robot: str) -> float:
    """Return the shortest range ahead of a robot."""
    ranges = sim.last_scan(robot).ranges
    return float(min(ranges[-10:].min(), ranges[:11].min()))


@exercise("follow", praise="Three robots drove in a row without touching each other.")
def follow(answer: Any) -> None:
    """A node that keeps a robot 0.4 m behind the object ahead of it."""
    with Graph() as graph:
        sim = _robots(graph, ("alone", 0.0, 0.0, 0.0), ("nearby", -0.35, 0.0, 0.0))
        answer(graph, "alone")
        graph.run(5.0)
        expect(
            math.dist(sim.truth("alone")[:2], (0.0, 0.0)) < 0.02,
            "The follower moved with nothing ahead of it and a robot right behind it.",
            "use only beams ahead, and stop if nothing is within a metre",
        )
    with Graph() as graph:
        sim = _robots(graph, ("leader", 0.0, 0.0, 0.0), ("middle", -0.7, 0.0, 0.0), ("back", -1.4, 0.0, 0.0))
        for robot in ("middle", "back"):
            answer(graph, robot)
        graph.run(2.0)
        for _ in range(20):
            _drive(graph, "leader/cmd_vel", 0.1, 0.0, 1.0)
            touched = [robot for robot in sim.robots if sim.engine.touching(robot)]
            expect(not touched, "The follower drove into the robot ahead.", "stop at a distance of 0.4 m")
        for robot in ("middle", "back"):
            gap = _gap(sim, robot)
            expect(
                0.3 < gap < 0.6,
                f"While the leader drives at 0.1 m/s, {robot} should be about 0.4 m behind; it is {gap:.1f} m behind.",
                "make the speed grow with the distance beyond 0.4 m",
            )
        graph.run(8.0)
        before = sim.truth("back")
        graph.run(2.0)
        expect(
            math.dist(before, sim.truth("back")) < 0.02 and 0.3 < _gap(sim, "back") < 0.5,
            "The leader has stopped, but the last follower did not stop 0.4 m behind the robot ahead.",
            "the speed is 0 at 0.4 m",
        )


# ---- seen_from: seen from another robot ----


@exercise("seen_from", praise="Both trees have the root map, so tf goes up one and down the other.")
def seen_from(answer: Any) -> None:
    """The distance and direction from a robot's laser to another robot."""
    buffer = Buffer(None)

    def tell(parent: str, child: str, transform: Rigid) -> None:
        buffer.set_transform(to_stamped(parent, child, transform, 1_000_000_000))

    for name, start, driven in (
        ("tb3_0", from_yaw(-3.0, 1.0, 0.0), from_yaw(1.0, 0.0, math.pi / 2)),
        ("tb3_1", from_yaw(-3.0, 3.0, 1.0), from_yaw(0.4, -0.3, 0.5)),
    ):
        tell("map", f"{name}/odom", start)
        tell(f"{name}/odom", f"{name}/base_footprint", driven)
        tell(f"{name}/base_footprint", f"{name}/base_scan", from_yaw(-0.032, 0.0, 0.0, z=0.182))
    for robot, other in (("tb3_0", "tb3_1"), ("tb3_1", "tb3_0")):
        place = buffer.lookup_transform(f"{robot}/base_scan", f"{other}/base_footprint").transform.translation
        found = answer(buffer, robot, other)
        if not isinstance(found, tuple) or len(found) != 2:
            raise Wrong("It must return two numbers, distance and bearing.", "return distance, bearing")
        distance, bearing = math.hypot(place.x, place.y), math.atan2(place.y, place.x)
        expect(
            abs(found[0] - distance) < 1e-3,
            f"Seen from the laser of {robot}, {other} is {distance:.3f} m away, not {found[0]:.3f} m.",
            "look up base_footprint of the other robot in base_scan of this one, each with its prefix",
        )
        expect(
            abs(found[1] - bearing) < 1e-3,
            f"Seen from the laser of {robot}, {other} is at {bearing:.3f} rad, not {found[1]:.3f} rad.",
            "use math.atan2(y, x)",
        )


# ---- rehearse: rehearse ----

Command = tuple[float, float]
Choices = list[Command]


def _ends(graph: Graph, sim: Simulator, choices: Choices, goal: Sequence[float], *, back: bool) -> list[float]:
    now, far = sim.save(), []
    for v, w in choices:
        _drive(graph, "tb3_0/cmd_vel", v, w, 3.0)
        far.append(math.dist(sim.truth("tb3_0")[:2], goal))
        if back:
            sim.restore(now)
    return far


def _best(graph: Graph, sim: Simulator, choices: Choices, goal: Sequence[float]) -> Command:
    far = _ends(graph, sim, choices, goal, back=True)
    return choices[far.index(min(far))]


@exercise("rehearse", praise="Your function tried each choice for three seconds and left the world unchanged.")
def rehearse(answer: Any) -> None:
    """The command that brings a robot nearest to a goal within three seconds, found by trying each one."""
    choices = [(0.2, 0.0), (0.2, 0.5), (0.2, -0.5), (0.0, 0.0)]
    for blocked in (True, False):
        with Graph() as graph:
            place = (0.25, 0.03, 0.0) if blocked else (-0.5, 0.0, 0.0)
            sim = _robots(graph, ("tb3_0", 0.0, 0.0, 0.0), ("tb3_1", *place), noise=0.0)
            graph.run(0.05)
            goal = (0.55, -0.1)
            wanted, before = _best(graph, sim, choices, goal), sim.save()
            found = answer(graph, sim, choices, goal)
            expect(
                found in choices,
                f"It returned {found!r}, which is not one of the choices.",
                "return one of the given pairs",
            )
            expect(
                all(sim.truth(each.name) == each.state["pose"] for each in before.host.engine.robots),
                "After the call, the robots are not at their old poses.",
                "call sim.restore(...) after each attempt, also after the last",
            )
            where = "with a robot ahead of it" if blocked else "with nothing ahead of it"
            expect(
                found == wanted,
                f"From (0, 0), {where}, {wanted} ends nearest to {goal}; your function chose {found}.",
                "for each command: save, drive for three seconds, measure the distance to the goal, and restore",
            )
