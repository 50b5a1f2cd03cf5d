"""Checks of the exercises in the chapter Many machines: two lines, four causes, and a node between turtles."""

from __future__ import annotations

import shlex
from itertools import groupby
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.ros.scripts import rosrun
from rosmini.sim.turtlesim import window

if TYPE_CHECKING:
    from collections.abc import Iterator

MASTER, PORT, TABLET = "192.168.1.10", 11311, "192.168.1.42"

# ---- bashrc: a third computer ----


def _exported(text: str) -> dict[str, str]:
    """Return the variables that the lines of a ~/.bashrc export."""
    found: dict[str, str] = {}
    exported: set[str] = set()
    for line, words in _commands(text):
        if words[0] in ("source", "."):  # for example, of a workspace
            continue
        expect(
            words[0] != "echo",
            f"{line!r} is a command that prints a line or appends it to the file.",
            "write the lines themselves, as they are in the file",
        )
        exports = words[0] == "export"
        expect(exports or "=" in words[0][1:], f"{line!r} exports nothing.", "use export NAME=VALUE")
        for word in words[exports:]:
            name, sign, value = word.partition("=")
            exported |= {name} if exports else set()
            if exports and not sign and name in found:
                continue
            expect(name and sign and value, f"{line!r} gives {word!r} no value.", "write no spaces around =")
            found[name] = value
    kept = ", ".join(sorted(set(found) - exported))
    expect(not kept, f"{kept} is set but not exported, so programs do not see it.", "use export NAME=VALUE")
    return found


def _commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """Yield the commands of a bash file: the line, and its words."""
    for line in map(str.strip, text.splitlines()):
        reader = shlex.shlex(line, posix=True, punctuation_chars=";&")
        reader.whitespace_split = True
        try:
            tokens = list(reader)
        except ValueError as error:
            raise Wrong(f"bash cannot read {line!r}: {error}.", "quotes come in pairs") from error
        for is_end, group in groupby(tokens, lambda token: set(token) <= {";", "&"}):
            if not is_end:
                yield line, list(group)


@exercise("bashrc", praise="The tablet knows the Master's address and advertises its own.")
def bashrc(answer: Any) -> None:
    """The variables of a third computer: the Master's address and its own address."""
    expect_type(answer, str, "The lines are", "a string")
    given = _exported(answer)
    expect("ROS_MASTER_URI" in given, "ROS_MASTER_URI is not set.", "it is the same on all computers")
    uri = given["ROS_MASTER_URI"]
    try:
        parts = urlsplit(uri)
        place = (parts.scheme, parts.hostname, parts.port)
    except ValueError:
        place = ("", None, None)
    expect(
        place == ("http", MASTER, PORT),
        f"The Master is not at {uri}.",
        "write http://, the address of the Master's computer, and the port 11311",
    )
    own = given.get("ROS_HOSTNAME", given.get("ROS_IP"))
    expect(own is not None, "The tablet does not advertise an address.", "set ROS_IP to its own address")
    expect(own == TABLET, f"The other computers would look for the tablet at {own}.", "use its own address")


# ---- causes: what is wrong? ----

CAUSES = {
    "Ada": ("master", "which address was called here?"),
    "Ben": ("clock", "his transforms arrive, but are a minute old"),
    "Cem": ("address", "the Master knows the node, so what is wrong with its entry?"),
    "Dea": ("name", "a node ends when another one starts with the same ..."),
}


@exercise("causes", praise="You found the cause of each of the four messages.")
def causes(answer: Any) -> None:
    """The cause of each complaint, in one word."""
    expect_type(answer, dict, "causes is", "a dictionary from person to word")
    for person, (right, hint) in CAUSES.items():
        said = answer.get(person)
        expect(
            isinstance(said, str) and said.strip().lower() == right,
            f"The cause of {person}'s problem is not {said!r}.",
            hint,
        )


# ---- other_way_round: the other way round ----

DRIVES = ((1.0, 1.0), (2.0, -0.5), (-1.0, 0.0))
"""Commands for the first turtle: forwards [units/s], to the left [rad/s]."""
NEAR = 0.2
"""Largest difference between the two, because the second one receives a command a little later [units, rad]."""


@exercise("other_way_round", praise="Your node connects two namespaces and can run on any of the computers.")
def mirror(answer: Script) -> Any:
    """The second turtle moves like the first one, with left and right exchanged."""
    with TurtleTrial(None) as trial:
        for name in ("one", "two"):
            rosrun("turtlesim", "turtlesim_node", f"__ns:=/{name}", graph=trial.graph, capture_output=True)
        command = trial.graph.node("driver").publisher("/one/turtle1/cmd_vel", Twist)
        trial.run(0.2)
        trial.start(answer)
        trial.run(0.5)
        expect("/mirror" in trial.graph.nodes, "There is no node /mirror.", 'call rospy.init_node("mirror")')
        one, two = (window(f"/{name}/turtlesim", graph=trial.graph).turtles["turtle1"] for name in ("one", "two"))
        start = two.y
        for ahead, left in DRIVES:
            twist = Twist()
            twist.linear.x, twist.angular.z = ahead, left
            command.publish(twist)
            trial.run(1.5)
            apart = (two.x - one.x, two.y + one.y - 2 * start, two.theta + one.theta)
            expect(
                all(abs(value) < NEAR for value in apart),
                f"With the command {ahead:g} forwards and {left:g} to the left, the first turtle is now "
                f"{one}, and the second {two}.",
                "pass on each command: linear unchanged, angular.z with the opposite sign",
            )
    return None
