#!/usr/bin/env python
import rospy
from std_msgs.msg import String


def talk():
    rospy.init_node("talker")
    pub = rospy.Publisher("chatter", String, queue_size=10)
    rate = rospy.Rate(rospy.get_param("~rate", 100))
    while pub.get_num_connections() < rospy.get_param("~listeners", 1) and not rospy.is_shutdown():
        rate.sleep()
    for number in range(3):
        pub.publish("hello %d" % number)
        rate.sleep()


if __name__ == "__main__":
    try:
        talk()
    except rospy.ROSInterruptException:
        pass
