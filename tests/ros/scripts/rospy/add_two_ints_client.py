#!/usr/bin/env python
import sys

import rospy
from rospy_tutorials.srv import AddTwoInts


def usage():
    return "%s [x y]" % sys.argv[0].rpartition("/")[2]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        print(usage())
        sys.exit(1)
    x, y = int(sys.argv[1]), int(sys.argv[2])
    rospy.wait_for_service("add_two_ints")
    try:
        add_two_ints = rospy.ServiceProxy("add_two_ints", AddTwoInts)
        print("%s + %s = %s" % (x, y, add_two_ints(x, y).sum))
    except rospy.ServiceException as e:
        print("Service call failed: %s" % e)
