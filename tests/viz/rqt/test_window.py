"""The window: plugins are opened from its menus, run beside one another, and are saved as perspectives."""

import json

import pytest

from rosmini.msgs.std_msgs.msg import Float64
from rosmini.viz.rqt.panel import Panel
from rosmini.viz.rqt.plugin import plugins
from rosmini.viz.rqt.window import Rqt
from rosmini.viz.view import ViewError


@pytest.fixture
def wave(graph):
    return graph.node("source").publisher("/wave", Float64)


@pytest.fixture
def window(graph):
    return Rqt(graph)


def running(window):
    return [panel.tool for panel in window.running.values()]


def test_the_menus_open_and_close(window, graph):
    window.set("plugins/Introspection", "Node Graph")
    window.set("plugins/Logging", "Console")
    assert running(window) == ["rqt_graph", "rqt_console"]
    assert "[Node Graph]" in window.text
    assert "Running:  [x] Node Graph  [x] Console" in window.text
    window.set("run/1", False)
    assert running(window) == ["rqt_console"]
    assert "/rqt_graph" not in graph.nodes
    window.set("end/2")
    assert "Running:  nothing" in window.text


PANELS = [each for each in plugins() if each.group and issubclass(each, Panel)]


@pytest.mark.parametrize("panel", PANELS, ids=lambda panel: panel.tool)
def test_every_panel_opens_shows_itself_and_closes(window, graph, panel):
    opened = window.open(panel.plugin)
    graph.run(0.2)
    assert type(opened) is panel
    assert f"[{panel.heading}]" in window.text
    assert 'class="rq-box"' in window.markup(live=True)
    window.close()
    assert not any("rqt" in name for name in graph.nodes)


def test_a_plugin_in_the_window_is_operated(window, graph, wave):
    window.open("rqt_plot")
    window.set("1/field", "/wave/data")
    window.set("1/add")
    graph.run(0.1)
    wave.publish(2.5)
    graph.run(1.5)
    assert "/wave/data: 1 point" in window.text
    with pytest.raises(ViewError, match="nothing to hear at /none"):
        window.open("rqt_plot").add("/none")
    assert window.running[2].node.name == "/rqt_plot_2"


def test_what_is_not_here_says_what_serves(window):
    for name, match in (
        ("Shell", "a terminal of JupyterLab"),
        ("rqt_moveit/MoveItMonitor", "not here"),
        ("Node Graf", "did you mean Node Graph"),
    ):
        with pytest.raises(ViewError, match=match):
            window.open(name)
    with pytest.raises(ViewError, match="nothing runs under the number 4"):
        window.end(4)


def test_a_perspective_comes_back(window, graph, wave):
    window.open("rqt_graph").change(mode="nodes_topics_all", hide=("tf",), namespaces=0, namespace="/s.*")
    window.open("rqt_plot").add("/wave/data")
    window.open("rqt_plot")
    window.open("rqt_topic").hear("/wave")
    window.open("rqt_console").filter(level="WARN", text="x")
    publication = window.open("rqt_publisher").add("/out", "std_msgs/Float64", rate=5)
    publication.fill("data", "i + 1")
    publication.enable()
    window.open("rqt_logger_level").choose("/source")
    window.open("rqt_service_caller").choose("/source/get_loggers")
    window.set("perspective", "all of it")
    window.set("save")
    before = [panel.settings() for panel in window.running.values()]
    window.arrange(type(window.perspective())())
    assert running(window) == []
    graph.run(0.1)
    window.set("open", "all of it")
    assert window.missing == []
    assert [panel.settings() for panel in window.running.values()] == before
    assert window.running[max(window.running) - 2].publications[1].enabled


def test_files_are_exported_and_imported_and_what_is_missing_is_named(window, graph, wave, tmp_path):
    path = tmp_path / "my.perspective"
    window.open("rqt_plot").add("/wave/data")
    window.set("file", str(path))
    window.set("export")
    data = json.loads(path.read_text(encoding="utf-8"))
    manager = data["groups"]["pluginmanager"]
    manager["keys"]["running-plugins"]["repr"] = "{'rqt_plot/Plot': [1], 'rqt_shell/Shell': [1], 'my_pkg/Mine': [1]}"
    manager["groups"]["plugin__rqt_plot__Plot__1"]["groups"]["plugin"]["keys"]["topics"]["repr"] = (
        "['/wave/data', '/no/x']"
    )
    path.write_text(json.dumps(data), encoding="utf-8")
    window.set("import")
    assert running(window) == ["rqt_plot"]
    assert next(iter(window.running.values())).fields == ("/wave/data",)
    assert [text.partition(":")[0] for text in window.missing] == ["rqt_plot/Plot", "rqt_shell/Shell", "my_pkg/Mine"]
    assert "not here: rqt_shell/Shell: Shell (rqt_shell) is not a panel of this window" in window.text
    assert running(Rqt(graph, perspective=path, name="other")) == ["rqt_plot"]


def test_where_the_docks_of_the_real_window_are_survives_import_and_export(window, tmp_path):
    """They are in Qt's own form: nothing here reads them, and the real rqt finds its window as it was."""
    state = {"type": "repr(QByteArray.hex)", "repr(QByteArray.hex)": "QtCore.QByteArray('00ff')"}
    docks = {"keys": {"geometry": state, "state": state}, "groups": {"toolbar_areas": {"keys": {}, "groups": {}}}}
    text = json.loads(window.perspective().dumps())
    text["groups"]["mainwindow"] = docks
    (tmp_path / "theirs.perspective").write_text(json.dumps(text), encoding="utf-8")
    window.import_file(tmp_path / "theirs.perspective")
    window.open("rqt_console")
    window.export_file(tmp_path / "ours.perspective")
    kept = json.loads((tmp_path / "ours.perspective").read_text(encoding="utf-8"))
    assert kept["groups"]["mainwindow"] == docks
