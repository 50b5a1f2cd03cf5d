"""Wrong answers to the exercises of the chapter Teleoperation."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.exercises.teleoperation import Velocity, _twist
from rosmini.core.geometry.poses import Pose, arc
from rosmini.core.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable

# ---- keys_for: which keys ----


def _keys(ahead: Callable[[float], float], names: str = "wxad", *, swapped: bool = False) -> Callable[[], Any]:
    def keys_for(v: float, w: float) -> str:
        parts = []
        for value, more, less in ((v / 0.01, names[0], names[1]), (w / 0.1, names[2], names[3])):
            steps = int(ahead(value))
            parts.append(more * steps if steps > 0 else less * -steps)
        return "".join(parts[::-1] if swapped else parts)

    return lambda: keys_for


# ---- joystick: a joystick ----


def _joystick(rule: Callable[[Any], Velocity | None], name: str = "joystick") -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node(name)
        cmd_vel = node.publisher("cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)

        def on_joy(joy: Any) -> None:
            velocity = rule(joy)
            if velocity is not None:
                cmd_vel.publish(_twist(*velocity))

        node.subscriber("joy", message_class("sensor_msgs/Joy"), on_joy)

    return lambda: start


def _stick(joy: Any) -> Velocity:
    return (0.22 * float(joy.axes[1]), 2.84 * float(joy.axes[0]))


# ---- lock: a lock ----


def _lock(*, zero: bool = True, holds: bool = True, opens: bool = True, resumes: bool = False) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node("lock")
        cmd_vel = node.publisher("cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)
        state: dict[str, Any] = {"locked": False, "last": _twist()}

        def on_stop(message: Any) -> None:
            state["locked"] = message.data or (state["locked"] and not opens)
            if message.data and zero:
                cmd_vel.publish(_twist())
            if not message.data and resumes:
                cmd_vel.publish(state["last"])

        def on_pad(command: Any) -> None:
            state["last"] = command
            if not (state["locked"] and holds):
                cmd_vel.publish(command)

        node.subscriber("stop", message_class("std_msgs/Bool"), on_stop)
        node.subscriber("pad_vel", message_class("geometry_msgs/Twist"), on_pad)

    return lambda: start


# ---- where_now: where is it now ----


def _predicted(step: Callable[[Pose, float, float, float], Pose], *, backwards: bool = False) -> Callable[[], Any]:
    def where_now(seen: Pose, commands: list[tuple[float, float, float]]) -> Pose:
        pose = seen
        for v, w, seconds in commands[::-1] if backwards else commands:
            pose = step(pose, v, w, seconds)
        return pose

    return lambda: where_now


def _straight_then_turn(pose: Pose, v: float, w: float, t: float) -> Pose:
    x, y, heading = pose
    return (x + v * t * math.cos(heading), y + v * t * math.sin(heading), heading + w * t)


def _arc_only(pose: Pose, v: float, w: float, t: float) -> Pose:
    x, y, heading = pose
    after = heading + w * t
    r = v / w
    return (x + r * (math.sin(after) - math.sin(heading)), y - r * (math.cos(after) - math.cos(heading)), after)


MISTAKES = {
    "keys_for": [
        _keys(int),
        _keys(math.floor),
        _keys(abs),
        _keys(round, "wxda"),
        _keys(round, swapped=True),
        lambda: lambda _v, _w: "wwd",
        lambda: lambda v, _w: ["w"] * round(v / 0.01),
        lambda: lambda v, w: "w" * round(v / 0.01) + "a" * round(w / 0.1),
    ],
    "joystick": [
        _joystick(_stick),
        _joystick(lambda joy: _stick(joy) if joy.buttons[4] else None),
        _joystick(lambda joy: _stick(joy) if joy.buttons[0] else (0.0, 0.0)),
        _joystick(lambda joy: _stick(joy) if not joy.buttons[4] else (0.0, 0.0)),
        _joystick(lambda joy: (joy.axes[1], joy.axes[0]) if joy.buttons[4] else (0.0, 0.0)),
        _joystick(lambda joy: (0.22 * joy.axes[0], 2.84 * joy.axes[1]) if joy.buttons[4] else (0.0, 0.0)),
        _joystick(lambda joy: (abs(_stick(joy)[0]), _stick(joy)[1]) if joy.buttons[4] else (0.0, 0.0)),
        _joystick(lambda joy: _stick(joy) if joy.buttons[4] else (0.0, 0.0), "gamepad"),
        lambda: lambda graph: graph.node("joystick"),
    ],
    "lock": [
        _lock(zero=False),
        _lock(holds=False),
        _lock(opens=False),
        _lock(resumes=True),
        lambda: lambda graph: graph.node("lock"),
        lambda: lambda graph: graph.run(0.1),
    ],
    "where_now": [
        _predicted(_straight_then_turn),
        _predicted(_arc_only),
        _predicted(arc, backwards=True),
        lambda: lambda seen, _commands: seen,
        lambda: lambda seen, commands: arc((0.0, 0.0, 0.0), *commands[0]) if commands else seen,
        lambda: lambda _seen, _commands: "here",
        lambda: lambda _seen, _commands: (math.nan, 0.0, 0.0),
    ],
}
