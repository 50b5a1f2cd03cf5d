"""Checks of the exercises in the chapter Gazebo."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, cast

from rosmini.book.checks import Script, Wrong, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.ros.scripts import rosrun
from rosmini.sim.recorder import Recorder
from rosmini.sim.urdf import xacro

if TYPE_CHECKING:
    from rosmini.sim.gazebo.server import GazeboServer
    from rosmini.sim.sdf.document import SdfModel
    from rosmini.sim.world import Pose

BURGER = "package://turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro"
ROBOT = "turtlebot3_burger"


class GazeboTrial(Trial):
    """A separate graph with Gazebo's empty world and a TurtleBot3 Burger at `pose`."""

    def __init__(self, pose: Pose = (0.0, 0.0, 0.0)) -> None:
        self._begin(is_shown=True)
        started = rosrun("gazebo_ros", "gzserver", graph=self.graph, capture_output=True)
        self.server = cast("GazeboServer", cast("Any", started).instance())
        self.server.spawn(xacro.expand(BURGER), ROBOT, pose)
        self._recorder = Recorder(self.graph, self.server)

    def add_crate(self, name: str, pose: Pose, mu: float = 0.5) -> None:
        """Add a crate of 2 kg."""
        surface = f"<surface><friction><ode><mu>{mu}</mu></ode></friction></surface>"
        box = f'<collision name="c"><geometry><box><size>0.3 0.3 0.3</size></box></geometry>{surface}</collision>'
        link = f'<link name="l"><pose>0 0 0.15 0 0 0</pose><inertial><mass>2</mass></inertial>{box}</link>'
        self.server.spawn(f'<sdf version="1.6"><model name="m">{link}</model></sdf>', name, pose)

    def record(self) -> None:
        """Begin a new recording, with the objects that are there now."""
        self._recorder.stop()
        self._recorder = Recorder(self.graph, self.server, name="recorder_of_all")

    def drive(self, speed: float) -> None:
        """Command the robot ten times a second to drive straight on."""
        command = Twist()
        command.linear.x = speed
        node = self.graph.node("driver", anonymous=True)
        cmd_vel = node.publisher("/cmd_vel", Twist)
        node.timer(0.1, lambda _: cmd_vel.publish(command))


# ---- barrel: a barrel ----

RADIUS, HEIGHT, MASS = 0.2, 0.6, 3.0


@exercise("barrel", praise="It stands on the floor, and the robot pushed it away.")
def barrel(answer: Script) -> Any:
    """A script that adds a cylinder of 3 kg with the largest friction with which a burger can push it."""
    with GazeboTrial() as trial:
        trial.start(answer)
        trial.run(2.0)
        models = trial.server.world.models
        said = trial.output.strip().rpartition("]: ")[2] or "nothing"
        expect("barrel" in models, f"There is no model barrel. Your script logged: {said}", "compare it with spawn.py")
        trial.record()
        _check_barrel(models["barrel"].sdf)
        trial.drive(0.2)
        trial.run(12.0)
        moved = trial.server.truth("barrel")[0] - 1.0
        expect(moved > 0.5, f"The robot pushed it only {max(0.0, moved):.2f} m.", "mu must be less than 6.9 / (m g)")
        return trial.view()


def _check_barrel(model: SdfModel) -> None:
    expect(not model.static, "It is static, so it cannot be pushed.", "remove <static>")
    expect(len(model.links) == 1, f"It has {len(model.links)} links, not one.")
    link = model.links[0]
    expect(len(link.collisions) == 1, f"It has {len(link.collisions)} collisions, not one.", "add one <collision>")
    collision = link.collisions[0]
    shape = collision.geometry
    expect(shape.kind == "cylinder", f"Its collision is a {shape.kind}, not a cylinder.")
    expect(
        math.isclose(shape.radius, RADIUS) and math.isclose(shape.length, HEIGHT),
        f"Its cylinder has a radius of {shape.radius:g} m and a length of {shape.length:g} m; "
        f"they should be {RADIUS} m and {HEIGHT} m.",
    )
    bottom = model.pose[2] + link.pose[2] + collision.pose[2] - HEIGHT / 2
    expect(
        abs(bottom) < 1e-9,
        f"If its origin is on the floor, its bottom is at a height of {bottom:.2f} m.",
        "the pose of a cylinder is that of its centre",
    )
    inertial = link.inertial
    expect(math.isclose(inertial.mass, MASS), f"Its mass is {inertial.mass:g} kg, not {MASS:g} kg.", "<inertial>")
    across, along = MASS * (3 * RADIUS**2 + HEIGHT**2) / 12, MASS * RADIUS**2 / 2
    for axis, found, right in zip(("ixx", "iyy", "izz"), inertial.inertia, (across, across, along), strict=False):
        expect(
            math.isclose(found, right, rel_tol=0.01),
            f"{axis} is {found:.4g} kg m2, not {right:.4g}.",
            "izz is about the cylinder's own axis, which is vertical",
        )
    mu = collision.friction
    expect(mu is not None, "Its surface says nothing about friction.", "copy <surface> from the parcel")
    expect(float(mu or 0.0) > 0.225, f"Its mu is {mu:g}, and could be larger.", "6.9 N = mu m g")


# ---- friction: friction ----

CASES = ((0.15, 9.8), (0.4, 9.8), (0.9, 1.6))
"""Coefficient of friction, and gravity [m/s2]."""


@exercise("friction", praise="It found 0.15, 0.4 and 0.9; the last one was on the Moon.")
def friction(answer: Script) -> Any:
    """A script that measures the coefficient of friction of an object, within 2%."""
    view = None
    for mu, gravity in CASES:
        with GazeboTrial((-0.5, 0.0, 0.0)) as trial:
            trial.add_crate("thing", (0.0, 0.0, 0.0), mu)
            trial.server.set_physics(replace(trial.server.world.physics, gravity_z=-gravity))
            trial.record()
            trial.start(answer)
            trial.run(20.0)
            found = trial.graph.node("check").get_param("/mu", None)
            expect(found is not None, "After 20 s there is no parameter /mu.", "does measure() return a number?")
            if not isinstance(found, int | float):
                raise Wrong(f"/mu is {found!r}, not a number.", "what does measure() return?")
            expect(
                abs(found - mu) <= 0.02 * mu,
                f"You found {found:.3f}, but mu is {mu}, with a gravity of {gravity} m/s2.",
                "solve d = v * v / (2 * mu * g) for mu; does the object rest at the end?",
            )
            view = trial.view()
    return view


# ---- leash: a leash ----


@exercise("leash", praise="It came back each time, and nothing else was moved.")
def leash(answer: Script) -> Any:
    """A script that returns the robot to its start when it is more than a metre away."""
    for pose in ((0.0, 0.0, 0.0), (-1.0, 2.0, 1.0)):
        with GazeboTrial(pose) as trial:
            trial.add_crate("crate", (2.0, -2.0, 0.0))
            trial.record()
            trial.start(answer)
            trial.run(1.0)
            trial.drive(0.2)
            path = []
            for _ in range(120):
                trial.run(0.1)
                path.append(trial.server.truth())
            ways = [math.dist(each[:2], pose[:2]) for each in path]
            far = max(ways)
            expect(far < 1.1, f"The robot got {far:.2f} m away.", "compare the distance in each message")
            expect(far > 0.9, f"The robot was moved after {far:.2f} m.", "do not move it while it is near enough")
            backs = sum(b < a - 0.5 for a, b in pairwise(ways))
            expect(backs >= 2, f"In 12 s it came back {backs} times.", "remember the first pose, and use it each time")
            off = min(ways[ways.index(max(ways)) :])
            expect(off < 0.1, f"It came back to {off:.2f} m from where it started.", "remember the first pose")
            turned = max(abs(each[2] - pose[2]) for each in path)
            expect(turned < 0.05, f"It is turned by {turned:.1f} rad.", "use the whole pose, with its orientation")
            crate = trial.server.truth("crate")
            expect(math.dist(crate[:2], (2.0, -2.0)) < 0.01, "The crate was also moved.", "look for the robot's name")
            view = trial.view()
    return view
