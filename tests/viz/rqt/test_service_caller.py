"""The service caller: what it offers, what it sends, and what it says when that fails."""

import pytest

from rosmini.core.errors import ServiceException
from rosmini.msgs.std_srvs.srv import Empty, SetBool
from rosmini.viz.rqt.service_caller import ServiceCaller
from rosmini.viz.view import ViewError


@pytest.fixture
def asked(graph):
    """What was asked of /switch, which refuses to be switched off."""
    found = []

    def switch(request):
        found.append(request.data)
        if not request.data:
            raise ValueError("it stays on")
        return {"success": True, "message": "on"}

    node = graph.node("lamp")
    node.service("switch", SetBool, switch)
    node.service("nothing", Empty, lambda _: {})
    return found


def test_the_twin_and_the_page_do_the_same(graph, asked):
    caller = ServiceCaller(graph)
    caller.set("service", "/switch")
    caller.set("request/data", "1 < 2")
    caller.set("call")
    assert asked == [True]
    assert caller.response.message == "on"
    by_hand = ServiceCaller(graph, "/switch", name="by_hand")
    by_hand.fill("data", "1 < 2")
    assert by_hand.call() == caller.response
    assert asked == [True, True]
    assert by_hand.text == caller.text


def test_its_text_shows_request_and_response(graph, asked):
    caller = ServiceCaller(graph, "/switch")
    assert caller.text.splitlines()[:5] == [
        "rqt_service_caller",
        "Service: /switch  [std_srvs/SetBool]",
        "[Request]",
        "  Field  Type  Expression",
        "  data   bool  False",
    ]
    caller.fill("data", "True")
    caller.call()
    assert "  message  string  'on'" in caller.text


def test_what_fails_is_said_and_shown(graph, asked):
    caller = ServiceCaller(graph, "/switch")
    with pytest.raises(ServiceException, match="it stays on"):
        caller.set("call")
    assert "it stays on" in caller.text
    assert "rq-words rq-bad" in caller.markup(live=True)
    caller.fill("data", "True")
    caller.set("call")
    assert "it stays on" not in caller.text


def test_what_makes_no_sense_is_refused(graph, asked):
    caller = ServiceCaller(graph)
    with pytest.raises(ViewError, match="no service is chosen"):
        caller.call()
    with pytest.raises(ViewError, match="no node offers a service '/swich'; did you mean /switch"):
        caller.choose("/swich")
    caller.choose("/switch")
    for expression in ("open('x')", "1 +", "'yes'"):
        with pytest.raises(ViewError):
            caller.fill("data", expression)
    assert caller.set("request/data", "True") is None
