"""Checks of the exercises in the chapter dynamic_reconfigure: a .cfg file, and clients of a courier that drives."""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.dynamic_reconfigure.description import Description
from rosmini.core.errors import DefinitionError
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.ros.catkin.cfg_file import read_cfg

if TYPE_CHECKING:
    from collections.abc import Callable

# ---- camera_cfg: a declaration ----

SETTINGS = {
    "rate": ("double", 1, 10.0, 1.0, 30.0),
    "exposure": ("int", 2, 100, 1, 1000),
    "flip": ("bool", 2, False, None, None),
}
"""Type, level, default, minimum and maximum by name."""


@exercise("camera_cfg", praise="The build makes CameraConfig from it, and rqt_reconfigure draws two sliders and a box.")
def camera_cfg(answer: Any) -> None:
    """The text of a .cfg file with three settings."""
    expect_type(answer, str, "camera_cfg is", "a string", 'write it between """three quotes"""')
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "Camera.cfg")
        path.write_text(answer, encoding="utf-8")
        try:
            found = read_cfg(path)
        except DefinitionError as error:
            where = f", line {error.line}" if error.line else ""
            expect(False, f"Camera.cfg{where}: {error.message}", "compare it with Line.cfg")
            return
    expect(
        answer.startswith("#!"),
        "The first line does not say which program runs the file.",
        'begin with "#!/usr/bin/env python3", directly after the quotes or after a backslash',
    )
    expect(
        found.name == "Camera",
        f"It makes {found.name}Config, not CameraConfig.",
        'the third argument of generate is the name of the file: "Camera"',
    )
    expect(
        re.search(r"""generate\(\s*["']watcher["']\s*,\s*["']camera["']""", answer),
        "generate is not called with the package and the node from the task.",
        'its first two arguments are "watcher" and "camera"',
    )
    given = {one.name: one for one in Description.of(found.tree).parameters}
    for name, (kind, level, default, low, high) in SETTINGS.items():
        expect(name in given, f"There is no setting {name}.", "one gen.add for each setting")
        one = given[name]
        expect(one.type == kind, f"{name} has type {one.type}_t, not {kind}_t.")
        expect(one.level == level, f"{name} has level {one.level}, not {level}.", "the level is the third argument")
        expect(one.default == default, f"The default of {name} is {one.default}, not {default}.")
        if low is not None:
            expect(
                (one.min, one.max) == (low, high),
                f"{name} ranges from {one.min} to {one.max}, not from {low} to {high}.",
                "the last two arguments are the minimum and the maximum",
            )
    extra = sorted(given.keys() - SETTINGS)
    expect(not extra, f"It has a setting that the task does not mention: {', '.join(extra)}.")


# ---- a courier that drives ahead ----


@dataclass(frozen=True)
class CourierConfig(Parameters):
    """The settings of the courier."""

    speed: float = parameter(0.2, "speed ahead", unit="m/s", minimum=0.0, maximum=0.22)
    lights: bool = parameter(False, "lights")


def courier(trial: Trial) -> tuple[Server, list[dict[str, Any]]]:
    """Start a node that drives ahead; return its server, and the list of the configurations that it receives."""
    calls: list[dict[str, Any]] = []

    def on_change(config: Any, _level: int) -> Any:
        calls.append({"speed": config["speed"], "lights": config["lights"]})
        return config

    node = trial.graph.node("courier")
    cmd_vel = node.publisher("cmd_vel", Twist, queue_size=1)
    server = Server(node, CourierConfig, on_change)

    def drive(_event: object) -> None:
        command = Twist()
        command.linear.x = server.config["speed"]
        cmd_vel.publish(command)

    node.timer(0.1, drive)
    return server, calls


# ---- careful_client: a client that changes the speed ----


@exercise("careful_client", praise="It approached the wall slowly, with two changes in the whole drive.", gaps=2)
def careful_client(answer: Script) -> Any:
    """The client lowers the courier's speed near a wall."""
    with Trial("room", "_x:=0.0") as trial:
        _, calls = courier(trial)
        trial.start(answer)
        for _ in range(36):
            trial.run(0.5)
            trial.expect_no_errors()
            ahead = 3.3 - trial.robot.truth()[0]
            speed = calls[-1]["speed"]
            wanted = 0.05 if ahead < 1.4 else 0.2 if ahead > 1.6 else speed
            expect(
                speed == wanted,
                f"The wall is {ahead:.1f} m ahead, and the speed is {speed:g} m/s, not {wanted:g} m/s.",
                "call client.update_configuration with a dictionary when the speed must change",
            )
        expect(
            len(calls) <= 4,
            f"The courier's settings were set {len(calls) - 1} times.",
            "compare the wanted speed with the last one, and store it: speed = wanted",
        )
        return trial.view()


# ---- lights: a callback for each configuration ----


@exercise("lights", praise="Your node reacts to changes by any other node.", gaps=2)
def lights(answer: Script) -> Any:
    """The client switches the lights when somebody else has changed the speed."""
    with Trial("arena", "_x:=-1.8") as trial:
        server, calls = courier(trial)
        trial.start(answer)
        trial.run(2.0)
        change: Callable[[dict[str, Any]], Any] = server.update_configuration
        for speed, light in ((None, True), (0.1, False), (0.05, False), (0.16, True), (0.0, False)):
            if speed is not None:
                change({"speed": speed})
            trial.run(2.0)
            trial.expect_no_errors()
            now = calls[-1]
            expect(
                now["lights"] is light,
                f"At {now['speed']:g} m/s the lights are {'on' if now['lights'] else 'off'}.",
                "on_config stores whether config.speed > 0.15; the loop sends it",
            )
            expect(speed is None or now["speed"] == speed, "It changed the speed.", "send only the lights")
        settled = len(calls)
        trial.run(3.0)
        expect(
            len(calls) == settled and settled <= 12,
            "It sends changes although the lights are already right.",
            "remember what was sent last, and send only a different value",
        )
        return trial.view()
