"""`rosrun dynamic_reconfigure dynparam`: what it prints, changes and refuses."""

from __future__ import annotations

import io

import pytest

from rosmini import Graph
from rosmini.ros.scripts import rosrun


@pytest.fixture
def graph():
    with Graph() as graph:
        rosrun("amcl", "amcl", graph=graph)
        graph.run(1.0)
        yield graph


def dynparam(graph, *words):
    """What it printed, and its exit status."""
    said = io.StringIO()
    handle = rosrun("dynamic_reconfigure", "dynparam", *words, graph=graph, stdout=said, stderr=said, prefix=False)
    graph.run(2.0)
    return said.getvalue(), handle.poll()


def test_it_lists_sets_and_gets(graph):
    assert dynparam(graph, "list") == ("/amcl\n", 0)
    assert dynparam(graph, "set", "/amcl", "laser_max_beams", "17") == ("", 0)
    assert dynparam(graph, "set", "/amcl", "{update_min_d: 0.3, laser_z_hit: 0.6}") == ("", 0)
    values, status = dynparam(graph, "get", "/amcl")
    assert status == 0
    for expected in ("'laser_max_beams': 17,", "'update_min_d': 0.3,", "'laser_z_hit': 0.6,"):
        assert expected in values


def test_a_file_keeps_what_was_set(graph, tmp_path):
    file = str(tmp_path / "amcl.yaml")
    dynparam(graph, "set", "/amcl", "laser_max_beams", "17")
    assert dynparam(graph, "dump", "/amcl", file) == ("", 0)
    dynparam(graph, "set", "/amcl", "laser_max_beams", "30")
    assert dynparam(graph, "load", "/amcl", file) == ("", 0)
    assert "'laser_max_beams': 17," in dynparam(graph, "get", "/amcl")[0]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("set", "/amcl", "laser_max_beems", "3"), "error updating parameters: "),
        (("set", "/amcl", "17"), "give a parameter and its value, or a YAML dictionary"),
        (("set_from_parameters", "/nobody"), "no parameters found on parameter server"),
        (("get", "-t", "1", "/nobody"), "/nobody/set_parameters"),
        (("load", "/amcl", "/no/such.yaml"), "/no/such.yaml"),
    ],
)
def test_what_it_cannot_do_it_says(graph, words, expected):
    said, status = dynparam(graph, *words)
    assert expected in said
    assert "Traceback" not in said
    assert status == 1
