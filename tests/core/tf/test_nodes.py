"""The executables of tf and tf2_ros, started by name."""

import pytest

from rosmini import rosrun
from rosmini.core.errors import ScriptError
from rosmini.core.graph import Graph
from rosmini.core.tf import TransformListener
from rosmini.core.tf.rigid import rpy

TIP = ("1", "2", "3", "0.1", "0.2", "0.3")


@pytest.fixture
def graph():
    with Graph() as graph:
        yield graph


def test_tf2s_static_transform_publisher(graph, capsys):
    rosrun("tf2_ros", "static_transform_publisher", *TIP, "base", "laser", "__name:=tip", graph=graph).instance()
    assert "Spinning until killed publishing base to laser" in capsys.readouterr().out
    graph.run(1)
    buffer = TransformListener(graph.node("late")).buffer
    assert buffer.wait_for_transform("base", "laser")
    found = buffer.tree.lookup("base", "laser").transform
    assert found[:3] == (1, 2, 3)
    assert rpy(found) == pytest.approx((0.3, 0.2, 0.1))  # the arguments are yaw, pitch, roll
    # As the real one answers.
    assert found[3:] == pytest.approx(
        (0.14357217502739192, 0.10602051106179562, 0.03427079855048211, 0.9833474432563559)
    )


def test_tf2s_static_transform_publisher_reads_a_parameter(graph):
    node = graph.node("looker")
    buffer = TransformListener(node).buffer
    pose = {"translation": {"x": 0.5, "y": -1, "z": 0.0}, "rotation": {"x": 0.0, "y": 0.0, "z": 1.0, "w": 0.0}}
    node.set_param("/camera", {"header": {"frame_id": "base"}, "child_frame_id": "lens", "transform": pose})
    rosrun("tf2_ros", "static_transform_publisher", "camera", graph=graph).instance()
    graph.run(1)
    assert buffer.tree.lookup("base", "lens").transform == (0.5, -1, 0, 0, 0, 1, 0)
    for value in ({"child_frame_id": "lens"}, 3):
        node.set_param("/camera", value)
        with pytest.raises(ScriptError, match=r"/camera .*frame_id"):
            rosrun("tf2_ros", "static_transform_publisher", "camera", graph=graph).instance()


def test_tfs_static_transform_publisher(graph):
    buffer = TransformListener(graph.node("looker")).buffer
    rosrun(
        "tf", "static_transform_publisher", "1", "0", "0", "0", "0", "0", "2", "map", "base", "100", graph=graph,
    ).instance()  # fmt: skip
    graph.run(2.05)
    edge = buffer.tree.edges["base"]
    assert buffer.tree.lookup("map", "base").transform == (1, 0, 0, 0, 0, 0, 1)
    assert edge.span_ns == (len(edge) - 1) * 100_000_000
    ahead = edge.newest_ns / 1e9 - graph.now().to_sec()
    assert 0 < ahead <= 0.1  # stamped one period ahead


@pytest.mark.parametrize(
    ("package", "arguments", "text"),
    [
        ("tf2_ros", ("1", "2", "3"), "got 3 arguments"),
        ("tf2_ros", (*TIP, "a", "a"), "are the same"),
        ("tf2_ros", ("one", *TIP[1:], "a", "b"), "'one'"),
        ("tf2_ros", ("0", "0", "0", "0", "0", "0", "0", "a", "b"), "no rotation"),
        ("tf", (*TIP, "a", "b"), "got 7 arguments"),
        ("tf", (*TIP, "a", "b", "x"), "'x' as the period"),
        ("tf", (*TIP, "a", "b", "0"), "period must be positive, not 0 ms"),
    ],
)
def test_wrong_arguments_show_the_usage(graph, package, arguments, text):
    with pytest.raises(ScriptError, match="Usage: static_transform_publisher x y z") as info:
        rosrun(package, "static_transform_publisher", *arguments, graph=graph).instance()
    assert text in str(info.value)


def test_tf_echo(graph, capsys):
    rosrun("tf", "static_transform_publisher", *TIP, "base", "laser", "50", graph=graph).instance()
    rosrun(
        "tf2_ros", "static_transform_publisher", "1", "2", "3", "0", "0", "0", "map", "base", "__name:=s",
        graph=graph,
    ).instance()  # fmt: skip
    rosrun("tf", "tf_echo", "map", "laser", "2", graph=graph).instance()
    graph.run(1.01)
    out = capsys.readouterr().out
    assert out.count("At time ") == 3
    # As the real one prints the same transform.
    assert (
        "- Translation: [2.000, 4.000, 6.000]\n"
        "- Rotation: in Quaternion [0.144, 0.106, 0.034, 0.983]\n"
        "            in RPY (radian) [0.300, 0.200, 0.100]\n"
        "            in RPY (degree) [17.189, 11.459, 5.730]\n"
    ) in out


def test_tf_echo_of_what_is_not_there(graph, capsys):
    rosrun("tf2_ros", "static_transform_publisher", *TIP, "map", "base", graph=graph).instance()
    rosrun("tf", "tf_echo", "map", "nope", graph=graph).instance()
    out = capsys.readouterr().out
    assert 'Exception thrown:"nope" passed to lookupTransform argument source_frame does not exist.' in out
    assert out.endswith("The current list of frames is:\nFrame base exists with parent map.\n\n")
    with pytest.raises(ScriptError, match="does not take the arguments"):
        rosrun("tf", "tf_echo", "map", graph=graph).instance()
    with pytest.raises(ScriptError, match="'often' is not a rate"):
        rosrun("tf", "tf_echo", "map", "base", "often", graph=graph).instance()


def test_tf_monitor(graph, capsys):
    rosrun("tf", "static_transform_publisher", *TIP, "map", "base", "100", "__name:=a", graph=graph).instance()
    rosrun("tf2_ros", "static_transform_publisher", *TIP, "base", "laser", "__name:=b", graph=graph).instance()
    monitor = rosrun("tf", "tf_monitor", graph=graph).instance()
    graph.run(2.05)
    capsys.readouterr()
    monitor.report()
    assert capsys.readouterr().out == (
        "\n\n\nRESULTS: for all Frames\n\nFrames:\n"
        "Frame: base published by /a Average Delay: -0.1 Max Delay: 0\n"
        "Frame: laser published by /b(static) Average Delay: 0 Max Delay: 0\n\n"
        "All Broadcasters:\n"
        "Node: /a 10 Hz, Average Delay: -0.1 Max Delay: 0\n"
        "Node: /b(static) 1e+08 Hz, Average Delay: 0 Max Delay: 0\n"
    )
    rosrun("tf", "tf_monitor", "map", "laser", "__name:=m", graph=graph).instance()
    graph.run(1.5)
    assert (
        "RESULTS: for map to laser\nChain is: map -> base -> laser\nNet delay     avg = -0.1" in capsys.readouterr().out
    )
    with pytest.raises(ScriptError, match="two frames make a chain"):
        rosrun("tf", "tf_monitor", "map", "__name:=n", graph=graph).instance()


def test_view_frames(graph, capsys, tmp_path):
    rosrun("tf", "static_transform_publisher", *TIP, "map", "base", "100", "__name:=a", graph=graph).instance()
    viewed = rosrun("tf", "view_frames", str(tmp_path), graph=graph).instance()
    assert capsys.readouterr().out == (
        "Listening to /tf for 5.0 seconds\nDone Listening\nframes.gv and frames.svg generated\n"
    )
    text = (tmp_path / "frames.gv").read_text(encoding="utf-8")
    assert text.startswith('digraph G {\n"map" -> "base"[label="Broadcaster: /a\\nAverage rate: 10.')
    assert (tmp_path / "frames.svg").read_text(encoding="utf-8").startswith("<svg")
    assert "map -> base: Broadcaster: /a, Average rate: 10." in viewed.picture.text
