"""Checks of the exercises in the chapter Family and description."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import JointState
from rosmini.msgs.std_msgs.msg import Float32

if TYPE_CHECKING:
    from rosmini.sim.urdf import Robot

FOOT = (-0.09, 0.0, 0.15)
"""Foot of the mast in `base_link` [m]."""
HEIGHT = 0.2
"""Height of the mast [m]."""


# ---- mast: a xacro file ----


def _expanded(text: str) -> Robot:
    """Return the robot of a xacro file. Raises `Wrong` if it cannot be read."""
    from rosmini.sim.urdf import UrdfError, load, xacro

    with TemporaryDirectory() as folder:
        path = Path(folder, "mast.urdf.xacro")
        path.write_text(text.strip(), encoding="utf-8")
        try:
            robot = load(xacro.expand(path))
        except (UrdfError, RosminiError) as error:
            said = str(error).replace(f"{folder}/", "")
            raise Wrong(f"xacro or URDF refuses this file: {said}", "compare it with flag.urdf.xacro") from error
    for notes in robot.left_out.values():
        raise Wrong(f"A part cannot be read: {notes[0]}", "compare it with flag.urdf.xacro")
    expect("base_scan" in robot.links, "The robot has no laser any more.", "include the file of the Burger")
    return robot


def _expect_visual(robot: Robot, link: str, kind: type, **sizes: float) -> Any:
    """Expect a link to have one visual of this kind and these sizes [m]; return it."""
    word = kind.__name__.lower()
    visuals = robot.links[link].visuals
    expect(len(visuals) == 1, f"{link} has {len(visuals)} visuals.", f"give it one, with a <{word}>")
    shape = visuals[0].geometry
    expect(isinstance(shape, kind), f"The visual of {link} is a {type(shape).__name__.lower()}.", f"use a <{word}>")
    for name, right in sizes.items():
        found = getattr(shape, name)
        expect(
            abs(found - right) < 1e-6,
            f"The {word} of {link} has a {name} of {found:g} m, not {right:g} m.",
            "lengths are in metres; the radius is half the diameter",
        )
    return visuals[0]


@exercise("mast", praise="The mast is there, and every program that reads the description knows where its light is.")
def mast(answer: object) -> Any:
    """A xacro file that adds a mast with a light to a TurtleBot3 Burger."""
    from rosmini.sim.urdf import Cylinder, Sphere

    expect_type(answer, str, "mast is", "a text")
    robot = _expanded(str(answer))
    for link in ("mast_link", "light_link"):
        expect(link in robot.links, f"There is no link {link}.", "compare the names with the task")
        kind = robot.above[link].type
        expect(kind == "fixed", f"{link} is the child of a {kind} joint.", "nothing moves: the type is fixed")
    places = robot.transforms()
    base = places["base_link"][:3, 3]
    for link, right in (("mast_link", FOOT), ("light_link", (*FOOT[:2], FOOT[2] + HEIGHT))):
        found = places[link][:3, 3] - base
        expect(
            max(abs(found - right)) < 1e-6,
            f"The frame {link} is at ({found[0]:.2f}, {found[1]:.2f}, {found[2]:.2f}) in base_link, "
            f"not at ({right[0]:.2f}, {right[1]:.2f}, {right[2]:.2f}).",
            "the origin of a joint is the pose of the child in its parent; x points ahead",
        )
    pole = _expect_visual(robot, "mast_link", Cylinder, radius=0.005, length=HEIGHT)
    low = pole.origin.xyz[2] - HEIGHT / 2
    expect(
        max(abs(low), *map(abs, pole.origin.xyz[:2])) < 1e-6,
        f"The cylinder reaches from {low:.3f} m to {low + HEIGHT:.3f} m above the foot.",
        "the origin of a cylinder is its centre: raise the visual by half the height",
    )
    light = _expect_visual(robot, "light_link", Sphere, radius=0.015)
    expect(
        light.origin.xyz == (0.0, 0.0, 0.0),
        "The sphere is not centred on the frame light_link.",
        "leave out the origin of its visual: the joint puts the frame at the top",
    )
    return robot.show3d()


# ---- flag_up: a joint that follows the robot ----

DRIVES = (
    ("stands still", 0.0, 0.0, 1.57),
    ("drives ahead", 0.15, 0.0, 0.0),
    ("stands still again", 0.0, 0.0, 1.57),
    ("turns", 0.0, -0.6, 0.0),
    ("drives backwards", -0.1, 0.0, 0.0),
)
"""What the robot does, its commands [m/s, rad/s], and the position of the joint [rad]."""


@exercise("flag_up", praise="People see the upright flag and step aside.")
def flag_up(answer: Script) -> Any:
    """The node lowers the flag while the robot stands still."""
    got: list[float] = []
    with Trial("room") as trial:
        listener = trial.graph.node("listener")
        listener.subscriber(
            "joint_states",
            JointState,
            lambda state: got.extend(
                p for name, p in zip(state.name, state.position, strict=False) if name == "lift_joint"
            ),
        )
        cmd_vel = listener.publisher("cmd_vel", Twist, queue_size=1)
        trial.start(answer)
        trial.run(0.5)
        for does, ahead, turn, wanted in DRIVES:
            command = Twist()
            command.linear.x, command.angular.z = ahead, turn
            for step in range(20):
                cmd_vel.publish(command)
                trial.run(0.1)
                if step == 9:
                    got.clear()
            trial.expect_no_errors()
            expect(
                len(got) >= 9,
                f"In a second in which the robot {does}, it published lift_joint {len(got)} times.",
                'state.name = ["lift_joint"]; state.position is a list, too; publish at least ten times a second',
            )
            expect(
                all(abs(each - wanted) < 0.02 for each in got),
                f"While the robot {does}, lift_joint is at {got[-1]:g}, not at {wanted:g}.",
                "look at linear.x and angular.z, and think of negative numbers",
            )
        return trial.view()


# ---- weigh: a program that reads the description ----

MODELS = {"burger": 1.00173292, "waffle": 1.55390748}
"""Masses of the descriptions [kg]."""


@exercise("weigh", praise="The program works for any robot that has a description.")
def weigh(answer: Script) -> None:
    """The node publishes the mass of the robot in its description."""
    from rosmini.sim.urdf import xacro

    for model, mass in MODELS.items():
        got: list[float] = []
        with Trial("empty", f"_model:={model}", is_shown=False) as trial:
            text = xacro.expand(f"package://turtlebot3_description/urdf/turtlebot3_{model}.urdf.xacro")
            trial.graph.node("boss").set_param("/robot_description", text)
            trial.start(answer)
            trial.run(1.0)
            trial.graph.node("late").subscriber("mass", Float32, lambda message, got=got: got.append(message.data))
            trial.run(1.0)
            trial.expect_no_errors()
            expect(got, f"For a {model}, a late subscriber got no message on mass.", "publish once, with latch=True")
            expect(len(got) == 1, f"For a {model}, it published more than once.", "publish once, before spin")
            expect(
                abs(got[0] - mass) < 1e-3,
                f"For a {model} it published {got[0]:.3f} kg, not {mass:.3f} kg.",
                "add the value of each <mass> in the description",
            )
