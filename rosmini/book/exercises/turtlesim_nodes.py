"""Checks of the exercises in the chapter turtlesim: nodes: a command, and two scripts that run with a turtle."""

from __future__ import annotations

import shlex
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist

START = ["rosrun", "turtlesim", "turtlesim_node"]

# ---- frog: a frog in a pond ----


@exercise("frog", praise="The same program runs with your name, namespace and colour.")
def frog(answer: Any) -> Any:
    """A command that starts turtlesim as /pond/frog, on a background without red."""
    expect_type(answer, str, "The command is", "a string")
    line = answer.replace("\\\n", " ").strip().removeprefix("%").removeprefix("$").removesuffix("&")
    try:
        words = shlex.split(line)
    except ValueError as error:
        raise Wrong(f"A shell cannot read it: {error}.", "quotes come in pairs") from error
    space, words = _namespace(words)
    words = words[words[:1] == ["rosmini"] :]  # the same command, in a terminal of rosmini
    expect(words[:3] == START, f"The command must begin with {' '.join(START)}.", "arguments with := follow")
    with TurtleTrial(None) as trial:
        try:
            trial.open(*words[3:], *space)
        except RosminiError as error:
            raise Wrong(f"It does not start: {error}", "each argument contains :=, without spaces around it") from error
        names = sorted(set(trial.graph.nodes) - {"/rosout"})
        expect(
            names == ["/pond/frog"],
            f"The node is called {', '.join(names)}, not /pond/frog.",
            "use __ns and __name, each with two leading underscores",
        )
        red = trial.graph.ask_as("/check").find("getParam", "/pond/frog/background_r")
        expect(red == 0, f"The background's red part is {red}, not 0.", "write _background_r:=0")
        return trial.view()


def _namespace(words: list[str]) -> tuple[list[str], list[str]]:
    """Convert `ROS_NAMESPACE=/pond` before a command into `__ns:=`; return it and the rest of the command."""
    name, sign, value = words[0].partition("=") if words else ("", "", "")
    if name != "ROS_NAMESPACE" or not sign:
        return [], words
    return [f"__ns:={value}"], words[1:]


# ---- census: a census ----


@exercise("census", praise="rosnode gets its lists in the same way: from the Master.")
def census(answer: Script) -> Any:
    """Each node except /rosout with its number of topics, sorted; tried with one window and with three."""
    for others in ((), ("zebra", "ape")):
        with TurtleTrial() as trial:
            for name in others:
                trial.open(f"__ns:=/{name}")
            if others:
                trial.graph.node("scout").publisher("cmd_vel", Twist)
            trial.run(0.2)
            trial.start(answer)
            trial.run(0.5)
            wanted = [("/turtlesim", 3), *((f"/{name}/turtlesim", 3) for name in others)]
            wanted += [("/scout", 2)] if others else []
            lines = "".join(f"{name} {number}\n" for name, number in sorted(wanted))
            said = "\n".join(" ".join(line.split()) for line in trial.output.splitlines() if line.strip())
            expect(
                said == lines.strip(),
                f"It printed:\n{said or 'nothing'}\nbut should have printed:\n{lines.strip()}",
                "count each node of each topic in a dictionary, then go through sorted(count)",
            )
    return None


# ---- go_home: a node that ends ----


@exercise("go_home", praise="The node ends when its task is done, and unregisters properly.")
def guard(answer: Script) -> Any:
    """The node runs while the turtle is in the middle, and logs one line and ends when the turtle leaves it."""
    for place in ((9.0, 5.5), (2.0, 5.5), (5.5, 8.0), (5.5, 2.0)):
        with TurtleTrial() as trial:
            handle = trial.start(answer)
            trial.run(1.0)
            expect("/guard" in trial.graph.nodes, "There is no node /guard.", 'call rospy.init_node("guard")')
            trial.sim.turtles["turtle1"].teleport_absolute(7.0, 6.0, 0.0)
            trial.run(0.5)
            expect(
                handle.poll() is None and "left" not in trial.output,
                "It ended while the turtle was still in the middle.",
                "the turtle has left when x or y is more than 2 away from 5.5",
            )
            trial.sim.turtles["turtle1"].teleport_absolute(*place, 0.0)
            trial.run(1.0)
            expect(
                handle.poll() == 0 and "/guard" not in trial.graph.nodes,
                f"The turtle is at {place}, but /guard is still running.",
                "call rospy.signal_shutdown(reason); check x and y, in both directions",
            )
            count = sum(line.endswith("]: the turtle has left") for line in trial.output.splitlines())
            expect(
                count == 1,
                f"It logged 'the turtle has left' {count} times, not once.",
                'use rospy.loginfo("the turtle has left"); poses may arrive after the shutdown: '
                "check rospy.is_shutdown() first",
            )
            if place == (5.5, 2.0):
                return trial.view()
    return None
