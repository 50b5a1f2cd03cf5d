"""Which finding explains an error, and that most errors are explained by none."""

from __future__ import annotations

import pytest

from rosmini.core.errors import (
    GraphEnded,
    MasterUnreachable,
    ROSException,
    RosminiError,
    ScriptError,
    TypeMismatch,
    UnknownPackage,
)
from rosmini.ros.introspection.wtf.explaining import explain, is_known
from rosmini.ros.introspection.wtf.findings import Finding
from rosmini.ros.introspection.wtf.survey import Survey

from .test_graph_rules import LISTENER, TALKER, TEXT, node, survey

TIMEOUT = "timeout exceeded while waiting for message on topic {}: nothing came in 2 s"


def static() -> list[Finding]:
    return [
        Finding("missing_folders", "ERROR", "Not all paths:", ("/gone",)),
        Finding("broken_manifests", "ERROR", "Broken:", ("/ws/broken/package.xml:3: no name", "/x/package.xml:1: y")),
        Finding("scripts_that_cannot_start", "ERROR", "Scripts:", ("mine/scripts/a.py: it has no run bit",)),
    ]  # fmt: skip


def explained(error: BaseException, graph: Survey | None = None) -> tuple[str, tuple[str, ...]] | None:
    found = explain(error, graph, static)
    return None if found is None else (found.rule, found.where)


def test_a_name_that_was_meant_otherwise() -> None:
    found = explain(ROSException(TIMEOUT.format("/chater")), survey(TALKER, LISTENER), static)
    assert found is not None
    assert str(found) == "ERROR Nothing in the graph is called /chater; did you mean /chatter?"


def test_what_keeps_its_source_from_publishing() -> None:
    relay = node("/relay", {"/relayed": TEXT}, {"/chater": TEXT})
    deaf = node("/deaf", {}, {"/else": TEXT})
    graph = survey(TALKER, LISTENER, relay, deaf)
    where = ("/chater, to which /relay subscribes", " did you mean /chatter?")
    assert explained(ROSException(TIMEOUT.format("/relayed")), graph) == ("no_publisher", where)
    assert explained(RosminiError("no idea, /nowhere/at/all"), graph) is None


def test_simulated_time_that_stands_still_explains_what_waits_only() -> None:
    graph = survey(TALKER, LISTENER, parameters={"use_sim_time": True})
    assert explained(ROSException(TIMEOUT.format("/chatter")), graph) == ("no_clock", ())
    assert explained(GraphEnded("nothing more can happen"), graph) == ("no_clock", ())
    assert explained(ROSException("init_node was not called"), graph) is None


@pytest.mark.parametrize(
    "error",
    [
        TypeMismatch("/talker publishes /chater"),
        ROSException("timeout: no /chater; did you mean /chatter?"),
        RosminiError("/tmp/chatter is no folder"),
        RosminiError("at http://localhost:1/chater"),
        ValueError("/chater"),
    ],
)
def test_what_says_it_itself_or_is_none_of_ours(error: Exception) -> None:
    assert explained(error, survey(TALKER, LISTENER)) is None


def test_errors_of_packages_are_explained_by_the_packages_that_they_name() -> None:
    assert explained(UnknownPackage("there is no package 'gone'")) == ("missing_folders", ("/gone",))
    assert explained(ModuleNotFoundError("No module named 'broken'")) == (
        "broken_manifests",
        ("/ws/broken/package.xml:3: no name",),
    )
    rule = explained(ScriptError("there is no executable in the package 'mine'"))
    assert rule is not None
    assert rule[0] == "scripts_that_cannot_start"
    assert explained(ScriptError("there is no executable in the package 'other'")) is None


def test_nothing_is_asked_where_it_cannot_be_the_cause() -> None:
    def never() -> list[Finding]:
        pytest.fail("the packages were searched")

    assert explain(MasterUnreachable("no Master"), None, never) is None
    assert not is_known(KeyError("x"))
    assert is_known(UnknownPackage("x"))
