"""Services as scripts use them."""

from __future__ import annotations

import pytest

from rosmini.msgs.rospy_tutorials.srv import AddTwoInts, AddTwoIntsRequest, AddTwoIntsResponse
from rosmini.msgs.std_srvs.srv import SetBool, Trigger
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


def fail(_):
    raise ValueError("deliberate")


def refuse(_):
    raise rospy.ServiceException("not now")


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
