#!/usr/bin/env python
# A callback that calls a service; server, client, publisher and subscriber are one node.
import rospy
from std_msgs.msg import String
from std_srvs.srv import Trigger, TriggerResponse


class Relay(object):
    def __init__(self):
        self.count = 0
        rospy.Service("~count", Trigger, self.serve)
        self.call = rospy.ServiceProxy("~count", Trigger)
        rospy.Subscriber("~in", String, self.heard)
        self.pub = rospy.Publisher("~in", String, queue_size=5)

    def serve(self, req):
        rospy.sleep(0.001)
        self.count += 1
        return TriggerResponse(success=True, message=str(self.count))

    def heard(self, msg):
        answer = self.call()
        print(msg.data, answer.success, answer.message)
        if answer.message == "2":
            rospy.signal_shutdown("enough")


rospy.init_node("relay")
relay = Relay()
while relay.pub.get_num_connections() < 1:
    rospy.sleep(0.001)
relay.pub.publish("a")
relay.pub.publish("b")
rospy.spin()
