"""Checks of the exercises in the chapter Names."""

from __future__ import annotations

from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect, expect_type
from rosmini.core import names
from rosmini.core.graph import Graph
from rosmini.msgs.std_msgs.msg import Float32, String
from rosmini.ros.scripts import run_source

if TYPE_CHECKING:
    from collections.abc import Sequence


# ---- resolve: resolve ----

CASES = [
    ("/map", "/", "/camera"),
    ("/map", "/robot1", "/robot1/camera"),
    ("scan", "/", "/camera"),
    ("scan", "/robot1", "/robot1/camera"),
    ("arm/scan", "/lab/robot2", "/lab/robot2/camera"),
    ("~rate", "/", "/camera"),
    ("~rate", "/robot1", "/robot1/camera"),
    ("~arm/rate", "/lab/robot2", "/lab/robot2/driver"),
]


@exercise("resolve", praise="The first character decides between the three cases; ROS needs no other rule.")
def resolve(answer: Any) -> None:
    """The full name to which a name resolves."""
    for name, namespace, node in CASES:
        found, right = answer(name, namespace, node), names.resolve(name, namespace, node)
        hint = {
            "/": "a global name is already the full name",
            "~": "a private name follows the node's full name, without the ~",
        }.get(name[0], "the namespace / already ends with a slash, the others do not")
        expect(
            found == right, f"{name} resolves to {right} for {node} (namespace {namespace}), not to {found!r}.", hint
        )


# ---- arguments: arguments ----

TALKER = """
import rospy
from std_msgs.msg import String

rospy.init_node("talker")
chatter = rospy.Publisher("chatter", String, queue_size=10, latch=True)
print(rospy.get_name(), chatter.resolved_name, rospy.get_param("~text", "hello"), sep="|")
"""


def _started(arguments: Sequence[str]) -> list[str]:
    """Start a talker with these arguments; return its node, its topic and its text."""
    out, err = StringIO(), StringIO()
    run_source(TALKER, arguments, name="talker.py", stdout=out, stderr=err, prefix=False)
    lines = out.getvalue().strip().splitlines()
    last = (err.getvalue().strip().splitlines() or ["it printed nothing"])[-1]
    expect(bool(lines), f"The talker does not accept them: {last}", "each argument contains one :=")
    return lines[-1].split("|")


@exercise("arguments", praise="Only one argument contains the namespace, and everything else is relative to it.")
def arguments(answer: Any) -> None:
    """The arguments that set the node name, the topic and the text of a talker."""
    expect_type(answer, (list, tuple), "arguments is", "a list", "[...]")
    expect(all(isinstance(word, str) for word in answer), "All arguments are strings.", 'such as "from:=to"')
    node, topic, text = _started(answer)
    expect(node == "/crew/eve", f"The node is called {node}, not /crew/eve.", "use __ns:= and __name:=")
    expect(text == "landed", f"It says {text!r}, not 'landed'.", "use _text:=, with one underscore")
    expect(topic == "/crew/radio/news", f"It publishes on {topic}, not on /crew/radio/news.", "use chatter:=...")
    moved = ["__ns:=/team" if word.startswith("__ns:=") else word for word in answer]
    node, topic, _ = _started(moved)
    expect(
        (node, topic) == ("/team/eve", "/team/radio/news"),
        f"With the namespace /team instead, it runs as {node} and publishes on {topic}.",
        "write a relative name on the right side of the remapping",
    )


# ---- start_reporter: one report for all ----


@exercise("start_reporter", praise="A third robot needs one more call, and no change to the screen.")
def start_reporter(answer: Any) -> None:
    """One node for each robot, which reads that robot's topic and writes to a common one."""
    got: list[str] = []
    robots = ["/robot1", "/robot2", "/lab/robot3"]
    with Graph() as graph:
        graph.node("screen").subscriber("/report", String, lambda message: got.append(message.data))
        feeds = {}
        for robot in robots:
            answer(graph, robot)
            feeds[robot] = graph.node("driver", namespace=robot).publisher("battery", Float32)
        graph.run(0.1)
        for robot, feed in feeds.items():
            expect(
                f"{robot}/reporter" in graph.nodes,
                f"There is no node {robot}/reporter.",
                'make it with graph.node("reporter", namespace=...)',
            )
            expect(
                feed.num_connections() == 1,
                f"{feed.num_connections()} nodes subscribe to {robot}/battery, not 1.",
                "use the relative name battery, so that each reporter reads its own robot's",
            )
        for robot, volts in zip(robots, (11.5, 12.04, 10.96), strict=True):
            feeds[robot].publish(volts)
            graph.run(0.1)
    right = ["/robot1: 11.5 V", "/robot2: 12.0 V", "/lab/robot3: 11.0 V"]
    expect(
        got == right,
        f"The messages on /report were {got or 'none'}, not {right}.",
        "use a global topic name; the text is node.namespace and the number formatted with :.1f",
    )


# ---- find_file: find the file ----


@exercise("find_file", praise="Such an address works wherever the package is, and an overlay can replace the package.")
def find_file(answer: Any) -> None:
    """The file that package://NAME/PATH means, given a list of folders."""
    with TemporaryDirectory() as made:
        root = Path(made)
        files = [
            "a/robot/package.xml",
            "a/robot/readme",
            "b/robot/package.xml",
            "b/robot/maps/floor.yaml",
            "b/arm/package.xml",
            "b/arm/meshes/left/hand.stl",
            "a/arm/meshes/left/hand.stl",
            "b/arm/readme",
        ]
        for file in files:
            (root / file).parent.mkdir(parents=True, exist_ok=True)
            (root / file).touch()
        folders = [root / "none", root / "a", root / "b"]
        for url, right, hint in [
            ("package://robot/readme", "a/robot/readme", "search the folders in turn"),
            ("package://arm/readme", "b/arm/readme", "search the folders in turn"),
            (
                "package://arm/meshes/left/hand.stl",
                "b/arm/meshes/left/hand.stl",
                "a folder without a manifest is not a package",
            ),
            (
                "package://robot/maps/floor.yaml",
                None,
                "only the first package of a name counts, even if the file is missing in it",
            ),
            ("package://leg/readme", None, "there is no such package"),
        ]:
            found = answer(url, list(folders))
            shown = found.relative_to(root).as_posix() if isinstance(found, Path) else found
            expect(shown == right, f"{url} means {right}, not {shown}.", hint)
