"""The Masters and the nodes that the tests of a module share."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from ...conftest import nightly
from ..conftest import need_ros
from .harness import Stage

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from .harness import Peer

BOTH = ["ours", "real"]
MASTERS = {"test_our_tools": ["real"]}
"""Under whose Masters a module's tests run with each commit: ours by default. At night all run under both. Nodes of
both kinds take part; ROS's tools run against our Master, and ours against the real one."""

PROGRAMS = ["roscore", "rosnode", "rostopic", "rosservice", "rosparam", "rosbag", "roslaunch"]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Choose the Masters under which a module's tests run."""
    name = metafunc.module.__name__.rpartition(".")[2]
    each_commit = MASTERS.get(name, ["ours"])
    masters = [*each_commit, *nightly(*(master for master in BOTH if master not in each_commit))]
    for fixture in {"core", "site"} & set(metafunc.fixturenames):
        metafunc.parametrize(fixture, masters, indirect=True, scope="module")


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[Stage]:
    """An empty stage of one test."""
    need_ros(*PROGRAMS, modules="rospy, actionlib, tf2_ros, dynamic_reconfigure")
    with Stage(tmp_path) as found:
        yield found


@pytest.fixture(scope="module")
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
