"""Checks of the exercises in the chapter The Parameter Server: each runs a script with a separate robot or graph."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist

# ---- max_speed: a limit from a private parameter ----

WISHES = ((0.05, 0.0), (0.2, 0.5), (0.4, -0.5), (-0.3, 0.0), (0.0, 0.0))


@exercise("max_speed", praise="The same script serves a fast robot and a slow one.", gaps=2)
def max_speed(answer: Script) -> Any:
    """The node limits the speed to ~max_speed, which is 0.22 m/s by default."""
    view = None
    for arguments, limit in (((), 0.22), (("_max_speed:=0.1",), 0.1), (("_max_speed:=1", "__name:=fast"), 1.0)):
        got: list[tuple[float, float]] = []
        with Trial("arena", "_x:=-1.0") as trial:
            trial.graph.node("stranger").set_param("/max_speed", 0.01)
            trial.graph.node("listener").subscriber("cmd_vel", Twist, lambda m, got=got: got.append(_pair(m)))
            wish = trial.graph.node("wisher").publisher("wish", Twist, queue_size=10)
            trial.start(answer, *arguments)
            trial.run(0.5)
            expect(wish.num_connections(), "No node subscribes to /wish.", "keep the stub's last lines")
            for speed, rate in WISHES:
                got.clear()
                for _ in range(10):
                    command = Twist()
                    command.linear.x, command.angular.z = speed, rate
                    wish.publish(command)
                    trial.run(0.1)
                trial.expect_no_errors()
                expect(len(got) == 10, f"For 10 wishes it sent {len(got)} commands.", "publish one for each wish")
                wanted = (max(-limit, min(limit, speed)), rate)
                started = " ".join(("limiter.py", *arguments))
                expect(
                    all(math.isclose(a, b) for a, b in zip(got[-1], wanted, strict=True)),
                    f"Started as `{started}`, it turned the wish {speed:g} m/s, {rate:g} rad/s into "
                    f"{got[-1][0]:g} m/s, {got[-1][1]:g} rad/s.",
                    f'limit linear.x to {limit:g}, the value of "~max_speed", ahead and backwards; keep angular.z',
                )
            view = view or trial.view()
    return view


def _pair(command: Any) -> tuple[float, float]:
    return command.linear.x, command.angular.z


# ---- paused: a parameter that changes ----


@exercise("paused", praise="It stopped and went on when somebody set the parameter, and needed no restart.")
def paused(answer: Script) -> Any:
    """The node drives, and stops while /paused is true."""
    got: list[float] = []
    with Trial("arena", "_x:=-1.5") as trial:
        boss = trial.graph.node("boss")
        boss.subscriber("cmd_vel", Twist, lambda m: got.append(m.linear.x))
        trial.start(answer)
        trial.run(0.5)
        for value, speed in ((None, 0.1), (True, 0.0), (False, 0.1), (True, 0.0)):
            if value is not None:
                boss.set_param("/paused", value)
            trial.run(0.3)
            got.clear()
            trial.run(4.0)
            trial.expect_no_errors()
            said = "is not set" if value is None else f"is {value}"
            expect(
                len(got) >= 38,
                f"While /paused {said}, it sends fewer than ten commands a second.",
                "publish each time round the loop",
            )
            expect(
                all(math.isclose(sent, speed, abs_tol=1e-9) for sent in got),
                f"While /paused {said}, it sends {got[-1]:g} m/s, not {speed:g} m/s.",
                'call rospy.get_param("/paused", False) inside the loop',
            )
        return trial.view()


# ---- quiet: the nearest parameter ----

HOUSES: tuple[tuple[dict[str, bool], float], ...] = (
    ({}, 0.2),
    ({"/quiet": True}, 0.05),
    ({"/quiet": True, "/robot1/quiet": False}, 0.2),
    ({"/robot1/quiet": False, "/robot1/driver/quiet": True}, 0.05),
    ({"/robot2/quiet": True}, 0.2),
)


@exercise("quiet", praise="One value serves the whole house, and a nearer one makes an exception.")
def quiet(answer: Script) -> Any:
    """The node's speed depends on the nearest parameter `quiet`."""
    view = None
    for settings, speed in HOUSES:
        got: list[float] = []
        with Trial("arena", "_x:=-1.5") as trial:
            boss = trial.graph.node("boss")
            boss.subscriber("cmd_vel", Twist, lambda m, got=got: got.append(m.linear.x))
            for name, value in settings.items():
                boss.set_param(name, value)
            trial.start(answer, "__ns:=/robot1", "cmd_vel:=/cmd_vel")
            trial.run(3.0)
            trial.expect_no_errors()
            said = " and ".join(f"{name} is {value}" for name, value in settings.items()) or "quiet is not set"
            expect(got, f"If {said}, it sends no command.", "keep the loop at the end of the stub")
            expect(
                math.isclose(got[-1], speed),
                f"If {said}, the node /robot1/driver sends {got[-1]:g} m/s, not {speed:g} m/s.",
                "search_param returns the full name of the nearest one, or None; get_param returns its value",
            )
            view = trial.view()
    return view


# ---- measured: merge a namespace into another ----

ROBOT = {"name": "burger", "wheel": {"radius": 0.033, "separation": 0.16}, "masts": [1, 2, 3]}
MEASURED = {"wheel": {"radius": 0.0328}, "masts": [4], "laser": {"pose": {"z": 0.17}}}
MERGED = {
    "name": "burger",
    "wheel": {"radius": 0.0328, "separation": 0.16},
    "masts": [4],
    "laser": {"pose": {"z": 0.17}},
}


@exercise("measured", praise="`rosparam load` merges a file in the same way.", gaps=2)
def measured(answer: Script) -> Any:
    """The script merges /measured into /robot, and deletes it."""
    with Trial("empty", is_shown=False) as trial:
        boss = trial.graph.node("boss")
        boss.set_param("/robot", ROBOT)
        boss.set_param("/measured", MEASURED)
        trial.start(answer)
        trial.run(2.0)
        trial.expect_no_errors()
        found = boss.get_param("/robot", {})
        gone = [name for name in ("name", "wheel/separation") if not boss.has_param(f"/robot/{name}")]
        expect(
            not gone,
            f"No longer set: /robot/{', /robot/'.join(gone)}.",
            "set_param with a dictionary replaces the namespace: set each value by its full name",
        )
        expect(found == MERGED, f"/robot is {found}, not {MERGED}.", "a list is one value; a dictionary is not")
        expect(not boss.has_param("/measured"), "/measured is still there.", "use rospy.delete_param")
