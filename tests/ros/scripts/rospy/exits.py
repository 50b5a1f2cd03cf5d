#!/usr/bin/env python
import sys

import rospy

rospy.init_node("exits")
rospy.on_shutdown(lambda: print("hook"))
if not rospy.has_param("/map"):
    rospy.logerr("no map")
    sys.exit(3)
print("not reached")
