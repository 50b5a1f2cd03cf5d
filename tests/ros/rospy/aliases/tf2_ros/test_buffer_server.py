"""Servers and clients of buffers, in scripts."""

from __future__ import annotations

import io
import json
from typing import Any

import pytest

from rosmini.ros.scripts import ScriptSpec, run_scripts

SERVER = """
import rospy, tf2_ros
from geometry_msgs.msg import TransformStamped

rospy.init_node("server")
buffer = tf2_ros.Buffer()
server = tf2_ros.BufferServer(buffer, "tf2_buffer_server", auto_start=False)


def tell(parent, child, x, secs):
    one = TransformStamped(child_frame_id=child)
    one.header.frame_id = parent
    one.header.stamp = rospy.Time(secs)
    one.transform.translation.x = x
    one.transform.rotation.w = 1
    buffer.set_transform(one, "test")


tell("map", "base", 1, 1000)
tell("map", "base", 3, 1002)
tell("moon", "crater", 1, 1000)
server.start()
rospy.sleep(5)
tell("map", "arm", 7, 1005)
rospy.spin()
"""

CLIENT = """
import json
import rospy, tf2_ros
from geometry_msgs.msg import PointStamped

rospy.init_node("client")
client = tf2_ros.BufferClient("tf2_buffer_server")
assert isinstance(client, tf2_ros.BufferInterface)
facts = {"there": client.wait_for_server(rospy.Duration(3))}


def ask(function, *arguments):
    try:
        return function(*arguments).transform.translation.x
    except tf2_ros.TransformException as error:
        return type(error).__name__


second = rospy.Duration(1)
facts["at once"] = [
    ask(client.lookup_transform, "map", "base", rospy.Time()),
    ask(client.lookup_transform, "map", "base", rospy.Time(1001)),
    ask(client.lookup_transform_full, "base", rospy.Time(1002), "base", rospy.Time(1000), "map"),
]
facts["errors"] = [
    ask(client.lookup_transform, "map", "nobody", rospy.Time()),
    ask(client.lookup_transform, "map", "crater", rospy.Time()),
    ask(client.lookup_transform, "map", "base", rospy.Time(1009)),
    ask(client.lookup_transform, "/map", "base", rospy.Time()),
]
facts["can"] = [
    client.can_transform("map", "base", rospy.Time()),
    client.can_transform("map", "nobody", rospy.Time()),
    client.can_transform_full("base", rospy.Time(1002), "base", rospy.Time(1000), "map"),
]
before = rospy.get_time()
answer = ask(client.lookup_transform, "map", "nobody", rospy.Time(), second)
facts["in vain"] = [answer, round(rospy.get_time() - before, 1)]
answer = ask(client.lookup_transform, "map", "arm", rospy.Time(), rospy.Duration(9))
facts["waited for"] = [answer, rospy.get_time() < 1006]
point = PointStamped()
point.header.frame_id = "base"
facts["moved"] = client.transform(point, "map").point.x
print(json.dumps(facts))
rospy.signal_shutdown("done")
"""


def run(*sources: str, duration: float = 60) -> tuple[int, str, str]:
    out, err = io.StringIO(), io.StringIO()
    specs = [ScriptSpec(f"script{number}", source=source) for number, source in enumerate(sources)]
    result = run_scripts(specs, duration=duration, stdout=out, stderr=err, prefix=False)
    return result.status, out.getvalue(), err.getvalue()


def test_lookups_in_the_buffer_of_another_node():
    _, out, err = run(SERVER, CLIENT)
    facts: dict[str, Any] = json.loads(out.splitlines()[-1]) if out else pytest.fail(err)
    assert facts == {
        "there": True,
        "at once": [3.0, 2.0, -2.0],
        "errors": ["LookupException", "ConnectivityException", "ExtrapolationException", "InvalidArgumentException"],
        "can": [True, False, True],
        "in vain": ["LookupException", 1.0],
        "waited for": [7.0, True],
        "moved": 3.0,
    }


CANCEL = """
import rospy, tf2_ros
from actionlib_msgs.msg import GoalStatus
from tf2_msgs.msg import LookupTransformGoal

rospy.init_node("client")
client = tf2_ros.BufferClient("tf2_buffer_server")
client.wait_for_server()
client.client.send_goal(LookupTransformGoal(target_frame="map", source_frame="arm", timeout=rospy.Duration(50)))
rospy.sleep(0.1)
client.client.cancel_goal()
client.client.wait_for_result()
print(client.client.get_state() == GoalStatus.PREEMPTED, rospy.get_time() < 1001)
"""


def test_a_lookup_that_waits_can_be_cancelled():
    _, out, err = run(SERVER, CANCEL, duration=10)
    assert out == "True True\n", err


def test_no_answer_is_a_time_out():
    script = """
import rospy, tf2_ros
rospy.init_node("client")
client = tf2_ros.BufferClient("nowhere", timeout_padding=rospy.Duration(0.5))
try:
    client.lookup_transform("map", "base", rospy.Time(), rospy.Duration(0.5))
except tf2_ros.TimeoutException as error:
    print(rospy.get_time(), error)
"""
    _, out, _ = run(script)
    assert out.startswith("1001.0 ") and "/nowhere" in out


def test_what_one_script_registers_no_other_one_finds():
    register = "import tf2_ros\ntf2_ros.TransformRegistration().add(int, print)\nprint('added')"
    find = (
        "import tf2_ros\ntry:\n    tf2_ros.TransformRegistration().get(int)\n"
        "except tf2_ros.TypeException as error:\n    print(error)"
    )
    _, out, _ = run(register, find)
    assert out.startswith("added\nType <class 'int'> is not loaded or supported")
