"""rosparam's doings with a graph's Parameter Server."""

from __future__ import annotations

from pathlib import Path

import pytest

from rosmini import Graph
from rosmini.core.errors import ParameterNotSet
from rosmini.core.rosparam import ParamClient, RosParamException


@pytest.fixture
def graph():
    with Graph() as made:
        yield made


@pytest.fixture
def params(graph: Graph) -> ParamClient:
    return ParamClient(graph)


def test_a_dictionary_is_merged_and_a_list_replaces(graph: Graph, params: ParamClient) -> None:
    params.set("/robot", "{a: 1, sizes: [1, 2, 3]}")
    params.set("/robot", "{b: 2, sizes: [4]}")
    assert params.get("/robot") == {"a": 1, "b": 2, "sizes": [4]}
    graph.node("node").set_param("/robot", {"c": 3})  # a node's own setting replaces
    assert params.get("/robot") == {"c": 3}


def test_get_set_list_delete(params: ParamClient) -> None:
    params.set("/x", "5")
    params.set("/empty", "")
    params.set("/ns/deep/y", "text")
    assert (params.get("/x"), params.get("/empty"), params.get("/ns")) == (5, "", {"deep": {"y": "text"}})
    assert params.list_params("/ns") == params.list_params("ns/") == ["/ns/deep/y"]
    assert params.list_params("/n") == params.list_params("/x") == []
    assert params.list_params() == ["/empty", "/ns/deep/y", "/rosdistro", "/rosversion", "/run_id", "/x"]
    params.delete("/ns")
    assert params.list_params("/ns") == []
    with pytest.raises(ParameterNotSet, match=r"[Pp]arameter \[/xx\] is not set; did you mean /x\?"):
        params.get("/xx")
    with pytest.raises(ParameterNotSet, match=r"parameter \[/ns\] is not set"):
        params.delete("/ns")
    params.delete("/")
    assert params.list_params() == []


def test_relative_names_start_in_the_namespace(graph: Graph) -> None:
    params = ParamClient(graph, namespace="/robot1")
    params.set("speed", "1.0")
    params.set("~own", "2")
    assert ParamClient(graph).list_params("/robot1") == ["/robot1/rosparam/own", "/robot1/speed"]
    assert params.list_params("") == ["/robot1/rosparam/own", "/robot1/speed"]
    assert params.loads("a: 1") == ["/robot1/a"]
    assert params.loads("a: 1", "sub") == ["/robot1/sub/a"]


def test_a_file_goes_in_and_comes_out(params: ParamClient, tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("a: 1\nc: {d: true, e: str}\nb: [1, 2.5, three]\n", encoding="utf-8")
    assert params.load(path, "/loaded") == ["/loaded/a", "/loaded/c/d", "/loaded/c/e", "/loaded/b"]
    out = params.dump(tmp_path / "out.yaml", "/loaded")
    assert (
        out.read_text(encoding="utf-8")
        == params.dumps("/loaded")
        == ("a: 1\nb:\n- 1\n- 2.5\n- three\nc:\n  d: true\n  e: str\n")
    )  # the text of the real tool
    with pytest.raises(RosParamException, match="cannot write"):
        params.dump(tmp_path / "no" / "folder.yaml")


def test_a_wrong_file_sets_nothing(params: ParamClient, tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("a: 1\n---\nb: 2\nc:\n", encoding="utf-8")
    with pytest.raises(RosParamException, match=r"p\.yaml:4: parameter /c has no value"):
        params.load(path)
    assert not {"/a", "/b"} & set(params.list_params())


def test_one_value_is_one_document(params: ParamClient) -> None:
    with pytest.raises(RosParamException, match="2 YAML documents"):
        params.set("/x", "1\n---\n2")
    with pytest.raises(RosParamException, match="is a dictionary, not "):
        params.set("/", "1")
    with pytest.raises(RosParamException, match="empty"):
        params.set("/x", "null")
