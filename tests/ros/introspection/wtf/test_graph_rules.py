"""Each rule finds what it is for, and nothing in a graph that is well."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from rosmini.ros.introspection.nodes import Flow
from rosmini.ros.introspection.wtf import graph_rules
from rosmini.ros.introspection.wtf.graph_rules import RULES
from rosmini.ros.introspection.wtf.survey import Node, Survey

Ends = Mapping[str, tuple[str, str]]


def node(name: str, published: dict[str, str], subscribed: dict[str, str], *sources: str, host: str = "here") -> Node:
    """A node; ``sources`` are topics and publishers: `/chatter /talker`."""
    pairs = frozenset(tuple(each.split()) for each in sources)
    return Node(name, f"http://{host}:1{len(name)}/", published, subscribed, pairs)  # type: ignore[arg-type]


def survey(*nodes: Node, parameters: dict[str, Any] | None = None) -> Survey:
    def ends(side: str) -> dict[str, tuple[str, ...]]:
        topics = sorted({topic for each in nodes for topic in getattr(each, side)})
        return {topic: tuple(each.name for each in nodes if topic in getattr(each, side)) for topic in topics}

    known = {each.name: each for each in nodes}
    return Survey(known, ends("published"), ends("subscribed"), {}, parameters or {})


TEXT, NUMBER, TWIST = "std_msgs/String", "std_msgs/Int32", "geometry_msgs/Twist"
TALKER = node("/talker", {"/chatter": TEXT}, {})
LISTENER = node("/listener", {}, {"/chatter": TEXT}, "/chatter /talker")


def found(graph: Survey) -> dict[str, tuple[str, ...]]:
    return {each.rule: each.where for rule in RULES for each in rule(graph)}


def test_a_graph_that_is_well_has_no_findings() -> None:
    assert found(survey(TALKER, LISTENER)) == {}
    clocked = node("/gazebo", {"/clock": "rosgraph_msgs/Clock"}, {})
    assert found(survey(TALKER, LISTENER, clocked, parameters={"use_sim_time": True, "talker": {"rate": 1}})) == {}


def test_nodes_that_do_not_answer_are_listed_and_not_held_against_others() -> None:
    dead = Node("/dead", "http://here:9/", silence="ERROR: connection refused to [http://here:9/]")
    graph = Survey({"/dead": dead, "/listener": node("/listener", {}, {"/x": TEXT})}, {"/x": ("/dead",)},
                   {"/x": ("/listener",)}, {}, {})  # fmt: skip
    assert found(graph) == {"silent_nodes": ("/dead: connection refused to [http://here:9/]",)}


def test_dropped_messages_are_counted_and_those_of_tools_left_out() -> None:
    flows = (
        Flow("/chatter", "/talker", "/listener", "subscriber", 7),
        Flow("/x", "/talker", "/listener", "subscriber", 0),
    )
    listener = replace(LISTENER, flows=flows)
    tool = replace(LISTENER, name="/rqt_plot_1", flows=(Flow("/chatter", "/talker", "/rqt_plot_1", "subscriber", 9),))
    (where,) = found(survey(TALKER, listener, tool))["dropped_messages"]
    assert all(part in where for part in ("/talker", "/listener", "/chatter", " 7 "))


def test_types_that_differ_are_named_with_their_nodes() -> None:
    graph = survey(TALKER, node("/other", {"/chatter": NUMBER}, {}), LISTENER)
    assert found(graph) == {"types_differ": ("/chatter:", f" {NUMBER}: /other", f" {TEXT}: /listener, /talker")}


def test_a_subscriber_of_any_type_agrees_with_all() -> None:
    assert found(survey(TALKER, node("/any", {}, {"/chatter": "*"}, "/chatter /talker"))) == {}


def test_one_type_and_no_connection_is_an_error() -> None:
    deaf = node("/deaf", {}, {"/chatter": TEXT})
    assert found(survey(TALKER, LISTENER, deaf)) == {"not_connected": ("/talker -> /deaf (/chatter)",)}
    by_address = node("/deaf", {}, {"/chatter": TEXT}, f"/chatter {TALKER.uri}")
    assert found(survey(TALKER, by_address)) == {}


def test_a_node_that_hears_itself_needs_no_connection() -> None:
    assert found(survey(node("/echo", {"/chatter": TEXT}, {"/chatter": TEXT}))) == {}


@pytest.mark.parametrize(
    ("wanted", "hint"),
    [("/chater", "did you mean /chatter?"), ("/robot/chatter", "did you mean /chatter?"), ("/something/else", None)],
)
def test_a_topic_that_nobody_publishes_is_listed_with_what_was_meant(wanted: str, hint: str | None) -> None:
    where = found(survey(TALKER, node("/deaf", {}, {wanted: TEXT})))["no_publisher"]
    assert where == (f"{wanted}, to which /deaf subscribes", *([f" {hint}"] if hint else []))


def test_a_topic_of_another_type_was_not_meant() -> None:
    graph = survey(TALKER, node("/a", {}, {"/chater": NUMBER}), node("/b", {}, {"/chater": NUMBER}))
    [(rule, (line,))] = found(graph).items()
    assert rule == "no_publisher" and re.findall(r"/\w+", line) == ["/chater", "/a", "/b"]


def test_a_master_alone_is_in_order() -> None:
    assert found(survey(node("/rosout", {"/rosout_agg": TEXT}, {"/rosout": TEXT}))) == {}


def test_what_tools_listen_to_is_no_matter() -> None:
    assert found(survey(node("/rostopic_1_2", {}, {"/nothing": TEXT}))) == {}


def test_simulated_time_without_a_clock_and_a_clock_without_simulated_time() -> None:
    clock = {"/clock": "rosgraph_msgs/Clock"}
    assert found(survey(parameters={"use_sim_time": True})) == {"no_clock": ()}
    assert found(survey(node("/stage", clock, {}))) == {"clock_unused": ("/stage",)}
    two = survey(node("/stage", clock, {}), node("/play", clock, {}), parameters={"use_sim_time": True})
    assert found(two) == {"several_clocks": ("/stage", "/play")}


def test_two_nodes_that_drive_one_robot() -> None:
    pad, planner = node("/pad", {"/cmd_vel": TWIST}, {}), node("/move_base", {"/cmd_vel": TWIST}, {})
    assert found(survey(pad, planner)) == {"several_drivers": ("/cmd_vel: /pad, /move_base",)}
    assert found(survey(pad)) == {}


def test_parameters_of_a_name_that_is_almost_a_node() -> None:
    amcl = node("/amcl", {}, {})
    assert found(survey(amcl, parameters={"ammcl": {"a": 1}})) == {
        "strangers_parameters": ("/ammcl: did you mean amcl?",)
    }
    assert found(survey(amcl, parameters={"something_else": {"a": 1}, "amcl": {}, "rate": 3})) == {}
    robots = survey(node("/robot1", {}, {}), node("/robot2/amcl", {}, {}), parameters={"robot2": {"amcl": {}}})
    assert found(robots) == {}


def test_an_address_of_this_machine_only_in_a_graph_of_several() -> None:
    far = node("/far", {}, {}, host="10.0.0.3")
    assert found(survey(node("/near", {}, {}, host="127.0.0.1"), far)) == {"loopback_addresses": ("/near (127.0.0.1)",)}
    assert found(survey(node("/near", {}, {}, host="localhost"))) == {}


def test_every_rule_of_the_module_is_asked() -> None:
    own = {name for name, each in vars(graph_rules).items() if getattr(each, "__module__", "") == graph_rules.__name__}
    assert {name for name in own if not name.startswith("_")} == {rule.__name__ for rule in RULES}
