"""Wrong answers to the exercises of the chapter Services: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

TRIP = solution("services", "trip")

ASK = solution("services", "ask_first")

FREE = solution("services", "is_free")


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
