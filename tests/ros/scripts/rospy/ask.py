#!/usr/bin/env python
import argparse

import rospy
from std_msgs.msg import Float64

parser = argparse.ArgumentParser()
parser.add_argument("--unit", default="m")
parser.add_argument("words", nargs="*")
args = parser.parse_args(rospy.myargv()[1:])
rospy.init_node("asker")
pub = rospy.Publisher("goal", Float64, queue_size=1, latch=True)
x = float(input("x? "))
y = float(input("y? "))
pub.publish(x + y)
print(x + y, args.unit, args.words, rospy.get_name(), pub.resolved_name)
