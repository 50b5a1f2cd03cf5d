#!/usr/bin/env python3
"""Changes a parameter of the node tuned."""

import dynamic_reconfigure.client
import rospy

rospy.init_node("tune")
client = dynamic_reconfigure.client.Client("tuned", timeout=1000)
print("was", client.get_configuration()["speed"])
print("is", client.update_configuration({"speed": 50})["speed"])
