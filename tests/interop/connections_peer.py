"""What rospy does before there is a node, with connections, types, failing handlers and timers, as JSON.

Run by real rospy and by ours.
"""

import json
import sys
import warnings

import rospy
from geometry_msgs.msg import Point, Pose, Pose2D, Vector3
from roscpp.srv import Empty, EmptyRequest, GetLoggers, SetLoggerLevel
from rosgraph_msgs.msg import Log
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import CameraInfo, LaserScan
from sensor_msgs.srv import SetCameraInfo, SetCameraInfoRequest
from std_msgs.msg import String

warnings.simplefilter("ignore")
facts = {}

FINER = ("IllegalName", "ParameterError", "ParameterNotSet")
"""Classes of ours below those of rospy."""


def outcome(function, *args, **kwargs):
    """What a call returns, or the class of what it raises and all that a handler could catch it by."""
    try:
        return repr(function(*args, **kwargs))
    except Exception as error:
        names = {cls.__name__ for cls in type(error).__mro__}
        return sorted(names - {"object", "BaseException", "RosminiError", "MessageException", *FINER})


def text_of(function, *args, **kwargs):
    try:
        function(*args, **kwargs)
    except Exception as error:
        return str(error)
    return None


def settle(condition=lambda: False, seconds=1.0):
    for _ in range(int(seconds / 0.02)):
        if condition():
            return
        rospy.sleep(0.02)


def rest():
    rospy.sleep(0.3)


# ---- before init_node ----

facts["before"] = {
    "sleep": [outcome(rospy.sleep, seconds) for seconds in (0.01, 0, -1, rospy.Duration(0, 1000))],
    "rate": outcome(rospy.Rate, 10),
    "now": outcome(rospy.Time.now),
    "get_rostime": outcome(rospy.get_rostime),
    "get_time": outcome(rospy.get_time),
    "spin": outcome(rospy.spin),
    "throttle": [
        outcome(function, 1, "x")
        for function in (rospy.loginfo_throttle, rospy.logdebug_throttle, rospy.logdebug_throttle_identical)
    ],
    "once": outcome(rospy.loginfo_once, "x"),
    "log": outcome(rospy.loginfo, "x"),
    "parameters": [
        outcome(rospy.set_param, "before", 1),
        outcome(rospy.get_param, "before"),
        outcome(rospy.has_param, "before"),
        outcome(rospy.delete_param, "before"),
        outcome(rospy.get_param, "before"),
        outcome(rospy.get_param, "~before", 3),
    ],
    "publish": outcome(rospy.Publisher("before", String, queue_size=1).publish, "x"),
    "unavailable": outcome(rospy.ServiceProxy("nothing", Empty)),
    "wait_for_service": outcome(rospy.wait_for_service, "nothing", 0.1),
    "names": [rospy.get_name(), rospy.get_namespace(), rospy.get_node_uri(), rospy.is_shutdown()],
    "clock": [rospy.rostime.is_wallclock(), rospy.rostime.is_rostime_initialized()],
}

rospy.init_node("peer")

# ---- names with two slashes ----

facts["slashes"] = [
    outcome(lambda kind=kind: kind("f//b", String, queue_size=1).resolved_name)
    for kind in (rospy.Publisher, rospy.Subscriber)
]

# ---- connection headers ----

requests = []


def handle(request):
    requests.append(request._connection_header)
    return {}


camera = rospy.Service("camera", SetCameraInfo, handle)
plain = rospy.ServiceProxy("camera", SetCameraInfo)
facts["responses"] = [
    plain()._connection_header,
    rospy.ServiceProxy("camera", SetCameraInfo, headers={"cookie": "abc"})()._connection_header,
    rospy.ServiceProxy("camera", SetCameraInfo, persistent=True)()._connection_header,
    rospy.ServiceProxy("camera", SetCameraInfo, True, {"cookie": "x", "callerid": "/me"})()._connection_header,
]
facts["requests"] = requests
facts["refused"] = outcome(rospy.ServiceProxy("camera", SetCameraInfo, headers={"md5sum": "12"}))

heard = []
own = rospy.Publisher("own", String, queue_size=5, latch=True, headers={"cookie": "abc"})
rospy.Subscriber("own", String, heard.append)
settle(lambda: own.get_num_connections() == 1)
own.publish("x")
settle(lambda: heard)
facts["topic"] = heard[0]._connection_header
facts["waited"] = rospy.wait_for_message("own", String)._connection_header

# ---- several subscribers of one node, and types of one md5 sum ----


def received(number, publisher_class, message, classes, late=False):
    """What subscribers of some classes get: the class of each message, and whether it is one object."""
    got = []
    topic = f"received_{number}"
    made = [rospy.Subscriber(topic, cls, got.append) for cls in (classes[:1] if late else classes)]
    publisher = rospy.Publisher(topic, publisher_class, queue_size=5, latch=late)
    settle(lambda: publisher.get_num_connections() == 1)
    publisher.publish(message)
    rest()
    if late:
        made += [rospy.Subscriber(topic, cls, got.append) for cls in classes[1:]]
        rest()
    kinds = [[type(one).__name__, type(getattr(one, "ranges", None)).__name__] for one in got]
    types = [one._connection_header["type"] for one in got]
    for topic in [*made, publisher]:
        topic.unregister()
    return kinds, types, all(one is got[0] for one in got)


scan = LaserScan(ranges=[1.0, 2.0])
facts["received"] = [
    received(number, *arguments)
    for number, arguments in enumerate(
        [
            (String, String("x"), [String, String]),
            (LaserScan, scan, [LaserScan, LaserScan]),
            (String, String("x"), [rospy.AnyMsg, String]),
            (String, String("x"), [String, rospy.AnyMsg]),
            (LaserScan, scan, [numpy_msg(LaserScan), LaserScan]),
            (LaserScan, scan, [LaserScan, numpy_msg(LaserScan)]),
            (LaserScan, scan, [LaserScan, LaserScan], True),
            (LaserScan, scan, [LaserScan, rospy.AnyMsg], True),
            (Point, Point(1, 2, 3), [Vector3]),
            (Point, Vector3(1, 2, 3), [Vector3, Point]),
        ]
    )
]
points = rospy.Publisher("points", Point, queue_size=5)
facts["publishes"] = [
    outcome(points.publish, Vector3(1, 2, 3)),
    outcome(rospy.Publisher("points", Vector3, queue_size=5).publish, Vector3(1, 2, 3)),
    outcome(points.publish, Pose2D()),
    outcome(points.publish, String("x")),
]

# ---- what a service proxy raises ----
# Not asked for: a field of quite another kind (rospy lets an AttributeError of its own out there, ours names the
# field), and what is no service class or no name (rospy takes it, or lets an AttributeError out, where ours raises
# ValueError).

rospy.Service("none", SetCameraInfo, lambda _: None)
rospy.Service("none_empty", Empty, lambda _: None)
rospy.Service("empty", Empty, lambda _: [])
rospy.Service("wrong_type", SetCameraInfo, lambda _: ("x", "y"))
rospy.Service("wrong_count", SetCameraInfo, lambda _: (True, "y", 3))
rospy.Service("wrong_name", SetCameraInfo, lambda _: {"nothing": 1})
rospy.Service("wrong_class", SetCameraInfo, lambda _: String("x"))
facts["services"] = {
    "none": text_of(rospy.ServiceProxy("none", SetCameraInfo)),
    "none_empty": text_of(rospy.ServiceProxy("none_empty", Empty)),
    "empty": outcome(rospy.ServiceProxy("empty", Empty)),
    "answers": [
        outcome(rospy.ServiceProxy(name, SetCameraInfo))
        for name in ("wrong_type", "wrong_count", "wrong_name", "wrong_class")
    ],
    "arguments": [
        outcome(plain, *arguments)
        for arguments in (
            [1, 2],
            [None],
            [String("x")],
            [CameraInfo(width="x")],
            [CameraInfo(D=["x"])],
        )
    ],
    "keywords": [outcome(plain, **keywords) for keywords in ({"nothing": 1}, {"camera_info": None})],
    "both": outcome(plain, CameraInfo(), camera_info=CameraInfo()),
    "requests": [
        outcome(plain, SetCameraInfoRequest(camera_info=CameraInfo(height=-1))),
        outcome(plain.call, EmptyRequest()),
    ],
    "types": [outcome(rospy.ServiceProxy("camera", cls)) for cls in (Empty, GetLoggers, SetLoggerLevel)],
    "topics": [
        outcome(rospy.Publisher, *arguments, queue_size=1)
        for arguments in (
            ("", String), (None, String), ("x", None), ("x", Empty), ("x", "std_msgs/String"), ("x", Pose()),
        )
    ],
    "waits": [
        outcome(rospy.wait_for_message, *arguments)
        for arguments in (("", String, 0.1), ("x", None, 0.1), ("nothing", String, 0.1))
    ],
    "same": rospy.ServiceException is rospy.service.ServiceException,
}  # fmt: skip
persistent = rospy.ServiceProxy("camera", SetCameraInfo, persistent=True)
persistent()
persistent.close()
camera.shutdown("gone")
facts["services"]["gone"] = outcome(plain)

# ---- a timer that fails ----

ticks = {"bad": 0, "good": 0}


def bad(_):
    ticks["bad"] += 1
    raise ValueError("broken")


def good(_):
    ticks["good"] += 1


failing, going = rospy.Timer(rospy.Duration(0.02), bad), rospy.Timer(rospy.Duration(0.02), good)
settle(lambda: ticks["good"] >= 5 and not failing.is_alive())
facts["timer"] = [ticks["bad"], failing.is_alive(), ticks["good"] >= 5, going.is_alive(), rospy.is_shutdown()]
going.shutdown()

# ---- where a log message comes from ----

logs = []
rospy.Subscriber("/rosout", Log, logs.append)
settle(lambda: logs, 0.4)
del logs[:]


class Speaker:
    def speak(self):
        rospy.loginfo("method")
        rospy.logwarn_throttle(1, "throttled")
        shout = lambda: rospy.logerr("lambda")
        shout()


def speak():
    rospy.logwarn_once("function")


rospy.loginfo("module")
Speaker().speak()
speak()
settle(lambda: len(logs) == 5)
facts["rosout"] = [
    [log.level, log.name, log.msg, log.file, log.function, log.line, "/own" in log.topics] for log in logs
]
sys.stdout.write(json.dumps(facts) + "\n")
