"""What is measured of the tools: how long each takes to start, to build a workspace, and to draw a large graph."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini import Graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.catkin import NewPackage, Workspace, create_package, make
from rosmini.viz.rqt.graph import rqt_graph

from . import Measure

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .peer import Rospy

STARTED = (
    ("rosnode", "list"), ("rostopic", "list"), ("rosservice", "list"), ("rosparam", "list"),
    ("rosmsg", "show", "std_msgs/String"), ("rospack", "find", "std_msgs"), ("rosversion", "-d"),
)  # fmt: skip
"""Command lines that do next to nothing; no Master runs at the address that they are given."""

PACKAGES = 10
NODES = 100

CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project({name})
find_package(catkin REQUIRED COMPONENTS std_msgs message_generation)
add_message_files(FILES Num.msg)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS std_msgs message_runtime)
"""


def started_ms(words: Sequence[str]) -> float:
    """Return the milliseconds of CPU that a program takes from its start to its end."""
    import resource  # POSIX has it

    def spent() -> float:
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    env = {**os.environ, "ROS_MASTER_URI": "http://127.0.0.1:1", "ROS_PACKAGE_PATH": "/usr/share"}
    env.pop("PYTHONDONTWRITEBYTECODE", None)  # with it, each start would compile rosmini, and not ROS
    subprocess.run(words, capture_output=True, check=False, env=env)
    before = spent()
    subprocess.run(words, capture_output=True, check=False, env=env)
    return (spent() - before) * 1e3


def build_ms(count: int, *, again: bool) -> float:
    """Return the milliseconds of CPU that building ``count`` packages takes, first or with none changed."""
    with tempfile.TemporaryDirectory(prefix="rosmini-bench-") as base:
        source = Path(base, "src")
        source.mkdir()
        for number in range(count):
            needs = ("std_msgs", "message_generation", "message_runtime")
            create_package(NewPackage(f"pkg_{number}", needs), source, say=_nothing)
            folder = source / f"pkg_{number}"
            (folder / "msg").mkdir()
            (folder / "msg" / "Num.msg").write_text("Header header\nint64 num\n", encoding="utf-8")
            (folder / "CMakeLists.txt").write_text(CMAKE.format(name=folder.name), encoding="utf-8")
        workspace = Workspace.at(Path(base))
        if again:
            make(workspace, environ={}, say=_nothing)
        begin = time.process_time()
        report = make(workspace, environ={}, say=_nothing)
        spent = time.process_time() - begin
        done = report.fresh if again else report.built
        if len(done) != count:
            raise RuntimeError(f"not all packages were built: {report.findings}")
        return spent * 1e3


def graph_ms(count: int) -> float:
    """Return the milliseconds of CPU that a picture of ``count`` nodes in a chain takes."""
    with Graph() as graph:
        for number in range(count):
            node = graph.node(f"node_{number}")
            node.publisher(f"topic_{number}", String)
            if number:
                node.subscriber(f"topic_{number - 1}", String, _nothing)
                node.subscriber(f"topic_{number // 2}", String, _nothing)
        graph.run(0.1)
        begin = time.process_time()
        svg = rqt_graph(graph).svg
        spent = time.process_time() - begin
    if svg is None or f"node_{count - 1}" not in svg:
        raise RuntimeError("the picture lacks a node")
    return spent * 1e3


def measures(rospy: Rospy | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""
    if os.name == "posix":
        for words in STARTED:
            real = Path("/usr/bin", words[0])
            has_peer = rospy is not None and real.exists()
            yield Measure(
                f"start and end of {' '.join(words)}",
                "ms of CPU",
                lambda words=words: started_ms([sys.executable, "-m", "rosmini", *words]),  # type: ignore[misc]
                (lambda words=words: started_ms([f"/usr/bin/{words[0]}", *words[1:]])) if has_peer else None,  # type: ignore[misc]
                "ROS's",
                more_is_better=False,
            )
    count = max(int(PACKAGES * scale), 2)
    for again in (False, True):
        yield Measure(
            f"catkin_make of {count} packages, {'again' if again else 'first'}",
            "ms of CPU",
            lambda again=again: build_ms(count, again=again),  # type: ignore[misc]
            more_is_better=False,
        )
    nodes = max(int(NODES * scale), 3)
    yield Measure(f"rqt_graph of {nodes} nodes", "ms of CPU", lambda: graph_ms(nodes), more_is_better=False)


def _nothing(_: object) -> None:
    """Print nothing."""
