"""Checks of the exercises in the chapter The environment."""

from __future__ import annotations

import math
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist

if TYPE_CHECKING:
    from collections.abc import Iterator

MODEL = "TURTLEBOT3_MODEL"

# ---- fast: as fast as it may ----

TOP_SPEEDS = {"waffle": 0.26, "burger": 0.22, None: 0.22, "waffle_pi": 0.26}
"""Expected speed for each value of the variable [m/s]; None: it is not set."""


@contextmanager
def model_is(value: str | None) -> Iterator[None]:
    """Set the variable to this value inside the block; None unsets it."""
    before = os.environ.pop(MODEL, None)
    try:
        if value is not None:
            os.environ[MODEL] = value
        yield
    finally:
        os.environ.pop(MODEL, None)
        if before is not None:
            os.environ[MODEL] = before


@exercise("fast", praise="One script serves three robots, and the environment chooses.")
def fast(answer: Script) -> Any:
    """The robot drives straight ahead at the top speed of the model in the variable."""
    view = None
    for model, speed in TOP_SPEEDS.items():
        got: list[Twist] = []
        with model_is(model), Trial("room", f"_model:={model or 'burger'}") as trial:
            trial.graph.node("listener").subscriber("cmd_vel", Twist, got.append)
            trial.start(answer)
            trial.run(4.0)
            told = f"With {MODEL}={model}" if model else f"Without {MODEL}"
            expect(len(got) >= 30, f"{told} it sent {len(got)} commands in 4 s.", "publish ten a second")
            found, turn = got[-1].linear.x, got[-1].angular.z
            expect(
                math.isclose(found, speed),
                f"{told} it drove at {found:g} m/s, not at {speed:g}.",
                "read the variable with os.environ.get, and set command.linear.x from it",
            )
            expect(turn == 0, f"{told} it turned.", "leave angular.z at 0")
            view = trial.view()
    return view


# ---- winner: which one wins? ----

OWN, ROS, OTHER = "~/report_ws/src", "/opt/ros/noetic/share", "~/old_ws/src"
PACKAGES = {
    OWN: ["turtlebot3_ds", "gazebo_models"],
    OTHER: ["turtlebot3_ds", "turtlesim"],
    ROS: ["turtlesim", "gazebo_ros"],
}
CASES = [
    ("turtlebot3_ds", [OWN, OTHER, ROS], OWN),
    ("turtlebot3_ds", [OTHER, OWN, ROS], OTHER),
    ("turtlesim", [OWN, ROS], ROS),
    ("turtlesim", ["~/gone_ws/src", OTHER, ROS], OTHER),
    ("turtlebot3_ds", ["~/report_ws/scr", ROS], None),
    ("turtlebot3", [OWN, OTHER, ROS], None),
]


@exercise("winner", praise="The first folder wins, which is what makes overlays work.")
def winner(answer: Any) -> None:
    """The folder in which ROS finds a package."""
    for package, folders, right in CASES:
        path = ":".join(folders)
        found = answer(package, path, {folder: list(names) for folder, names in PACKAGES.items()})
        expect(
            found == right,
            f"With ROS_PACKAGE_PATH={path} ROS finds the package {package} in {right}, not in {found!r}.",
            "go through the folders of the path in order; the first that contains the package wins",
        )


# ---- wrong_variable: what is wrong with this laptop? ----

GOOD = {"ROS_MASTER_URI": "http://robot:11311", "ROS_HOSTNAME": "laptop", MODEL: "burger"}
LAPTOPS: list[tuple[dict[str, str | None], str | None]] = [
    ({}, None),
    ({"ROS_MASTER_URI": "http://robot:11311/", MODEL: "waffle_pi"}, None),
    ({"ROS_MASTER_URI": "http://localhost:11311"}, "ROS_MASTER_URI"),
    ({"ROS_MASTER_URI": None, "ROS_HOSTNAME": None}, "ROS_MASTER_URI"),
    ({"ROS_MASTER_URI": "robot:11311"}, "ROS_MASTER_URI"),
    ({"ROS_HOSTNAME": "localhost"}, "ROS_HOSTNAME"),
    ({"ROS_HOSTNAME": None, MODEL: None}, "ROS_HOSTNAME"),
    ({MODEL: None}, MODEL),
    ({MODEL: "burgr"}, MODEL),
    ({MODEL: "waffle"}, None),
]


@exercise("wrong_variable", praise="You found the mistake on all ten laptops.")
def wrong_variable(answer: Any) -> None:
    """The first variable of an environment that is wrong."""
    for changes, right in LAPTOPS:
        environment = {name: value for name, value in {**GOOD, **changes}.items() if value is not None}
        told = ", ".join(f"{name}={value}" for name, value in environment.items()) or "nothing set"
        found = answer(dict(environment))
        expect(
            found == right,
            f"With {told} the answer is {right}, not {found!r}.",
            "check one variable after the other with environment.get, and return the first that is wrong",
        )
