#!/usr/bin/env python3
"""Calls the service add_two_ints: rosrun rospy_tutorials add_two_ints_client.py 1 2."""

import sys

import rospy
from rospy_tutorials.srv import AddTwoInts

if __name__ == "__main__":
    words = rospy.myargv(sys.argv)
    if len(words) != 3:
        sys.exit(f"usage: {words[0]} A B")
    a, b = int(words[1]), int(words[2])
    rospy.wait_for_service("add_two_ints")
    total = rospy.ServiceProxy("add_two_ints", AddTwoInts)(a, b).sum
    print(f"{a} + {b} = {total}")
