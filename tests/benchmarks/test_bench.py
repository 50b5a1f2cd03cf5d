"""The benchmarks run and check what their subscribers received; how fast they are is not judged."""

import json
import math
import os
import sys
from contextlib import closing

import pytest
from rosmini_bench import (
    actions,
    bags,
    displays,
    graph,
    launch_files,
    nav,
    sim,
    sim_peer,
    tools,
    transforms,
    turtles,
    wire,
)

from rosmini.core.errors import RosminiError
from rosmini.tools.main import main

EXPONENTS_AND_ERRORS = {"1", "m", "m/s", "blocks more"}
"""Units of what may be nothing, or less."""


PEERS = {"pymunk", "unrecorded", "scipy", "csgraph", "scikit-image", "C++ costmap_2d, elsewhere"}
"""What is measured beside us though no other program is asked for: libraries."""


@pytest.mark.nightly
@pytest.mark.ros
@pytest.mark.processes
def test_every_measure_gives_a_positive_figure(tmp_path, capsys, monkeypatch):
    """Ours, and beside it real rospy, its wire and its bags where they are installed: all in one run."""
    monkeypatch.setattr(sim_peer, "find_irsim", lambda: None)  # see test_bench_sim.py
    file = tmp_path / "figures.json"
    assert main(["bench", "--rounds", "1", "--scale", "0.001", "--json", str(file)]) == 0
    rows = json.loads(file.read_text(encoding="utf-8"))["figures"]
    shown = capsys.readouterr().out
    wires = [row for row in rows if row["name"].startswith("wire: ")]
    assert len(wires) == (13 if sys.platform == "win32" else 14)
    assert len(rows) == len(wires) + len(
        [
            *graph.measures(None, 1), *actions.measures(None, 1), *transforms.measures(None, 1),
            *launch_files.measures(None, 1), *tools.measures(None, 1), *bags.measures(tmp_path, None, 1),
            *displays.measures(1), *sim.measures(None, 0.001), *turtles.measures(1), *nav.measures(0.1),
        ]
    )  # fmt: skip
    for row in rows:
        assert math.isfinite(row["ours"])
        assert row["ours"] > 0 or row["unit"] in EXPONENTS_AND_ERRORS
        assert row["name"] in shown
    if "real ROS is not installed" in shown:
        assert os.environ.get("ROSMINI_REQUIRE_ROS") != "1", "real ROS is required here"
        assert all(row["peer"] is None or row["peer_name"] in PEERS for row in rows)
        pytest.skip("real ROS is not installed: only our own side was measured")
    assert sum(row["peer"] is None for row in wires) == 1
    bagged = [row for row in rows if row["name"].startswith("bag: ")]
    assert sum(bool(row["peer"]) for row in bagged) == 6
    others = {
        measure.name
        for measures in (graph.measures, actions.measures, transforms.measures, launch_files.measures)
        for measure in measures(None, 1)
    }
    compared = [row for row in rows if row["name"] in others and row["peer"] is not None]
    assert len(compared) >= 6
    assert all(row["peer"] > 0 for row in [*wires, *bagged, *compared] if row["peer"] is not None)


def test_nothing_else_is_measured_beside_it_if_one_says_so(tmp_path):
    file = tmp_path / "figures.json"
    words = ["bench", "turtles", "--no-peer", "--rounds", "1", "--scale", "0.001"]
    assert main([*words, "--json", str(file)]) == 0
    for row in json.loads(file.read_text(encoding="utf-8"))["figures"]:
        assert row["peer"] is None or row["peer_name"] in PEERS


def test_what_comes_back_of_a_recorded_bag_is_all(tmp_path):
    *_, last = bags.measures(tmp_path, None, 0.01)
    assert last.run(1).ours == 100.0


def test_messages_that_are_lost_on_the_wire_give_no_figure(tmp_path):
    node = tmp_path / "node.py"
    node.write_text("import sys\nfor _ in sys.stdin: print('@ \"lost\"', flush=True)\n", encoding="utf-8")
    process = wire.Process([sys.executable, str(node)], dict(os.environ))
    with closing(process), pytest.raises(RosminiError, match="no figure of the wire: lost"):
        process.ask(do="throughput")
    process = wire.Process([sys.executable, "-c", ""], dict(os.environ))
    with closing(process), pytest.raises(RosminiError, match="ended"):
        process.answer()


def test_a_bag_that_is_not_what_was_written_gives_no_figure(tmp_path):
    bags.write(tmp_path / "x.bag", "string", 10)
    with pytest.raises(RosminiError, match="no figure"):
        bags.read(tmp_path / "x.bag", "string", 11)


def test_a_subscriber_that_misses_something_gives_no_figure(monkeypatch):
    connected = graph._connected
    monkeypatch.setattr(
        graph,
        "_connected",
        lambda kind, callback: connected(kind, lambda message: (callback(message), callback(message))),
    )
    with pytest.raises(RosminiError, match="lost or changed"):
        graph.string_throughput(100, 100)


@pytest.mark.parametrize("words", [["--rounds", "0"], ["--scale", "0"], ["--scale", "nan"]])
def test_wrong_options_are_refused(words, capsys):
    assert main(["bench", "--no-peer", *words]) != 0
    assert "whole number" in capsys.readouterr().err
