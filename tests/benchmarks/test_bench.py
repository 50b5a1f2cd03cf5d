"""The benchmarks run and check what their subscribers received; how fast they are is not judged."""

from __future__ import annotations

import json
import math
import os
import sys
from contextlib import ExitStack, closing
from typing import TYPE_CHECKING

import pytest
from rosmini_bench import (
    Figure,
    Measure,
    actions,
    bags,
    displays,
    graph,
    launch_files,
    nav,
    sim,
    table,
    tools,
    transforms,
    turtles,
    wire,
)
from rosmini_bench.peer import find_rospy

from rosmini.cli.main import main
from rosmini.errors import RosminiError

if TYPE_CHECKING:
    from pathlib import Path

EXPONENTS_AND_ERRORS = {"1", "m", "m/s", "blocks more"}
"""Units of what may be nothing, or less."""


PEERS = {"pymunk", "unrecorded", "scipy", "csgraph", "scikit-image", "C++ costmap_2d, elsewhere"}
"""What is measured beside us though no other program is asked for: libraries."""


def test_every_measure_gives_a_positive_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "figures.json"
    assert main(["bench", "--no-peer", "--rounds", "1", "--scale", "0.001", "--json", str(file)]) == 0
    written = json.loads(file.read_text(encoding="utf-8"))
    shown = capsys.readouterr().out
    of_the_wire = sum(row["name"].startswith("wire: ") for row in written["figures"])
    assert of_the_wire == (13 if sys.platform == "win32" else 14)
    assert len(written["figures"]) == of_the_wire + len(
        [
            *graph.measures(None, 1),
            *actions.measures(None, 1),
            *transforms.measures(None, 1),
            *launch_files.measures(None, 1),
            *tools.measures(None, 1),
            *bags.measures(tmp_path, None, 1),
            *displays.measures(1),
            *sim.measures(None, None, 0.001),
            *turtles.measures(1),
            *nav.measures(0.1),
        ]
    )
    for row in written["figures"]:
        assert math.isfinite(row["ours"])
        assert row["ours"] > 0 or row["unit"] in EXPONENTS_AND_ERRORS
        assert row["peer"] is None or row["peer_name"] in PEERS
        assert row["name"] in shown


@pytest.mark.ros
def test_real_rospy_is_measured_beside_it() -> None:
    rospy = find_rospy()
    if rospy is None:
        assert os.environ.get("ROSMINI_REQUIRE_ROS") != "1", "real ROS is required here"
        pytest.skip("real ROS is not installed")
    try:
        measures = [
            *graph.measures(rospy, 0.001),
            *actions.measures(rospy, 0.05),
            *transforms.measures(rospy, 0.01),
            *launch_files.measures(rospy, 0.01),
        ]
        figures = [measure.run(1) for measure in measures]
    finally:
        rospy.close()
    compared = [figure for figure in figures if figure.peer is not None]
    assert len(compared) >= 6
    assert all(figure.peer and figure.peer > 0 for figure in compared)


@pytest.mark.ros
def test_real_rosbag_is_measured_beside_it(tmp_path: Path) -> None:
    peer = bags.find_rosbag(tmp_path)
    if peer is None:
        assert os.environ.get("ROSMINI_REQUIRE_ROS") != "1", "real ROS is required here"
        pytest.skip("real ROS is not installed")
    figures = [measure.run(1) for measure in bags.measures(tmp_path, peer, 0.01)]
    assert sum(bool(figure.peer) for figure in figures) == 6
    assert figures[-1].ours == 100.0


@pytest.mark.ros
@pytest.mark.processes
def test_the_wire_of_real_rospy_is_measured_beside_ours() -> None:
    with ExitStack() as stack:
        rospy = find_rospy()
        if rospy is None:
            assert os.environ.get("ROSMINI_REQUIRE_ROS") != "1", "real ROS is required here"
            pytest.skip("real ROS is not installed")
        stack.callback(rospy.close)
        figures = [measure.run(1) for measure in wire.measures(rospy, 0.001, stack)]
    assert all(figure.ours > 0 for figure in figures)
    assert sum(figure.peer is None for figure in figures) == 1
    assert all(figure.peer > 0 for figure in figures if figure.peer is not None)


def test_messages_that_are_lost_on_the_wire_give_no_figure(tmp_path: Path) -> None:
    node = tmp_path / "node.py"
    node.write_text("import sys\nfor _ in sys.stdin: print('@ \"lost\"', flush=True)\n", encoding="utf-8")
    process = wire.Process([sys.executable, str(node)], dict(os.environ))
    with closing(process), pytest.raises(RosminiError, match="no figure of the wire: lost"):
        process.ask(do="throughput")
    process = wire.Process([sys.executable, "-c", ""], dict(os.environ))
    with closing(process), pytest.raises(RosminiError, match="ended"):
        process.answer()


def test_a_bag_that_is_not_what_was_written_gives_no_figure(tmp_path: Path) -> None:
    bags.write(tmp_path / "x.bag", "string", 10)
    with pytest.raises(RosminiError, match="no figure"):
        bags.read(tmp_path / "x.bag", "string", 11)


def test_a_figure_is_the_median_and_the_two_take_turns() -> None:
    order: list[str] = []
    ours, peer = iter([5.0, 1.0, 3.0]), iter([1.0, 1.0, 9.0])

    def mine() -> float:
        order.append("ours")
        return next(ours)

    def theirs() -> float:
        order.append("peer")
        return next(peer)

    figure = Measure("thing", "1/s", mine, theirs).run(3)
    assert (figure.ours, figure.peer, figure.ratio) == (3.0, 1.0, 3.0)
    assert order == ["ours", "peer"] * 3


def test_less_can_be_better() -> None:
    figure = Figure("latency", "us", 2.0, 10.0, "rospy", 1, more_is_better=False)
    assert figure.ratio == 5.0
    assert "5.0" in table([figure]).splitlines()[1]


def test_a_subscriber_that_misses_something_gives_no_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    connected = graph._connected
    monkeypatch.setattr(
        graph,
        "_connected",
        lambda kind, callback: connected(kind, lambda message: (callback(message), callback(message))),
    )
    with pytest.raises(RosminiError, match="lost or changed"):
        graph.string_throughput(100, 100)


@pytest.mark.parametrize("words", [["--rounds", "0"], ["--scale", "0"], ["--scale", "nan"]])
def test_wrong_options_are_refused(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--no-peer", *words]) != 0
    assert "whole number" in capsys.readouterr().err
