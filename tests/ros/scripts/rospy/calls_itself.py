#!/usr/bin/env python
import rospy
from std_srvs.srv import SetBool, SetBoolResponse


def serve(req):
    if req.data:
        inner = rospy.ServiceProxy("switch", SetBool)(False)
        return SetBoolResponse(True, "outer got " + inner.message)
    return SetBoolResponse(False, "inner")


rospy.init_node("self_caller")
rospy.Service("switch", SetBool, serve)
rospy.wait_for_service("switch")
print(rospy.ServiceProxy("switch", SetBool)(True).message)
