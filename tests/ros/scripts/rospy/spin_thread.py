#!/usr/bin/env python
import threading

import rospy
from std_msgs.msg import String

rospy.init_node("spinner")
heard = []
rospy.Subscriber("chatter", String, lambda msg: heard.append(msg.data))
spinner = threading.Thread(target=rospy.spin)
spinner.start()
rate = rospy.Rate(200)
while not rospy.is_shutdown() and len(heard) < 3:
    rate.sleep()
print(heard)
rospy.signal_shutdown("heard enough")
spinner.join()
print("spin has returned")
