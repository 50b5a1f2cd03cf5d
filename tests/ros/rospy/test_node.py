"""init_node, names, shutdown."""

from __future__ import annotations

import sys
import threading

import pytest

from rosmini import Graph, set_default_graph
from rosmini.core.graph import default_graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases import rosgraph

from ...processes import PATIENCE, run


def test_the_environment_gives_a_namespace(programs, monkeypatch):
    monkeypatch.setenv("ROS_NAMESPACE", "fleet")

    def main():
        early = rospy.get_namespace(), rospy.resolve_name("scan")
        rospy.init_node("talker")
        return early, rospy.get_name()

    assert programs(main) == (("/fleet/", "/fleet/scan"), "/fleet/talker")


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


# -- the end -----------------------------------------------------------------------------------------------------


def test_signal_shutdown_before_init_node(programs):
    def main():
        rospy.signal_shutdown("early")
        assert rospy.is_shutdown()
        rospy.spin()
        with pytest.raises(rospy.ROSInitException, match="too late"):
            rospy.init_node("late")

    programs(main)


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
