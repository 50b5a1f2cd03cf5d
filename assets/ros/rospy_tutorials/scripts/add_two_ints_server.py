#!/usr/bin/env python3
"""Offers the service add_two_ints (http://wiki.ros.org/rospy_tutorials)."""

import rospy
from rospy_tutorials.srv import AddTwoInts, AddTwoIntsResponse


def add(request):
    """Answer with the sum."""
    rospy.loginfo("Returning [%d + %d = %d]", request.a, request.b, request.a + request.b)
    return AddTwoIntsResponse(request.a + request.b)


if __name__ == "__main__":
    rospy.init_node("add_two_ints_server")
    rospy.Service("add_two_ints", AddTwoInts, add)
    rospy.spin()
