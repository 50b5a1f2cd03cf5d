"""Wrong answers to the exercises of the chapter Actions: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script
from rosmini.book.exercises.actionlib import SERVER

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

PACKAGE = {"action/Drive.action": "float64 distance\n---\nfloat64 travelled\n---\nfloat64 travelled\n"}
"""Files that cells of the chapter write into the notebook's package."""

BUTTON = solution("actionlib", "stop_button")

RETURN = """
import actionlib
import rospy
from notebook.msg import DriveAction, DriveGoal

rospy.init_node("client")
distance = rospy.get_param("~distance")
patience = rospy.get_param("~patience")
client = actionlib.SimpleActionClient("drive", DriveAction)
client.wait_for_server()
client.send_goal(DriveGoal(distance))
if not client.wait_for_result(rospy.Duration(patience)):
    client.cancel_goal()
    client.wait_for_result(rospy.Duration(2))
result = client.get_result()
if result is None:
    rospy.logerr("the server does not answer")
else:
    client.send_goal_and_wait(DriveGoal(-result.travelled), rospy.Duration(60))
"""


def _changed(name: str, source: str, before: str, after: str) -> Callable[[], Script]:
    assert before in source
    return lambda: Script(f"{name}.py", source.replace(before, after))


def _button(before: str, after: str) -> Callable[[], Script]:
    return _changed("stop_button", BUTTON, before, after)


def _server(before: str, after: str) -> Callable[[], Script]:
    return _changed("reverse_server", SERVER, before, after)


def _client(before: str, after: str) -> Callable[[], Script]:
    return _changed("return_client", RETURN, before, after)


MISTAKES = {
    "stop_button": [
        _button("drive/cancel", "cancel"),
        _button("GoalID())", 'GoalID(id="1"))'),
        _button('"stop", Empty', '"halt", Empty'),
        _button("rospy.spin()", "rospy.Timer(rospy.Duration(1), on_stop)\nrospy.spin()"),
        _button("cancel.publish(GoalID())", "rospy.signal_shutdown('stop')"),
    ],
    "reverse": [
        _server("abs(goal.distance)", "goal.distance"),
        _server('else "behind"', 'else "ahead"'),
        _server("else -0.2", "else 0.2"),
        _server("server.is_preempt_requested()", "False"),
        _server("latest[front] < 0.3", "False"),
        _server("travelled = math.hypot(place.x - start.x, place.y - start.y)", "travelled = place.x - start.x"),
        _server("        server.publish_feedback(DriveFeedback(travelled))\n", ""),
        _server('set_aborted(DriveResult(travelled), "blocked")', "set_aborted()"),
    ],
    "return_to_sender": [
        _client("client.wait_for_result(rospy.Duration(patience))", "client.wait_for_result()"),
        _client("    client.wait_for_result(rospy.Duration(2))\n", ""),
        _client("    client.wait_for_result(rospy.Duration(2))", "    client.wait_for_result()"),
        _client("-result.travelled", "-distance"),
        _client("if result is None:", "if False:"),
        _client('rospy.logerr("the server does not answer")', "pass"),
        _client("-result.travelled", "result.travelled"),
    ],
}
