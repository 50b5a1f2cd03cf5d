"""The tools of rqt as commands: pages in a terminal, views in Python."""

import webbrowser
from types import SimpleNamespace

import numpy as np
import pytest

import rosmini.tools.main as cli
from rosmini import Graph, rosrun
from rosmini.core.errors import UsageError
from rosmini.core.time import Time
from rosmini.core.verbs import Call, VerbError
from rosmini.msgs.geometry_msgs.msg import TransformStamped
from rosmini.msgs.sensor_msgs.msg import Image
from rosmini.msgs.std_msgs.msg import Float64, String
from rosmini.msgs.tf2_msgs.msg import TFMessage
from rosmini.ros.bag import Bag
from rosmini.viz.rqt.plugin import plugins
from rosmini.viz.verbs.rqt import TOOL, Shown


@pytest.fixture
def graph():
    with Graph() as made:
        node = made.node("talker")
        number, chatter = node.publisher("number", Float64), node.publisher("chatter", String)
        image = node.publisher("image", Image)
        frames = node.publisher("/tf", TFMessage)
        made.node("listener").subscriber("chatter", String, lambda _: None)
        pixels = np.zeros((2, 2, 3), np.uint8)

        def tick(_):
            number.publish(3.0)
            chatter.publish("x")
            image.publish(Image(height=2, width=2, encoding="rgb8", step=6, data=pixels.tobytes()))
            one = TransformStamped(child_frame_id="base")
            one.header.frame_id, one.header.stamp = "odom", made.now()
            one.transform.rotation.w = 1.0
            frames.publish(TFMessage([one]))
            node.loginfo("tick")

        node.timer(0.2, tick)
        yield made


def shown(graph, line):
    result = TOOL.run(*line.split(), graph=graph)
    assert isinstance(result, Shown)
    assert result.path is None
    return result


@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("graph", "/talker -> /chatter [std_msgs/String] -> /listener"),
        ("graph --mode all --hide none", "/rosout"),
        ("graph --title Chatter", "Chatter: 2 nodes"),
        ("plot number/data --duration 1", "/number/data: 4 points, from 3.00 to 3.00"),
        ("plot --title Number number/data --duration 1", "Number: "),
        ("topic --duration 1", "/chatter"),
        ("topic chatter --duration 1", "'x'"),
        ("console --duration 1", "tick"),
        ("tf_tree --duration 1", "odom -> base: Broadcaster: /talker"),
        ("image_view image", "2 x 2"),
        ("msg std_msgs/String", "data"),
        ("srv std_srvs/SetBool", "request/data"),
        ("action actionlib_tutorials/Fibonacci", "goal/order"),
    ],
)
def test_a_verb_returns_what_it_shows_and_leaves_no_node(graph, line, text):
    nodes = list(graph.nodes)
    result = shown(graph, line)
    assert text in str(result)
    assert str(result) == result.view.text
    data, _ = result._repr_mimebundle_()
    assert data["text/plain"] == result.view.text
    assert list(graph.nodes) == nodes


def test_what_cannot_be_shown_is_said(graph):
    with pytest.raises(VerbError, match=r"no image came on /none in 0\.5 s"):
        shown(graph, "image_view none --duration 0.5")
    for line in ("graph --mode most", "msg", "bag", "image_view a b", "polt x"):
        with pytest.raises(UsageError):
            shown(graph, line)


@pytest.mark.parametrize(
    "line", ["publisher", "service_caller /talker/get_loggers", "logger_level talker", "reconfigure"]
)
def test_a_panel_opens_in_a_notebook_and_goes_on(graph, line):
    panel = shown(graph, line).view
    assert panel.text.startswith(f"rqt_{line.split(maxsplit=1)[0]}\n")
    assert f"/rqt_{line.split(maxsplit=1)[0]}" in graph.nodes
    with pytest.raises(UsageError):
        shown(graph, f"{line} a b")


def test_robot_steering_drives_the_robot_of_the_simulator():
    graph = Graph()
    sim = rosrun("rosmini_sim", "simulator", "_world:=room", graph=graph).instance()
    pad = shown(graph, "robot_steering --title Drive").view
    pad.press("w", times=10)
    graph.run(3.0)
    assert pad.text.startswith("Drive\n")
    assert sim.truth()[0] > 0.1
    with pytest.raises(UsageError):
        shown(graph, "robot_steering a b")
    graph.shutdown()


@pytest.mark.parametrize(
    "line",
    [
        "graph --live --highlight /talker --group none",
        "plot --live number/data",
        "topic --live chatter",
        "console --live",
        "tf_tree --live",
        "image_view --live image",
    ],
)
def test_what_goes_on_is_for_notebooks(graph, line):
    panel = shown(graph, line).view
    graph.run(1.0)
    assert panel.text.startswith(f"rqt_{line.split(maxsplit=1)[0]}\n")
    assert f"/rqt_{line.split(maxsplit=1)[0]}" in graph.nodes
    verb = TOOL.verbs[line.split(maxsplit=1)[0]]
    given = verb.parser().parse(line.split()[1:])
    with pytest.raises(VerbError, match="--live is for notebooks"):
        verb.act(given, Call(graph, read_line=input))


def test_a_window_opens_in_a_notebook_and_a_terminal_names_the_commands(graph, tmp_path, capsys):
    window = shown(graph, "gui rqt_console Plot").view
    assert [panel.tool for panel in window.running.values()] == ["rqt_console", "rqt_plot"]
    window.export_file(tmp_path / "my.perspective")
    assert cli.main(["rqt_gui", "--perspective-file", str(tmp_path / "my.perspective"), "rqt_moveit"]) == 2
    out = capsys.readouterr().out.splitlines()[1:]
    assert out == [
        "  rqt_console/Console: rosmini rqt_console",
        "  rqt_plot/Plot: rosmini rqt_plot",
        "  rqt_moveit: not here",
    ]


@pytest.mark.parametrize(
    ("tool", "instead"), [(each.tool, each.instead) for each in plugins() if each.instead and each.group]
)
def test_a_terminal_names_the_command_that_does_the_same(tool, instead, capsys):
    assert cli.main([tool]) == 2
    assert f"rosmini {instead}" in capsys.readouterr().err
    assert instead.split(maxsplit=1)[0] in cli.COMMANDS


def test_a_terminal_writes_a_page_and_opens_it(tmp_path, monkeypatch, capsys):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    given = TOOL.verbs["msg"].parser().parse(["std_msgs/String"])
    result = TOOL.verbs["msg"].act(given, Call(SimpleNamespace(), read_line=input))
    assert isinstance(result, Shown)
    assert result.path is not None
    assert opened == [result.path.as_uri()]
    assert str(result).endswith(f"\n{opened[0]}")
    assert "std_msgs/String" in result.path.read_text(encoding="utf-8")
    assert result.path.is_relative_to(tmp_path)
    assert capsys.readouterr().out == ""


def test_a_file_that_is_named_is_written_and_nothing_is_opened(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(webbrowser, "open", lambda _: pytest.fail("a browser was opened"))
    with Bag(tmp_path / "run.bag", "w") as bag:
        bag.write("/chatter", String("x"), Time(1))
    page = tmp_path / "bag.svg"
    assert cli.main(["rqt_bag", str(tmp_path / "run.bag"), "-o", str(page)]) == 0
    assert page.read_text(encoding="utf-8").startswith("<svg")
    assert str(page) in capsys.readouterr().out


def test_a_bag_that_cannot_be_opened(tmp_path, capsys):
    for file in (tmp_path, tmp_path / "missing.bag"):
        assert cli.main(["rqt_bag", str(file)]) == 1
        said = capsys.readouterr().err
        assert str(file) in said
        assert "Traceback" not in said
