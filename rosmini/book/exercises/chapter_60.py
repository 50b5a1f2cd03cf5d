"""What is right in the exercises of chapter 60, turtlesim's nodes: a command, and two scripts tried with a turtle."""

from __future__ import annotations

import shlex
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist

START = ["rosrun", "turtlesim", "turtlesim_node"]

# ---- 60.1: a frog in a pond ----


@exercise("60.1", praise="One program, and a name, a place and a colour of your choice.")
def frog(answer: Any) -> Any:
    """A command starts turtlesim as /pond/frog, on a background without red."""
    expect_type(answer, str, "The command is", "a text")
    line = answer.replace("\\\n", " ").strip().removeprefix("%").removeprefix("$").removesuffix("&")
    try:
        words = shlex.split(line)
    except ValueError as error:
        raise Wrong(f"A shell cannot read it: {error}.", "quotes come in pairs") from error
    space, words = _namespace(words)
    words = words[words[:1] == ["rosmini"] :]  # the same command, in a terminal of rosmini
    expect(words[:3] == START, f"The command begins with {' '.join(START)}.", "then come the words with :=")
    with TurtleTrial(None) as trial:
        try:
            trial.open(*words[3:], *space)
        except RosminiError as error:
            raise Wrong(
                f"It does not start: {error}", "each word has := in it, and nothing around that"
            ) from error
        names = sorted(set(trial.graph.nodes) - {"/rosout"})
        expect(
            names == ["/pond/frog"],
            f"The node is called {', '.join(names)}, not /pond/frog.",
            "__ns and __name, each with two underscores in front",
        )
        red = trial.graph.ask_as("/check").find("getParam", "/pond/frog/background_r")
        expect(
            red == 0, f"The red part of the background is {red}, not 0.", "_background_r:=0, one underscore"
        )
        return trial.view()


def _namespace(words: list[str]) -> tuple[list[str], list[str]]:
    """A namespace that the shell sets for one command, `ROS_NAMESPACE=/pond`, as ROS's own word; and what follows."""
    name, sign, value = words[0].partition("=") if words else ("", "", "")
    if name != "ROS_NAMESPACE" or not sign:
        return [], words
    return [f"__ns:={value}"], words[1:]


# ---- 60.2: a census ----


@exercise("60.2", praise="That is what rosnode does: it asks the Master, and counts.")
def census(answer: Script) -> Any:
    """Each node but /rosout with the number of its topics, in order, in a graph of one window and of three."""
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
                f"It printed:\n{said or 'nothing'}\nand should have printed:\n{lines.strip()}",
                "count each node of each topic in a dictionary, then go through sorted(count)",
            )
    return None


# ---- 60.3: a node that ends ----


@exercise("60.3", praise="A node that knows when its work is done, and leaves the graph in good order.")
def guard(answer: Script) -> Any:
    """It goes on while the turtle is in the middle, and ends with one line when that has left, in any direction."""
    for place in ((9.0, 5.5), (2.0, 5.5), (5.5, 8.0), (5.5, 2.0)):
        with TurtleTrial() as trial:
            handle = trial.start(answer)
            trial.run(1.0)
            expect("/guard" in trial.graph.nodes, "There is no node /guard.", 'rospy.init_node("guard")')
            trial.sim.turtles["turtle1"].teleport_absolute(7.0, 6.0, 0.0)
            trial.run(0.5)
            expect(
                handle.poll() is None and "left" not in trial.output,
                "It ended while the turtle was still in the middle.",
                "more than 2 away from 5.5",
            )
            trial.sim.turtles["turtle1"].teleport_absolute(*place, 0.0)
            trial.run(1.0)
            expect(
                handle.poll() == 0 and "/guard" not in trial.graph.nodes,
                f"The turtle is at {place}, and /guard is still there.",
                "rospy.signal_shutdown(reason), for x and for y, on both sides",
            )
            count = sum(line.endswith("]: the turtle has left") for line in trial.output.splitlines())
            expect(
                count == 1,
                f"It logged 'the turtle has left' {count} times, not once.",
                'rospy.loginfo("the turtle has left"); and poses that were under way still arrive: '
                "ask rospy.is_shutdown() first",
            )
            if place == (5.5, 2.0):
                return trial.view()
    return None
