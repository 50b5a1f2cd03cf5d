"""rqt_graph: what is shown, in words and in the picture."""

import re
import xml.etree.ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import RosminiError
from rosmini.core.graph.master import Master
from rosmini.viz import ViewError, rqt_graph
from rosmini.viz.rqt.graph_state import GraphState
from rosmini.viz.rqt.selection import matches

SVG = "{http://www.w3.org/2000/svg}"


def state(*flows, services=(), **more):
    """A state from lines such as "/talker -> /chatter std_msgs/String -> /listener"."""
    publishers = {}
    subscribers = {}
    types = {}
    for flow in flows:
        sources, topic, sinks = (part.strip() for part in flow.split("->"))
        topic, kind = topic.split()
        publishers.setdefault(topic, []).extend(sources.split())
        subscribers.setdefault(topic, []).extend(sinks.split())
        types[topic] = kind
    system = [
        [[t, n] for t, n in publishers.items() if n],
        [[t, n] for t, n in subscribers.items() if n],
        [[f"{node}/get_loggers", [node]] for node in services],
    ]
    return GraphState.of(system, types.items(), **more)


CHATTER = "/talker -> /chatter std_msgs/String -> /listener"
LOG = "/talker /listener -> /rosout rosgraph_msgs/Log -> /rosout"
AGG = "/rosout -> /rosout_agg rosgraph_msgs/Log ->"
ACTION = [
    "/explore -> /move_base/goal move_base_msgs/MoveBaseActionGoal -> /move_base",
    "/explore -> /move_base/cancel actionlib_msgs/GoalID -> /move_base",
    "/move_base -> /move_base/status actionlib_msgs/GoalStatusArray -> /explore",
    "/move_base -> /move_base/feedback move_base_msgs/MoveBaseActionFeedback -> /explore",
    "/move_base -> /move_base/result move_base_msgs/MoveBaseActionResult -> /explore",
]


class FakeMaster:
    """Answers as the ROS Master does (shared/ros_transcripts/wire_xmlrpc_tcpros.txt)."""

    def getSystemState(self, caller_id):
        system = [
            [["/rosout_agg", ["/rosout"]], ["/chatter", ["/talker"]], ["/rosout", ["/talker", "/listener"]]],
            [["/rosout", ["/rosout"]], ["/chatter", ["/listener"]]],
            [["/rosout/get_loggers", ["/rosout"]], ["/set_bool", ["/srv_server"]]],
        ]
        return [1, "current system state", system]

    def getTopicTypes(self, caller_id):
        types = [
            ["/rosout_agg", "rosgraph_msgs/Log"],
            ["/rosout", "rosgraph_msgs/Log"],
            ["/chatter", "std_msgs/String"],
        ]
        return [1, "current system state", types]


def drawn(view, kind):
    """The texts of all nodes, topics or edges in the picture."""
    root = ET.fromstring(view.svg)
    groups = [g for g in root.iter(f"{SVG}g") if kind in (g.get("class") or "").split()]
    return sorted(text.text or "" for g in groups for text in g.findall(f"{SVG}text"))


def test_talker_and_listener_of_a_master_with_the_default_switches():
    view = rqt_graph(FakeMaster())
    assert view.text == (
        "rqt_graph: 3 nodes, 1 topic (hidden: 1 node and 2 topics)\n"
        "/talker -> /chatter [std_msgs/String] -> /listener\n"
        "/srv_server (not connected)"
    )
    for part in ("3 nodes", "1 topic", "/talker publishes /chatter to /listener"):
        assert part in view.alt
    assert drawn(view, "rm-node") == ["/listener", "/srv_server", "/talker"]
    assert drawn(view, "rm-edge") == ["/chatter"]


@pytest.mark.parametrize("mode", ["nodes_only", "nodes_topics_all"])
def test_what_is_new_and_what_is_gone_since_an_earlier_state(mode):
    before = state(CHATTER, "/talker -> /old std_msgs/String -> /ended")
    after = state(CHATTER, "/talker -> /chatter std_msgs/String -> /late")
    view = rqt_graph(after, mode=mode, since=before)
    *_, new, gone = view.text.splitlines()
    if mode == "nodes_only":
        assert new == "new: /late, /talker -> /chatter -> /late"
        assert gone == "gone: /ended, /talker -> /old -> /ended"
    else:
        assert new == "new: /late, /chatter -> /late"
        assert gone == "gone: /ended, /old, /talker -> /old, /old -> /ended"
    svg = ET.fromstring(view.svg)
    marked = {
        change: sorted(
            group.find(f"{SVG}title").text for group in svg.iter(f"{SVG}g") if change in group.get("class", "")
        )
        for change in ("rm-new", "rm-gone")
    }
    assert "node /late" in marked["rm-new"] and "node /ended" in marked["rm-gone"]
    assert len(marked["rm-new"]) == new.count(",") + 1
    assert len(marked["rm-gone"]) == gone.count(",") + 1
    assert new.partition(": ")[2] in view.alt
    same = rqt_graph(after, mode=mode, since=after)
    assert same.svg == rqt_graph(after, mode=mode).svg
    assert "rm-new" not in same.svg


def test_the_real_master_is_a_source():
    class Silent:
        def publisher_update(self, caller_api, topic, uris):
            pass

        def param_update(self, caller_api, key, value):
            pass

        def shutdown(self, caller_api, reason):
            pass

        def registrations_changed(self):
            pass

    master = Master("http://localhost:11311/", Silent())
    master.registerPublisher("/talker", "/chatter", "std_msgs/String", "http://localhost:1/")
    master.registerSubscriber("/listener", "/chatter", "*", "http://localhost:2/")
    master.registerService("/adder", "/add", "rosrpc://localhost:3", "http://localhost:4/")
    assert rqt_graph(master).text.splitlines()[1:] == [
        "/talker -> /chatter [std_msgs/String] -> /listener",
        "/adder (not connected)",
    ]


def test_without_hiding_everything_is_there_and_all_topics_are_boxes():
    view = rqt_graph(state(CHATTER, LOG, AGG), mode="nodes_topics_all", hide=())
    assert view.text == (
        "rqt_graph: 3 nodes, 3 topics\n"
        "/talker -> /chatter [std_msgs/String] -> /listener\n"
        "/listener, /talker -> /rosout [rosgraph_msgs/Log] -> /rosout\n"
        "/rosout -> /rosout_agg [rosgraph_msgs/Log] -> (no subscriber)"
    )
    assert drawn(view, "rm-topic") == ["/chatter", "/rosout", "/rosout_agg"]
    assert drawn(view, "rm-node") == ["/listener", "/rosout", "/talker"]
    assert "to nobody" in view.alt


@pytest.mark.parametrize(
    ("switch", "kept"),
    [
        ((), {"/chatter", "/one", "/sink", "/tf", "/p/parameter_updates", "/p/parameter_descriptions", "/clock"}),
        (("dead_sinks",), {"/chatter", "/one", "/tf", "/p/parameter_updates", "/p/parameter_descriptions", "/clock"}),
        (("leaf_topics",), {"/chatter", "/tf", "/p/parameter_updates", "/p/parameter_descriptions", "/clock", "/sink"}),
        (("params",), {"/chatter", "/one", "/sink", "/tf", "/clock"}),
        (("tf",), {"/chatter", "/one", "/sink", "/p/parameter_updates", "/p/parameter_descriptions", "/clock"}),
        (("debug",), {"/chatter", "/one", "/sink", "/tf", "/p/parameter_updates", "/p/parameter_descriptions"}),
    ],
)
def test_each_switch_hides_its_topics(switch, kept):
    graph = state(
        CHATTER,
        "-> /one std_msgs/String -> /listener",
        "/talker /listener -> /sink std_msgs/String ->",
        "/talker -> /tf tf2_msgs/TFMessage -> /listener",
        "/talker -> /p/parameter_updates dynamic_reconfigure/Config -> /listener",
        "/talker -> /p/parameter_descriptions dynamic_reconfigure/ConfigDescription -> /listener",
        "/talker -> /clock rosgraph_msgs/Clock -> /listener",
    )
    view = rqt_graph(graph, mode="nodes_topics_all", hide=switch, group=())
    assert set(drawn(view, "rm-topic")) == kept


def test_a_node_that_does_not_answer_is_marked_or_hidden():
    graph = state(CHATTER, unreachable=["/listener"])
    marked = rqt_graph(graph, hide=("debug",))
    assert drawn(marked, "rm-bad") == ["/listener"]
    assert marked.text.endswith("/listener does not answer")
    assert marked.alt.endswith(". /listener does not answer.")
    hidden = rqt_graph(graph)
    assert drawn(hidden, "rm-node") == ["/talker"]
    assert "0 topics (hidden: 1 node)" in hidden.text and "/talker (not connected)" in hidden.text


def test_the_topics_of_an_action_and_of_tf_are_one_box_each():
    graph = state(*ACTION, "/amcl -> /tf tf2_msgs/TFMessage -> /x", "/amcl -> /tf_static tf2_msgs/TFMessage -> /x")
    view = rqt_graph(graph, mode="nodes_topics_active")
    assert drawn(view, "rm-topic") == ["/move_base/action_topics", "/tf"]
    assert "/explore, /move_base -> /move_base/action_topics -> /explore, /move_base" in view.text
    assert "stands for /move_base/cancel [actionlib_msgs/GoalID], /move_base/feedback" in view.text
    assert len(drawn(rqt_graph(graph, mode="nodes_topics_active", group=()), "rm-topic")) == 7


def test_namespaces_are_boxes_as_deep_as_asked_for():
    graph = state("/robot/nav/a -> /t std_msgs/String -> /robot/b")

    def boxes(depth):
        return re.findall(r"<title>namespace ([^<]*)</title>", rqt_graph(graph, namespaces=depth).svg)

    assert boxes(0) == []
    assert boxes(1) == ["/robot"]
    assert boxes(2) == ["/robot", "/robot/nav"]


@pytest.mark.parametrize(
    ("patterns", "name", "through"),
    [
        ("/", "/any/name", True),
        ("", "/any/name", True),
        ("/talker", "/talker", True),
        ("/talker", "/talker_2", False),
        ("/robot1/.*", "/robot1/amcl", True),
        ("/robot1/.*, /map_server", "/map_server", True),
        ("-/rqt.*", "/rqt_console", False),
        ("-/rqt.*", "/talker", True),
        ("/robot.*,-/robot2/.*", "/robot2/amcl", False),
    ],
)
def test_filters_are_read_as_rqt_graph_reads_them(patterns, name, through):
    assert matches(name, patterns) is through


def test_filters_choose_nodes_and_topics():
    graph = state(CHATTER, "/camera -> /image sensor_msgs/Image -> /listener")
    assert drawn(rqt_graph(graph, namespace="-/camera"), "rm-node") == ["/listener", "/talker"]
    assert drawn(rqt_graph(graph, topics="/image"), "rm-edge") == ["/image"]


def test_a_filter_whose_topics_are_all_hidden_says_what_draws_them():
    graph = state(CHATTER, "/camera -> /image sensor_msgs/Image -> ")
    view = rqt_graph(graph, topics="/image")
    assert "/image: not drawn. A topic without a connection is drawn in mode all" in view.text
    assert "not hidden (debug, dead_sinks, leaf_topics" in view.html
    assert "not drawn" not in rqt_graph(graph, topics="/image", mode="nodes_topics_all", hide=()).text
    assert "No topic matches /imagge." in rqt_graph(graph, topics="/imagge").text


def test_loops_and_parallel_edges_are_all_drawn():
    graph = state(
        "/a -> /x std_msgs/String -> /a /b", "/a -> /y std_msgs/String -> /a /b", "/b -> /z std_msgs/String -> /a"
    )
    assert drawn(rqt_graph(graph), "rm-edge") == ["/x", "/x", "/y", "/y", "/z"]


@pytest.mark.parametrize("mode", ["nodes_only", "nodes_topics_all", "nodes_topics_active"])
def test_an_empty_graph_says_so(mode):
    view = rqt_graph(GraphState(), mode=mode)
    assert view.text == "rqt_graph: 0 nodes, 0 topics"
    assert "nothing" in view.alt
    assert "(no node to show)" in view.svg


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: rqt_graph(42), "cannot draw a int"),
        (lambda: rqt_graph([[], []]), "getSystemState"),
        (lambda: rqt_graph(GraphState(), mode="node_only"), "did you mean nodes_only"),
        (lambda: rqt_graph(GraphState(), hide=("debugs",)), "did you mean debug"),
        (lambda: rqt_graph(GraphState(), group=("action",)), "did you mean actions"),
        (lambda: rqt_graph(state(CHATTER), namespace="/robot[1"), "neither a name nor a regular expression"),
    ],
)
def test_a_wrong_argument_is_an_error_that_says_what_would_do(call, message):
    with pytest.raises(ViewError, match=re.escape(message)) as caught:
        call()
    assert isinstance(caught.value, RosminiError)


def test_a_master_that_refuses_is_an_error():
    class Refusing(FakeMaster):
        def getSystemState(self, caller_id):
            return [-1, "caller_id must be a name", ""]

    with pytest.raises(ViewError, match="refused getSystemState: caller_id must be a name"):
        rqt_graph(Refusing())


hostile = st.text(min_size=1, max_size=12).map(lambda text: "/" + text.replace(",", "").replace("\n", ""))
triples = st.lists(st.tuples(hostile, hostile, hostile), max_size=8)


@given(triples, st.sampled_from(["nodes_only", "nodes_topics_all", "nodes_topics_active"]))
def test_every_name_is_in_the_text_and_in_well_formed_svg_whatever_it_is(flows, mode):
    publishers = {}
    subscribers = {}
    for source, topic, sink in flows:
        publishers.setdefault(topic, set()).add(source)
        subscribers.setdefault(topic, set()).add(sink)
    system = [[[t, sorted(n)] for t, n in side.items()] for side in (publishers, subscribers)]
    view = rqt_graph(GraphState.of([*system, []]), mode=mode, hide=(), group=(), namespaces=0)
    ET.fromstring(view.svg)  # raises if a name broke it
    shown = drawn(view, "rm-node") + drawn(view, "rm-topic" if mode != "nodes_only" else "rm-edge")
    for name in {name for flow in flows for name in flow}:
        assert name in view.text
        cleaned = "".join(c if c.isprintable() else "" for c in name)
        assert any("".join(c for c in text if c.isprintable() and c != "\N{REPLACEMENT CHARACTER}")
                   == cleaned.replace("\N{REPLACEMENT CHARACTER}", "") for text in shown)  # fmt: skip


@given(triples, st.randoms(use_true_random=False))
def test_the_order_of_registration_does_not_change_a_byte(flows, random):
    def picture():
        publishers = {}
        subscribers = {}
        for source, topic, sink in flows:
            publishers.setdefault(topic, []).append(source)
            subscribers.setdefault(topic, []).append(sink)
        return rqt_graph(GraphState.of([publishers.items(), subscribers.items(), []]), mode="nodes_topics_all", hide=())

    before = picture()
    random.shuffle(flows)
    after = picture()
    assert (before.text, before.alt, before.svg) == (after.text, after.alt, after.svg)
