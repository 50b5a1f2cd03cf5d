"""The Masters and the nodes that the tests of a module share."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from ..conftest import need_ros
from .harness import Stage

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .harness import Peer

HERE = Path(__file__).parent
ESSENTIAL = [HERE / "test_graph.py"]
"""What one node asks of another, in both directions and under both Masters: part of every run, in 20 seconds."""
IS_ALL = os.environ.get("ROSMINI_TEST_WIRE") == "1"
"""Whether the others, which take six minutes, are run, too."""

collect_ignore = [] if IS_ALL else [str(path) for path in HERE.glob("test_*.py") if path not in ESSENTIAL]

PROGRAMS = ["roscore", "rosnode", "rostopic", "rosservice", "rosparam", "rosbag", "roslaunch"]


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[Stage]:
    """An empty stage of one test."""
    need_ros(*PROGRAMS, modules="rospy, actionlib, tf2_ros, dynamic_reconfigure")
    with Stage(tmp_path) as found:
        yield found


@pytest.fixture(scope="module", params=["ours", "real"])
def core(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Stage]:
    """A stage with a roscore that the tests of a module share, ours or the real one."""
    need_ros(*PROGRAMS, modules="rospy, actionlib, tf2_ros, dynamic_reconfigure")
    with Stage(tmp_path_factory.mktemp(f"roscore_{request.param}")) as found:
        found.roscore(request.param)
        yield found


@pytest.fixture
def pair(core: Stage) -> tuple[Peer, Peer]:
    """Our node and their node under that roscore: those of the test before, unless one of them has hung."""
    for kind, name in (("ours", "ours"), ("real", "theirs")):
        found = core.pair.get(name)
        if found is None or found.process.poll() is not None:
            core.pair[name] = core.peer(kind, name)
    return core.pair["ours"].ready(), core.pair["theirs"].ready()


@pytest.fixture(params=["ours_first", "theirs_first"])
def first_second(pair: tuple[Peer, Peer], request: pytest.FixtureRequest) -> tuple[Peer, Peer]:
    """The two nodes: who publishes, serves or broadcasts, and who hears, calls or looks up."""
    return pair if request.param == "ours_first" else pair[::-1]
