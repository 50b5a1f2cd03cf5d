"""init_node, names, shutdown."""

from __future__ import annotations

import re
import sys
import threading

import pytest

from rosmini import Graph, set_default_graph
from rosmini.core.errors import IllegalName, TransportException
from rosmini.core.graph import default_graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases import rosgraph

from ...processes import PATIENCE, run


def test_a_node_has_a_name_a_namespace_and_a_uri(programs):
    def main():
        before = rospy.get_name(), rospy.get_namespace(), rospy.get_node_uri(), rospy.core.is_initialized()
        rospy.init_node("talker")
        return before, (rospy.get_name(), rospy.get_caller_id(), rospy.get_namespace())

    before, after = programs(main)
    assert before == ("/unnamed", "/", None, False)
    assert after == ("/talker", "/talker", "/")
    assert default_graph().nodes["/talker"].uri


def test_arguments_rename_and_remap(programs):
    def main():
        rospy.init_node("talker")
        return (
            rospy.get_name(), rospy.get_namespace(), rospy.resolve_name("chatter"), rospy.resolve_name("~x"),
            rospy.resolve_name(""), rospy.resolve_name("a", "/other/node"), rospy.remap_name("chatter"),
            rospy.remap_name("unmapped"), rospy.get_param("~rate"), rospy.myargv(["prog", "a:=b", "-v", "_x:=1"]),
        )  # fmt: skip

    got = programs(main, arguments=("__name:=speaker", "__ns:=robot1", "chatter:=news", "_rate:=10"))
    assert got == (
        "/robot1/speaker", "/robot1/", "/robot1/news", "/robot1/speaker/x", "/robot1/", "/other/a", "/robot1/news",
        "unmapped", 10, ["prog", "-v"],
    )  # fmt: skip


def test_argv_of_init_node_replaces_that_of_the_program(programs):
    def main():
        rospy.init_node("talker", argv=["x", "chatter:=/elsewhere"])
        return rospy.resolve_name("chatter")

    assert programs(main, arguments=("chatter:=/here",)) == "/elsewhere"


def test_the_environment_gives_a_namespace(programs, monkeypatch):
    monkeypatch.setenv("ROS_NAMESPACE", "fleet")

    def main():
        early = rospy.get_namespace(), rospy.resolve_name("scan")
        rospy.init_node("talker")
        return early, rospy.get_name()

    assert programs(main) == (("/fleet/", "/fleet/scan"), "/fleet/talker")


def test_anonymous_nodes_have_different_names(programs):
    def main():
        rospy.init_node("talker", anonymous=True)
        return rospy.get_name()

    names = {programs(main) for _ in range(3)}
    assert len(names) == 3
    assert all(re.fullmatch(r"/talker_\d+_\d+", name) for name in names)


@pytest.mark.parametrize("name", ["", None, "a/b", "/talker", "my-node", "1st"])
def test_an_illegal_name_is_a_value_error(programs, name):
    with pytest.raises(ValueError) as caught:
        programs(lambda: rospy.init_node(name))
    assert isinstance(caught.value, IllegalName)
    if name == "a/b":
        assert "namespaces are not allowed in node names" in str(caught.value)
    if name == "my-node":
        assert "my-node" in str(caught.value)
        assert "\n      ^" in str(caught.value)


def test_a_second_init_node_must_be_the_same(programs):
    def main():
        rospy.init_node("talker", log_level=rospy.DEBUG)
        rospy.init_node("talker", log_level=rospy.DEBUG)
        with pytest.raises(
            rospy.ROSException, match=r"arguments: name='talker', .*, now name='other', .*\. One script is one node"
        ):
            rospy.init_node("other")
        with pytest.raises(rospy.ROSException, match="different arguments"):
            rospy.init_node("talker")
        return rospy.get_name()

    assert programs(main) == "/talker"


def test_the_main_program_has_a_node_too(graph):
    rospy.init_node("notebook")
    assert rospy.get_name() == "/notebook"
    with pytest.raises(rospy.ROSException, match="object API"):
        rospy.init_node("another")
    rospy.signal_shutdown("done")
    assert rospy.is_shutdown()
    rospy.init_node("another")
    assert rospy.get_name() == "/another"
    assert not rospy.is_shutdown()


def test_callbacks_know_their_node(programs):
    def other():
        rospy.init_node("other")
        rospy.spin()

    def main():
        rospy.init_node("main")
        names = []
        publisher = rospy.Publisher("t", String, queue_size=1, latch=True)
        publisher.publish("x")
        rospy.Subscriber("t", String, lambda _: names.append(rospy.get_name()))
        rospy.Timer(rospy.Duration(0.1), lambda _: names.append(rospy.get_name()), oneshot=True)
        rospy.sleep(0.5)
        return names

    assert programs(other, main) == ["/main", "/main"]


def test_an_object_api_node_is_the_node_of_its_callbacks(graph):
    node = graph.node("objects")
    names = []
    node.run(lambda: names.append((rospy.get_name(), rospy.get_time() > 0)))
    graph.run(0.1)
    assert names == [("/objects", True)]


BLOCKING = {
    "Rate": lambda: rospy.Rate(10),
    "Timer": lambda: rospy.Timer(rospy.Duration(1), print),
    "now": rospy.Time.now,
    "get_time": rospy.get_time,
    "get_rostime": rospy.get_rostime,
    "spin": rospy.spin,
    "wait_for_message": lambda: rospy.wait_for_message("chatter", String),
}


@pytest.mark.parametrize("name", BLOCKING)
def test_what_needs_a_node_says_so(sim_programs, name):
    with pytest.raises(rospy.ROSInitException, match=r"rospy\.init_node\("):
        sim_programs(BLOCKING[name])


def test_a_duplicate_name_ends_the_older_node(programs):
    def old():
        rospy.init_node("twin")
        rospy.spin()
        return rospy.is_shutdown()

    def new():
        rospy.sleep(0.1)
        rospy.init_node("twin")
        rospy.sleep(0.5)
        return rospy.is_shutdown()

    first = programs.start(old)
    assert programs(new) is False
    assert first.result is True


# -- the end -----------------------------------------------------------------------------------------------------


def test_shutdown_runs_hooks_in_order_while_one_can_still_publish(programs):
    heard = []

    def listener():
        rospy.init_node("listener")
        rospy.Subscriber("stop", String, lambda message: heard.append(message.data))
        rospy.spin()

    def main():
        early = []
        rospy.on_shutdown(lambda: early.append("before init_node"))
        rospy.init_node("main")
        publisher = rospy.Publisher("stop", String, queue_size=1)
        rospy.sleep(0.3)
        states = []
        rospy.on_shutdown(lambda: (early.append("first"), publisher.publish("stop")))
        rospy.on_shutdown(lambda: states.append((rospy.core.is_shutdown_requested(), rospy.is_shutdown())))
        rospy.core.add_preshutdown_hook(lambda reason: early.append(f"pre: {reason}"))
        rospy.core.add_shutdown_hook(lambda reason: early.append(f"last: {reason}"))
        assert not rospy.core.is_shutdown_requested()
        rospy.signal_shutdown("done")
        rospy.signal_shutdown("again")
        assert rospy.is_shutdown()
        rospy.on_shutdown(lambda: early.append("at once"))
        return early, states

    early, states = programs(listener, main)
    assert early == ["before init_node", "first", "pre: done", "last: done", "at once"]
    assert states == [(True, False)]
    programs.graph.run(0.1)
    assert heard == ["stop"]


def test_a_hook_that_raises_does_not_stop_the_others(programs, log):
    done = []

    def bad():
        raise ValueError("bad hook")

    def main():
        rospy.init_node("main")
        rospy.on_shutdown(bad)
        rospy.on_shutdown(lambda: done.append(1))
        rospy.signal_shutdown("")

    programs(main)
    assert done == [1]
    assert "bad hook" in log.read().err


def test_a_hook_must_be_callable(programs):
    with pytest.raises(TypeError, match="function or another callable"):
        programs(lambda: rospy.on_shutdown("no"))


@pytest.mark.parametrize("what", ["sleep", "rate", "wait_for_message", "wait_for_service", "spin"])
def test_shutdown_ends_what_blocks(programs, what):
    def main():
        rospy.init_node("main")
        rospy.Timer(rospy.Duration(0.2), lambda _: rospy.signal_shutdown("enough"), oneshot=True)
        blocking = {
            "sleep": lambda: rospy.sleep(100),
            "rate": lambda: rospy.Rate(0.01).sleep(),
            "wait_for_message": lambda: rospy.wait_for_message("nothing", String),
            "wait_for_service": lambda: rospy.wait_for_service("nothing"),
            "spin": rospy.spin,
        }
        if what == "spin":
            blocking[what]()
        else:
            with pytest.raises(rospy.ROSInterruptException, match="enough"):
                blocking[what]()
        return rospy.is_shutdown()

    assert programs(main)


def test_signal_shutdown_before_init_node(programs):
    def main():
        rospy.signal_shutdown("early")
        assert rospy.is_shutdown()
        rospy.spin()
        with pytest.raises(rospy.ROSInitException, match="too late"):
            rospy.init_node("late")

    programs(main)


def test_the_runner_is_told_of_the_node_and_of_its_end(programs):
    def main():
        rospy.init_node("main")
        rospy.spin()

    program = programs.start(main)
    programs.graph.run(0.1)
    assert (program.node.name, program.node_name) == ("/main", "/main")
    for end in program.at_shutdown:
        end("the run is over")
    programs.graph.run(0.1)
    assert program.done
    assert program.node.shutdown_reason == "the run is over"


PROGRAM = """
import rosmini
rosmini.install(shadow=True)
import rospy
from std_msgs.msg import String
rosmini.set_default_graph(rosmini.Graph(simulated=False))
rospy.init_node("plain")
rospy.on_shutdown(lambda: print("hook", rospy.get_name()))
rospy.Subscriber("t", String, lambda m: print("heard", m.data))
publisher = rospy.Publisher("t", String, queue_size=1, latch=True)
publisher.publish("x")
rospy.sleep(0.05)
"""


def test_the_hooks_of_a_plain_program_run_at_its_end():
    done = run([sys.executable, "-c", PROGRAM])
    assert (done.stdout.splitlines(), done.stderr, done.returncode) == (["heard x", "hook /plain"], "", 0)


INTERRUPTED = """
import signal
import rosmini
rosmini.install(shadow=True)
import rospy
rosmini.set_default_graph(rosmini.Graph(simulated=False))
rospy.init_node("plain", disable_signals={disabled})
rospy.on_shutdown(lambda: print("hook"))
rospy.Timer(rospy.Duration(0.05), lambda _: signal.raise_signal(signal.SIGINT), oneshot=True)
try:
    {call}
except rospy.ROSInterruptException:
    print("ended", rospy.is_shutdown())
except KeyboardInterrupt:
    print("interrupted", rospy.is_shutdown())
else:
    print("returned", rospy.is_shutdown())
"""


@pytest.mark.parametrize(
    ("call", "disabled", "lines"),
    [
        ("rospy.spin()", False, ["hook", "returned True"]),
        ("rospy.sleep(10)", False, ["hook", "ended True"]),
        ("rospy.Rate(0.1).sleep()", False, ["hook", "ended True"]),
        ("rospy.sleep(10)", True, ["interrupted False", "hook"]),
    ],
)
def test_ctrl_c_shuts_the_node_of_a_plain_program_down(call, disabled, lines):
    program = INTERRUPTED.format(call=call, disabled=disabled)
    done = run([sys.executable, "-c", program])
    assert (done.stdout.splitlines(), done.stderr) == (lines, "")


def test_real_threads_know_the_node_of_the_main_program():
    graph = Graph(simulated=False, strict=False)
    set_default_graph(graph)
    try:
        rospy.init_node("plain")
        heard, names = [], []
        rospy.Subscriber("t", String, lambda message: heard.append((message.data, rospy.get_name())))
        publisher = rospy.Publisher("t", String, queue_size=5)
        rospy.sleep(0.05)

        def work():
            for count in range(3):
                publisher.publish(str(count))
                names.append(rospy.get_name())
                rospy.sleep(0.01)
            rospy.signal_shutdown("done")

        threads = [threading.Thread(target=work), threading.Thread(target=rospy.spin)]
        # Started while the main program drives, so that it is certain who does.
        rospy.Timer(rospy.Duration(0.01), lambda _: [thread.start() for thread in threads], oneshot=True)
        rospy.spin()
        for thread in threads:
            thread.join(PATIENCE)
            assert not thread.is_alive()
        assert names == ["/plain"] * 3
        assert heard == [(str(count), "/plain") for count in range(3)]
    finally:
        graph.shutdown("the test is over")
        set_default_graph(None)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("TimerEvent", "it is rospy.timer.TimerEvent"),
        ("is_shutdown_requested", "it is rospy.core.is_shutdown_requested"),
        ("impl", "the inside of the real one"),
        ("Publsher", "did you mean Publisher"),
        ("nothing_like_it", "the real one has none either"),
    ],
)
def test_what_rospy_has_not_is_named(name, words):
    with pytest.raises(AttributeError, match=words):
        getattr(rospy, name)
    assert not hasattr(rospy, "__nothing__")


def test_a_scoped_name():
    from rosmini.ros.rospy.names import scoped_name

    assert scoped_name("/foo/node", "/foo/bar/name") == "bar/name"
    with pytest.raises(rospy.ROSException, match="must be global"):
        scoped_name("foo", "/foo")


# -- more than one graph -----------------------------------------------------------------------------------------


def test_a_callback_of_another_graph_speaks_for_its_own_node(sim: Graph) -> None:
    rospy.init_node("main")
    rospy.set_param("/where", "default")
    said = []
    with Graph() as other:
        node = other.node("worker")
        node.set_param("/where", "other")
        other.run(5.0)

        def look(_):
            said.append((rospy.get_name(), rospy.get_param("/where"), rospy.get_time(), rospy.is_shutdown()))
            rospy.sleep(1.0)
            said.append((rospy.get_name(), rosgraph.Master("/tool").getParam("/where"), rospy.get_time()))
            rospy.Publisher("answers", String, queue_size=1, latch=True).publish("done")

        node.subscriber("questions", String, look)
        publisher = other.node("asker").publisher("questions", String, latch=True)
        publisher.publish("?")
        other.run(3.0)
        assert said == [("/worker", "other", 1005.0, False), ("/worker", "other", 1006.0)]
        assert "/answers" in node.publications
        assert (rospy.get_name(), rospy.get_param("/where")) == ("/main", "default")
        assert "/answers" not in sim.nodes["/main"].publications


def test_a_program_calls_the_slave_api_of_another_node(programs):
    def main():
        rospy.init_node("asker")
        publisher = default_graph().node("crier").publisher("news", String, latch=True)
        publisher.publish("extra")
        uri = rosgraph.Master("/asker").lookupNode("/crier")
        rosgraph.Master("/crier").unregisterPublisher("/news", uri)  # nobody finds it through the Master
        heard = []
        rospy.Subscriber("news", String, lambda message: heard.append(message.data))
        rospy.sleep(0.5)
        before = list(heard)
        told = rospy.core.xmlrpcapi(rospy.get_node_uri()).publisherUpdate("/master", "/news", [uri])
        rospy.sleep(0.5)
        return rospy.core.xmlrpcapi(uri).getPid("/asker")[0], before, told[0], heard

    assert programs(main) == (1, [], 1, ["extra"])


def test_an_address_of_nobody_does_not_answer(programs):
    def main():
        rospy.init_node("asker")
        with pytest.raises(TransportException):
            rospy.core.xmlrpcapi("http://nobody:1/").getPid("/asker")
        return rospy.core.xmlrpcapi(None), rospy.core.xmlrpcapi("rosrpc://nobody:1")

    assert programs(main) == (None, None)
