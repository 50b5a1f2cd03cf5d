"""Wrong answers to the exercises of the chapter Services: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong

TRIP = """
import math

import rospy
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty, EmptyResponse, Trigger, TriggerResponse

metres, last = 0.0, None

def on_odom(odom):
    global metres, last
    here = odom.pose.pose.position
    if last is not None:
        metres += math.hypot(here.x - last.x, here.y - last.y)
    last = here

def on_trip(request):
    return TriggerResponse(True, f"{metres:.2f}")

def on_clear(request):
    global metres
    metres = 0.0
    return EmptyResponse()

rospy.init_node("trip")
rospy.Subscriber("odom", Odometry, on_odom)
rospy.Service("trip", Trigger, on_trip)
rospy.Service("clear", Empty, on_clear)
rospy.spin()
"""

ASK = """
import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Trigger

def is_open():
    try:
        rospy.wait_for_service("open_door", timeout=5)
        return rospy.ServiceProxy("open_door", Trigger)().success
    except (rospy.ROSException, rospy.ServiceException):
        return False

rospy.init_node("ask")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
if is_open():
    command = Twist()
    command.linear.x = 0.2
    for _ in range(50):
        cmd_vel.publish(command)
        rospy.sleep(0.1)
    cmd_vel.publish(Twist())
rospy.spin()
"""

FREE = """
import rospy
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger, TriggerResponse

ahead = None

def on_scan(scan):
    global ahead
    ahead = scan.ranges[0]

def on_request(request):
    if ahead is None:
        return TriggerResponse(False, "no scan yet")
    return TriggerResponse(ahead >= 1.0, f"{ahead:.2f}")

rospy.init_node("free")
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.Service("is_free", Trigger, on_request)
rospy.spin()
"""


MISTAKES = {
    "trip": [
        wrong("trip.py", TRIP, "    global metres\n    metres = 0.0\n", "    metres = 0.0\n"),
        wrong("trip.py", TRIP, "{metres:.2f}", "{metres:.1f} m"),
        wrong("trip.py", TRIP, "    return EmptyResponse()", "    pass"),
        wrong("trip.py", TRIP, "TriggerResponse(True,", "TriggerResponse(False,"),
        wrong("trip.py", TRIP, 'Service("clear"', 'Service("reset"'),
        wrong("trip.py", TRIP, "metres += math.hypot(here.x - last.x, here.y - last.y)", "metres += here.x - last.x"),
    ],
    "ask_first": [
        wrong("ask.py", ASK, "().success", "()"),
        wrong("ask.py", ASK, "rospy.ROSException, rospy.ServiceException", "rospy.ServiceException"),
        wrong("ask.py", ASK, "rospy.ROSException, rospy.ServiceException", "KeyError"),
        wrong("ask.py", ASK, '        rospy.wait_for_service("open_door", timeout=5)\n'),
        wrong("ask.py", ASK, "return False", "return True"),
        wrong("ask.py", ASK, "().success", "().succes"),
    ],
    "is_free": [
        wrong("free.py", FREE, "ahead >= 1.0", "ahead < 1.0"),
        wrong(
            "free.py",
            FREE,
            "    if ahead is None:\n        return TriggerResponse(False, 'no scan yet')\n".replace("'", '"'),
        ),
        wrong("free.py", FREE, 'f"{ahead:.2f}"', '"free"'),
        wrong("free.py", FREE, "    global ahead\n"),
        wrong("free.py", FREE, '"is_free"', '"free"'),
        wrong(
            "free.py",
            FREE,
            "    if ahead is None",
            '    rospy.wait_for_message("scan", LaserScan)\n    if ahead is None',
        ),
    ],
}
