"""Files of perspectives: those of the real rqt are read, ours are in its form, and nothing in them is executed."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.rqt.perspective import Perspective, Running
from rosmini.viz.view import ViewError


def exported(running, **groups):
    """A file in the form of the real one, with what Qt keeps of its windows."""
    state = {"type": "repr(QByteArray.hex)", "repr(QByteArray.hex)": "QtCore.QByteArray('00ff')", "pretty-print": " "}
    keys = {"running-plugins": {"type": "repr", "repr": running}}
    return json.dumps(
        {
            "keys": {},
            "groups": {
                "mainwindow": {"keys": {"geometry": state, "state": state}, "groups": {}},
                "pluginmanager": {"keys": keys, "groups": groups},
            },
        }
    )


def plugin(**values):
    keys = {name: {"type": "repr", "repr": text} for name, text in values.items()}
    return {
        "keys": {},
        "groups": {"plugin": {"keys": keys, "groups": {}}, "dock_widget__x": {"keys": {}, "groups": {}}},
    }


def test_a_file_of_the_real_rqt():
    text = exported(
        "{u'rqt_plot/Plot': [1, 2], 'rqt_graph/RosGraph': [1]}",
        plugin__rqt_plot__Plot__2=plugin(topics="[u'/odom/twist/twist/linear/x']"),
        plugin__rqt_graph__RosGraph__1=plugin(graph_type_combo_box_index="u'1'", quiet_check_box_state="'true'"),
    )
    assert Perspective.parse(text).running == (
        Running("rqt_plot/Plot", 1),
        Running("rqt_plot/Plot", 2, {"topics": ["/odom/twist/twist/linear/x"]}),
        Running("rqt_graph/RosGraph", 1, {"graph_type_combo_box_index": "1", "quiet_check_box_state": "true"}),
    )


def test_what_is_no_literal_is_left_out(tmp_path):
    mark = tmp_path / "mark"
    text = exported(
        "{'rqt_plot/Plot': [1]}",
        plugin__rqt_plot__Plot__1=plugin(
            a=f"open({str(mark)!r}, 'w')", b="(" * 5000, c="1 +", d="'" + "x" * 200_000, e="3"
        ),
    )
    assert Perspective.parse(text).running[0].settings == {"e": 3}
    assert not mark.exists()


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{", "[" * 100_000, '{"groups": {"pluginmanager": 3}}', exported("[1]"), exported("__import__('os')"),
     exported("{[]: 1}"),
     exported(repr({f"p{i}/P": list(range(20)) for i in range(20)}))],
)  # fmt: skip
def test_what_is_no_perspective_is_refused(text):
    with pytest.raises(ViewError):
        Perspective.parse(text)


def test_files_that_are_not_there_or_too_large_are_named(tmp_path):
    with pytest.raises(ViewError, match=r"none\.perspective cannot be read"):
        Perspective.read(tmp_path / "none.perspective")
    with pytest.raises(ViewError, match="cannot be written"):
        Perspective().write(tmp_path / "none" / "x.perspective")
    with pytest.raises(ViewError, match="at most"):
        Perspective.parse(" " * 5_000_000)


VALUES = st.recursive(
    st.booleans() | st.integers() | st.text(max_size=20), lambda inner: st.lists(inner, max_size=3), max_leaves=5
)
PLUGINS = st.from_regex(r"[a-z_]{1,9}/[A-Z][a-z]{0,9}", fullmatch=True)


@given(
    st.lists(
        st.tuples(PLUGINS, st.dictionaries(st.text(min_size=1, max_size=9), VALUES)),
        max_size=4,
        unique_by=lambda x: x[0],
    )
)
def test_what_is_written_is_read(found):
    perspective = Perspective(tuple(Running(name, 1, settings) for name, settings in found))
    assert Perspective.parse(perspective.dumps()) == perspective
