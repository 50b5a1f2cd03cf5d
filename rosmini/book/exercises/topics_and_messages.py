"""Checks of the exercises in the chapter Topics and messages."""

from __future__ import annotations

import struct
from itertools import pairwise
from typing import Any

from rosmini.book.checks import exercise, expect, expect_fields, expect_heard, expect_node, expect_type
from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.msgs import define_message
from rosmini.msgs.std_msgs.msg import String

# ---- wheel_type: a type of one's own ----

WHEEL = """\
uint8 LEFT=0
uint8 RIGHT=1
Header header
uint8 side
float64 angle
float32[4] speeds
"""


@exercise("wheel_type", praise="Every definition with these lines has the same md5 sum.")
def definition(answer: Any) -> None:
    """The definition of a message with constants, a header, and an array of a fixed length."""
    expect_type(answer, str, "definition is", "a string", 'write it between """three quotes"""')
    try:
        cls = define_message("my_robot/Wheel", answer)
    except RosminiError as error:
        expect(False, f"This is not a message definition: {error}")
        return
    wanted = define_message("my_robot/Wheel", WHEEL)
    given = {constant.name: (constant.type, constant.value) for constant in cls._spec.constants}
    for constant in wanted._spec.constants:
        expect(
            given.get(constant.name) == (constant.type, constant.value),
            f"There is no constant {constant.name} of type {constant.type} with the value {constant.value}.",
            "a constant is 'type NAME=value'",
        )
    expect_fields(cls, wanted, "definition")
    expect(cls._md5sum == wanted._md5sum, "It has a constant that the task does not mention.")


# ---- fingerprint: md5 sums ----

TEXTS = (
    "string data",
    "float64 x\nfloat64 y\nfloat64 z\n",
    "# a comment\n\nint8   a   # another\n\n  uint16[] b\n",
    "float32 volts\nuint8 LOW=10\nuint8 HIGH = 90 # percent\nstring name\n",
    "# a=b is no constant here\nint32 id # nor=here\n",
)


@exercise("fingerprint", praise="Add nested types, and you have exactly what ROS compares when nodes connect.")
def fingerprint(answer: Any) -> None:
    """The md5 sum of a definition without nested types."""
    hints = (
        "the function md5(...) of this chapter returns the digits for a text",
        "remove the newline at the end",
        "remove comments and empty lines, and reduce several spaces to one",
        "put constants first, without spaces around the =",
        "everything after a # is a comment, even if it contains a =",
    )
    for text, hint in zip(TEXTS, hints, strict=True):
        found = answer(text)
        expect(isinstance(found, str), f"It returned {found!r}, not a string of 32 digits.", hints[0])
        expect(found == define_message("demo/Type", text)._md5sum, f"It is not the md5 sum of {text!r}.", hint)


# ---- decode: bytes ----

TABLES: tuple[dict[str, float], ...] = ({"left": 1.5, "right": -2.0}, {}, {"größe": 0.1, "": 3.0, "température": -40.0})


def _encode(table: dict[str, float]) -> bytes:
    parts = [struct.pack("<I", len(table))]
    parts += [struct.pack("<I", len(name.encode())) + name.encode() for name in table]
    return b"".join(parts) + struct.pack(f"<I{len(table)}d", len(table), *table.values())


@exercise("decode", praise="You can now decode messages from a node in any language.")
def decode(answer: Any) -> None:
    """The names and values of a message, from its bytes."""
    for table in TABLES:
        data = _encode(table)
        found = answer(data)
        expect_type(found, dict, "It returned", "a dictionary")
        expect(
            found == table,
            f"For the {len(data)} bytes of {table} it returned {found}.",
            "read the count, then each name after its length in bytes, then the count again, then the numbers",
        )


# ---- board: many writers ----


@exercise("board", praise="The topic is latched, so every new subscriber receives the board at once.")
def board(answer: Any) -> None:
    """A node that publishes the latest note of each writer on a latched topic."""
    early: list[str] = []
    late: list[str] = []
    with Graph() as graph:
        answer(graph)
        expect_node(graph, "/board")
        graph.node("reader").subscriber("board", String, lambda message: early.append(message.data))
        writers = {name: graph.node(name).publisher("note", String) for name in ("ben", "anna")}
        graph.run(0.1)
        expect_heard(writers["ben"])
        for writer, note in (("ben", "here"), ("anna", "back at ten"), ("ben", "gone")):
            writers[writer].publish(note)
            graph.run(0.1)
        graph.node("late_reader").subscriber("board", String, lambda message: late.append(message.data))
        graph.run(0.1)
    steps = ["/ben: here", "/anna: back at ten; /ben: here", "/anna: back at ten; /ben: gone"]
    for before, after in pairwise(["", *steps]):
        place = steps.index(after)
        found = early[place] if place < len(early) else None
        expect(
            found == after,
            f"After {place + 1} of three notes the board says {found!r}, not {after!r}.",
            "keep a dictionary from the writer's name to its last note"
            if before
            else "the writer's name is message._connection_header['callerid']",
        )
    expect(len(early) == len(steps), f"It published {len(early)} times for three notes.")
    expect(late == steps[-1:], f"A subscriber that starts late receives {late!r}.", "publish with latch=True")
