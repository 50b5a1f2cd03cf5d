"""Services as scripts use them."""

from __future__ import annotations

import pytest

from rosmini.msgs.rospy_tutorials.srv import AddTwoInts, AddTwoIntsRequest, AddTwoIntsResponse
from rosmini.msgs.std_srvs.srv import Empty, SetBool, SetBoolRequest, Trigger
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases import genpy


def server(handler, cls=AddTwoInts, **options):
    def serve():
        rospy.init_node("server")
        rospy.Service("service", cls, handler, **options).spin()

    return serve


def add(request):
    return AddTwoIntsResponse(request.a + request.b)


def test_a_client_needs_no_node(programs):
    def client():
        rospy.wait_for_service("service", timeout=rospy.Duration(1000))
        proxy = rospy.ServiceProxy("service", AddTwoInts)
        return [proxy(1, 2).sum, proxy(a=3, b=4).sum, proxy.call(AddTwoIntsRequest(5, 6)).sum]

    assert programs(server(add), client) == [3, 7, 11]
    assert "/unnamed" not in programs.graph.nodes


@pytest.mark.parametrize("persistent", [False, True])
def test_a_client_with_a_node(programs, persistent):
    def client():
        rospy.init_node("client")
        proxy = rospy.ServiceProxy("service", AddTwoInts, persistent=persistent)
        proxy.wait_for_service(timeout=1000)
        result = [proxy(1, 1).sum, proxy(2, 2).sum]
        proxy.close()
        return result

    assert programs(server(add), client) == [2, 4]


@pytest.mark.parametrize(
    ("answer", "cls", "expected"),
    [
        (lambda _: 7, AddTwoInts, 7),
        (lambda _: [7], AddTwoInts, 7),
        (lambda _: {"sum": 7}, AddTwoInts, 7),
        (lambda _: [True, "yes"], SetBool, "yes"),
        (lambda _: {"message": "yes"}, SetBool, "yes"),
    ],
)
def test_what_a_handler_may_return(sim_programs, answer, cls, expected):
    def client():
        rospy.wait_for_service("service")
        response = rospy.ServiceProxy("service", cls)()
        return getattr(response, response.__slots__[-1])

    assert sim_programs(server(answer, cls), client) == expected


def fail(_):
    raise ValueError("deliberate")


def refuse(_):
    raise rospy.ServiceException("not now")


@pytest.mark.parametrize(
    ("handler", "problem"),
    [
        (fail, r"responded with an error.*error processing request: deliberate"),
        (refuse, r"responded with an error.*service cannot process request: not now"),
        (lambda _: None, r"service handler returned None"),
        (lambda _: (1, 2), r"handler returned"),
        (lambda _: "seven", r"cannot process request"),
    ],
)
def test_a_failing_handler_gives_the_caller_an_error(programs, handler, problem):
    def client():
        rospy.wait_for_service("service")
        rospy.ServiceProxy("service", AddTwoInts)(1, 2)

    with pytest.raises(rospy.ServiceException, match=problem):
        programs(server(handler), client)


def test_an_error_handler_gets_what_the_handler_raised(programs, log):
    got = []

    def client():
        rospy.wait_for_service("service")
        with pytest.raises(rospy.ServiceException, match="deliberate"):
            rospy.ServiceProxy("service", AddTwoInts)(1, 2)

    programs(server(fail, error_handler=lambda *arguments: got.append(arguments)), client)
    error, kind, again, trace = got[0]
    assert (str(error), kind, again is error, trace is error.__traceback__) == ("deliberate", ValueError, True, True)
    assert log.read().err == ""


def test_calling_what_is_not_there(programs):
    def client():
        rospy.init_node("client")
        with pytest.raises(rospy.ServiceException, match=r"service \[/nothing\] unavailable"):
            rospy.ServiceProxy("nothing", AddTwoInts)(1, 2)
        with pytest.raises(rospy.ROSException, match=r"timeout exceeded.*/nothing"):
            rospy.wait_for_service("nothing", timeout=0.2)
        with pytest.raises(ValueError, match="non-zero"):
            rospy.wait_for_service("nothing", timeout=0)

    programs(client)


def test_wrong_requests(sim_programs):
    def client():
        rospy.wait_for_service("service")
        proxy = rospy.ServiceProxy("service", AddTwoInts)
        with pytest.raises(TypeError, match=r"SetBoolRequest.*AddTwoInts"):
            proxy(SetBoolRequest())
        with pytest.raises(genpy.SerializationError, match="field a"):  # as there, and for topics rospy's own
            proxy("one", 2)
        with pytest.raises(rospy.ServiceException, match=r"std_srvs/Empty"):
            rospy.ServiceProxy("service", Empty)()
        for cls in (None, int, AddTwoInts()):
            with pytest.raises(ValueError, match="service class"):
                rospy.ServiceProxy("service", cls)

    sim_programs(server(add), client)


def test_a_service_is_offered_once_and_can_be_withdrawn(programs):
    def main():
        early = rospy.Service("early", Trigger, lambda _: (True, "early"))
        rospy.init_node("main")
        service = rospy.Service("~mine", Trigger, lambda _: (True, "mine"))
        assert service.resolved_name == "/main/mine"
        with pytest.raises(rospy.ServiceException, match="already"):
            rospy.Service("~mine", Trigger, lambda _: (True, ""))
        texts = [rospy.ServiceProxy(name, Trigger)().message for name in ("~mine", "early")]
        service.shutdown("done")
        service.shutdown("done")
        service.spin()
        with pytest.raises(rospy.ServiceException, match="unavailable"):
            rospy.ServiceProxy("~mine", Trigger)()
        assert early.uri == rospy.get_node_uri() or early.uri.startswith("rosrpc://")
        return texts

    assert programs(main) == ["mine", "early"]


def test_a_callback_may_call_a_service_of_its_own_process(programs):
    def main():
        rospy.init_node("main")
        rospy.Service("add", AddTwoInts, add)
        sums = []
        rospy.Timer(
            rospy.Duration(0.1), lambda _: sums.append(rospy.ServiceProxy("add", AddTwoInts)(1, 2).sum), oneshot=True
        )
        while not sums:
            rospy.sleep(0.1)
        return sums

    assert programs(main) == [3]


def test_parse_rosrpc_uri():
    assert rospy.parse_rosrpc_uri("rosrpc://localhost:1234/") == ("localhost", 1234)
    for bad in ("http://localhost:1", "rosrpc://localhost", "rosrpc://localhost:x"):
        with pytest.raises(rospy.core.ParameterInvalid):
            rospy.parse_rosrpc_uri(bad)


def test_another_type_is_refused_before_the_values_are_looked_at(programs):
    def main():
        rospy.init_node("main")
        rospy.Service("flip", Trigger, lambda request: (True, ""))
        with pytest.raises(rospy.ServiceException, match="std_srvs/Trigger"):
            rospy.ServiceProxy("flip", SetBool)("no bool")
        rospy.Service("switch", SetBool, lambda request: (True, ""))
        with pytest.raises(genpy.SerializationError):
            rospy.ServiceProxy("switch", SetBool)("no bool")
        return rospy.ServiceProxy("switch", SetBool)(True).success

    assert programs(main) is True
