#!/usr/bin/env python
from __future__ import print_function

import rospy
from rospy_tutorials.srv import AddTwoInts, AddTwoIntsResponse


def handle_add_two_ints(req):
    print("Returning [%s + %s = %s]" % (req.a, req.b, (req.a + req.b)))
    return AddTwoIntsResponse(req.a + req.b)


def serve():
    rospy.init_node("add_two_ints_server")
    rospy.Service("add_two_ints", AddTwoInts, handle_add_two_ints)
    rospy.spin()


if __name__ == "__main__":
    serve()
