"""A script for rospy that tells what rospy does, as JSON on its last line. Run by real rospy and by ours."""

import inspect
import json
import sys
import warnings

import genpy
import rosgraph
import roslib
import rospy
from geometry_msgs.msg import PointStamped, Twist
from roscpp.srv import GetLoggers
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import CameraInfo, Image, LaserScan
from sensor_msgs.srv import SetCameraInfo, SetCameraInfoRequest
from std_msgs.msg import Float32MultiArray, Int32, String

roslib.load_manifest("rospy")
facts = {}


def outcome(function, *args, **kwargs):
    """What a call returns, or the class of what it raises and all that a handler could catch it by."""
    try:
        return repr(function(*args, **kwargs))
    except Exception as error:
        public = {
            "ROSException", "ROSInitException", "ROSInterruptException", "ROSSerializationException",
            "ServiceException", "TypeError", "ValueError", "KeyError", "AttributeError", "KeyboardInterrupt",
        }  # fmt: skip
        return sorted({cls.__name__ for cls in type(error).__mro__} & public)


def text_of(function, *args, **kwargs):
    try:
        function(*args, **kwargs)
    except Exception as error:
        return str(error)
    return None


def signature(thing):
    """Names of the parameters, with defaults that are plain values."""
    return [
        [name, str(one.kind), one.default if isinstance(one.default, (int, float, str, type(None))) else None]
        for name, one in inspect.signature(thing).parameters.items()
    ]


# ---- names, signatures, types ----

PUBLIC = [
    "spin", "myargv", "init_node", "get_published_topics", "wait_for_message", "wait_for_service", "on_shutdown",
    "get_param", "get_param_cached", "get_param_names", "set_param", "delete_param", "has_param", "search_param",
    "sleep", "Rate", "Timer", "is_shutdown", "signal_shutdown", "get_node_uri", "get_ros_root", "parse_rosrpc_uri",
    "get_name", "get_caller_id", "get_namespace", "resolve_name", "remap_name", "get_rostime", "get_time",
    "Publisher", "Subscriber", "Service", "ServiceProxy", "SubscribeListener", "AnyMsg", "MasterProxy",
]  # fmt: skip
PUBLIC += [
    "log" + level + kind
    for level in ("debug", "info", "warn", "err", "fatal")
    for kind in ("", "_once", "_throttle", "_throttle_identical")
] + ["logout"]
facts["signatures"] = {name: signature(getattr(rospy, name)) for name in PUBLIC}
facts["methods"] = {
    name: signature(getattr(cls, method))
    for cls, methods in (
        (rospy.Publisher, ["publish", "unregister", "get_num_connections"]),
        (rospy.Subscriber, ["unregister", "get_num_connections"]),
        (rospy.ServiceProxy, ["call", "__call__", "wait_for_service", "close"]),
        (rospy.Service, ["spin", "shutdown"]),
        (rospy.Rate, ["sleep", "remaining"]),
        (rospy.SubscribeListener, ["peer_subscribe", "peer_unsubscribe"]),
        (rospy.Timer, ["shutdown"]),
    )
    for method in methods
    for name in [cls.__name__ + "." + method]
}
facts["missing"] = [
    name
    for name in [
        *PUBLIC, "Header", "Message", "Time", "Duration", "MasterProxy", "ServiceException", "TransportException",
        "TransportInitError", "TransportTerminated", "ROSInternalException", "ROSTimeMovedBackwardsException",
        "DEBUG", "FATAL",
    ]
    if not hasattr(rospy, name)
]  # fmt: skip
facts["levels"] = [rospy.DEBUG, rospy.INFO, rospy.WARN, rospy.ERROR, rospy.FATAL]
facts["errors"] = {
    cls.__name__: sorted(
        base.__name__ for base in cls.__mro__ if base.__name__ not in ("RosminiError", "object")
    )
    for cls in (
        rospy.ROSException, rospy.ROSInitException, rospy.ROSInterruptException, rospy.ROSSerializationException,
        rospy.ROSTimeMovedBackwardsException, rospy.TransportException, rospy.TransportInitError,
        rospy.ServiceException, genpy.MessageException, genpy.SerializationError, rosgraph.MasterError,
    )
}  # fmt: skip
t, d, g = rospy.Time(5, 5), rospy.Duration(1), genpy.Time(3)
facts["time types"] = [
    "genpy" if "genpy" in repr(x) else type(x).__name__
    for x in (t - t, t - d, t + d, d + t, d - d, d * 2, 2 * d, d / 2, -d, g - d, t - g)
]
facts["time text"] = [
    repr(t), repr(d), str(t), str(d), repr(t - t), repr(rospy.Time.from_seconds(1.5)), t == genpy.Time(5, 5), t > g,
]  # fmt: skip

# ---- before init_node ----

facts["early"] = {
    "names": [
        rospy.get_name(),
        rospy.get_caller_id(),
        rospy.get_namespace(),
        rospy.get_node_uri(),
        rospy.resolve_name("~a"),
        rospy.resolve_name("b/"),
    ],
    "remapped": [rospy.resolve_name("chatter"), rospy.remap_name("chatter"), rospy.remap_name("other")],
    "now": outcome(rospy.Time.now),
    "get_time": outcome(rospy.get_time),
    "rate": outcome(rospy.Rate, 10),
    "spin": outcome(rospy.spin),
    "sleep": outcome(rospy.sleep, 0.01),
    "is_shutdown": rospy.is_shutdown(),
    "set_param": outcome(rospy.set_param, "early", 1),
    "get_param": [
        outcome(rospy.get_param, "early"),
        outcome(rospy.get_param, "/nothing"),
        outcome(rospy.get_param, "nothing", 5),
    ],
    "private topic": outcome(rospy.Publisher, "~t", String, queue_size=1),
    "no service": outcome(rospy.ServiceProxy("/nothing", SetCameraInfo)),
    "wait_for_service": [
        outcome(rospy.wait_for_service, "/nothing", 0.1),
        outcome(rospy.wait_for_service, "/nothing", rospy.Duration(0.1)),
    ],
    "wait zero": outcome(rospy.wait_for_service, "/nothing", 0),
    "hook": [outcome(rospy.on_shutdown, 5), outcome(rospy.on_shutdown, "x")],
    "master": [rosgraph.is_master_online(), rospy.get_master().getPid()[0]],
}
early = rospy.Publisher("early", String, queue_size=1)
facts["early"]["publish"] = outcome(early.publish, "x")
facts["init"] = {name: outcome(rospy.init_node, name) for name in ("", "a/b", "/a")}

rospy.init_node("peer", log_level=rospy.DEBUG)
facts["init"]["same"] = outcome(rospy.init_node, "peer", log_level=rospy.DEBUG)
facts["init"]["other"] = outcome(rospy.init_node, "other")
facts["names"] = [
    rospy.get_name(), rospy.get_namespace(), rospy.resolve_name("~a"), rospy.resolve_name("~/a"),
    rospy.resolve_name("a//b/"), rospy.resolve_name(""), rospy.resolve_name("chatter"),
    rospy.resolve_name("a", "/x/y"), rospy.get_node_uri() is not None,
]  # fmt: skip
facts["argv"] = rospy.myargv(["a", "b:=c", "_d:=1", "__name:=x", "-e", ":=", "f:="])

# ---- topics ----

arguments = {
    "empty name": ("", String),
    "number": (5, String),
    "no class": ("t", None),
    "an instance": ("t", String()),
    "int": ("t", int),
}
facts["bad topics"] = {
    name: [outcome(rospy.Publisher, *given, queue_size=1), outcome(rospy.Subscriber, *given)]
    for name, given in arguments.items()
}
facts["bad sizes"] = [
    outcome(rospy.Subscriber, "t", String, print, queue_size=0),
    outcome(rospy.Subscriber, "t", String, print, queue_size="1"),
    outcome(rospy.Subscriber, "t", String, print, buff_size=-1),
]
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    rospy.Publisher("no_queue_size", String)
facts["queue_size"] = [[one.category.__name__, "queue_size" in str(one.message)] for one in caught]

received = []
publisher = rospy.Publisher("twist", Twist, queue_size=10)
subscriber = rospy.Subscriber(
    "twist", Twist, lambda message, extra: received.append([message.linear.x, extra]), "extra"
)
events = []


class Listener(rospy.SubscribeListener):
    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        events.append(["came", topic_name])
        peer_publish(String("welcome"))

    def peer_unsubscribe(self, topic_name, num_peers):
        events.append(["went", topic_name, num_peers])


def wait(condition, limit=200.0):
    end = rospy.get_time() + limit
    while not condition() and rospy.get_time() < end:
        rospy.sleep(0.02)
    return condition()


wait(lambda: publisher.get_num_connections() and subscriber.get_num_connections())
facts["connected"] = [
    publisher.get_num_connections(),
    subscriber.get_num_connections(),
    publisher.name,
    publisher.type,
    subscriber.resolved_name,
]
twist = Twist()
twist.linear.x = 1.0
publisher.publish(twist)
publisher.publish(twist.linear, twist.angular)
publisher.publish(linear=twist.linear)
publisher.publish()
wait(lambda: len(received) == 4)
facts["publish"] = received
facts["bad publish"] = {
    "another type": outcome(publisher.publish, String("x")),
    "three": outcome(publisher.publish, 1, 2, 3),
    "both": outcome(publisher.publish, twist.linear, linear=twist.linear),
    "unknown field": outcome(publisher.publish, linaer=twist.linear),
}
numbers = rospy.Publisher("numbers", Int32, queue_size=1)
numbers_in = rospy.Subscriber("numbers", Int32)
wait(numbers.get_num_connections)
facts["bad field"] = outcome(numbers.publish, "seven")

latched = rospy.Publisher("latched", String, latch=True, queue_size=1)
latched.publish("kept")
first, second = [], []
late = rospy.Subscriber("latched", String, first.append)
wait(lambda: len(first) == 1)
again = rospy.Subscriber("latched", String, second.append)
wait(lambda: second)
facts["latched"] = [
    sorted(message.data for message in first),
    [message.data for message in second],
    {key: first[0]._connection_header[key] for key in ("callerid", "latching", "md5sum", "type", "topic")},
]
late.unregister()
again.unregister()
announced = rospy.Publisher("announced", String, subscriber_listener=Listener(), queue_size=1)
welcomed = []
newcomer = rospy.Subscriber("announced", String, lambda message: welcomed.append(message.data))
wait(lambda: len(welcomed) == 1)
newcomer.unregister()
wait(lambda: len(events) == 2)
facts["listener"] = [events, welcomed]

got = {}
for name, cls in (("scan", LaserScan), ("image", Image), ("floats", Float32MultiArray)):
    source = rospy.Publisher(name, cls, queue_size=1, latch=True)
    source.publish(
        {"scan": LaserScan(ranges=[1, 2]), "image": Image(data=b"ab"), "floats": Float32MultiArray(data=[1, 2])}[name]
    )
    for kind, wanted in (("plain", cls), ("numpy", numpy_msg(cls)), ("any", rospy.AnyMsg)):
        if not (name == "image" and kind == "numpy"):
            got[name, kind] = rospy.wait_for_message(name, wanted, timeout=200)
        rospy.sleep(0.2)
facts["receipt"] = [
    [type(got["scan", "plain"].ranges).__name__, got["scan", "plain"].ranges],
    [type(got["image", "plain"].data).__name__, got["image", "plain"].data.decode()],
    [
        type(got["scan", "numpy"].ranges).__name__,
        got["scan", "numpy"].ranges.dtype.name,
        got["scan", "numpy"].ranges.tolist(),
        got["scan", "numpy"].ranges.flags.writeable,
        isinstance(got["scan", "numpy"], LaserScan),
    ],
    [
        type(got["floats", "any"]).__name__,
        got["floats", "any"]._buff.hex(),
        got["floats", "any"]._connection_header["type"],
        got["floats", "any"]._has_header,
        got["floats", "any"]._md5sum,
        list(got["floats", "any"].__slots__),
    ],
]

points = []
stamped = rospy.Publisher("points", PointStamped, queue_size=10)
point_subscriber = rospy.Subscriber("points", PointStamped, points.append)
wait(stamped.get_num_connections)
own = PointStamped()
own.header.seq, own.header.stamp = 77, rospy.Time(3)
for _ in range(3):
    stamped.publish(own)
wait(lambda: len(points) == 3)
facts["header"] = [
    [p.header.seq for p in points],
    own.header.seq,
    points[0].header.stamp.secs,
    points[0].header.frame_id,
]
facts["wait_for_message"] = [
    outcome(rospy.wait_for_message, "nothing", String, 0.1),
    "timeout exceeded" in text_of(rospy.wait_for_message, "nothing", String, 0.1),
]
publisher.unregister()
facts["unregistered"] = outcome(publisher.publish)

# ---- services ----


def handle(request):
    if not request.camera_info.width:
        raise ValueError("deliberate")
    return True, "yes"


def refuse(_):
    raise rospy.ServiceException("not now")


errors = []
yes = CameraInfo(width=1)
rospy.Service(
    "good",
    SetCameraInfo,
    handle,
    error_handler=lambda e, kind, value, trace: errors.append([str(e), kind.__name__, value is e, trace is not None]),
)
rospy.Service("refuses", SetCameraInfo, refuse)
rospy.Service("none", SetCameraInfo, lambda _: None)
rospy.Service("short", SetCameraInfo, lambda _: (True,))
rospy.Service("dict", SetCameraInfo, lambda _: {"status_message": "partly"})
rospy.Service("single", SetCameraInfo, lambda _: "text")
good = rospy.ServiceProxy("good", SetCameraInfo)
persistent = rospy.ServiceProxy("good", SetCameraInfo, persistent=True)
facts["services"] = {
    "calls": [
        good(yes).status_message,
        good(camera_info=yes).status_message,
        good.call(SetCameraInfoRequest(yes)).status_message,
        persistent(yes).status_message,
        persistent(yes).status_message,
    ],
    "handler raises": [outcome(good, CameraInfo()), text_of(good, CameraInfo())],
    "handler refuses": text_of(rospy.ServiceProxy("refuses", SetCameraInfo)),
    "handler returns None": text_of(rospy.ServiceProxy("none", SetCameraInfo)),
    "too few": outcome(rospy.ServiceProxy("short", SetCameraInfo)),
    "one of two": outcome(rospy.ServiceProxy("single", SetCameraInfo)),
    "dict": rospy.ServiceProxy("dict", SetCameraInfo)().status_message,
    "errors": errors,
    "unavailable": [
        outcome(rospy.ServiceProxy("nothing", SetCameraInfo)),
        "service [/nothing] unavailable" in text_of(rospy.ServiceProxy("nothing", SetCameraInfo)),
    ],
    "wrong type": outcome(rospy.ServiceProxy("good", GetLoggers)),
    "wrong request": outcome(good, String("x")),
    "wrong count": outcome(good, 1, 2),
    "twice": outcome(rospy.Service, "good", SetCameraInfo, handle),
}
persistent.close()

# ---- parameters ----

rospy.set_param("~tree", {"a": 1, "b": {"c": [1, 2.5, "x", True]}})
rospy.set_param("~text", "yes")
facts["parameters"] = [
    rospy.get_param("~tree/b/c"), rospy.get_param("/peer"), rospy.get_param("~/text", "default"),
    rospy.has_param("~tree/a"), rospy.has_param("tree"), rospy.search_param("tree"), rospy.search_param("nothing"),
    outcome(rospy.get_param, "~nothing"), outcome(rospy.get_param, "~nothing", None),
    outcome(rospy.delete_param, "~text"), outcome(rospy.delete_param, "~text"), rospy.get_param_cached("~tree/a"),
    "/peer/tree/a" in rospy.get_param_names(), "/peer/tree" in rospy.get_master(),
    outcome(lambda: rospy.get_master()["/nothing"]), rospy.get_param("/peer/started"),
]  # fmt: skip
master = rosgraph.Master("/peer")
state = dict(map(tuple, master.getSystemState()[0]))
facts["master"] = [
    state["/latched"],
    outcome(master.lookupNode, "/nobody") == outcome(rosgraph.Master("x").lookupNode, "/nobody"),
    rosgraph.myargv(["a", "b:=c"]),
]
facts["published"] = sorted(
    pair for pair in rospy.get_published_topics("/") if pair[0] in ("/latched", "/scan", "/early")
)

# ---- time ----

ticks = []
timer = rospy.Timer(rospy.Duration(0.05), ticks.append)
wait(lambda: len(ticks) >= 2)
timer.shutdown()
rate = rospy.Rate(50)
rate.sleep()
facts["timer"] = [
    [ticks[0].last_expected, ticks[0].last_real, ticks[0].last_duration],
    [
        type(value).__name__
        for value in (
            ticks[1].last_expected,
            ticks[1].last_real,
            ticks[1].current_expected,
            ticks[1].current_real,
            ticks[1].last_duration,
        )
    ],
    ticks[1].last_expected == ticks[0].current_expected,
    ticks[1].current_expected - ticks[0].current_expected == rospy.Duration(0.05),
]
facts["rate"] = [repr(rate.sleep_dur), type(rate.remaining()).__name__]
facts["sleep"] = [
    outcome(rospy.sleep, -1),
    outcome(rospy.sleep, rospy.Duration(0.01)),
    outcome(rospy.sleep, genpy.Duration(0, 1)),
]

# ---- the end ----

order = []
rospy.on_shutdown(lambda: order.append(["first", rospy.is_shutdown(), rospy.core.is_shutdown_requested()]))
rospy.on_shutdown(lambda: order.append(["second", outcome(latched.publish, "still")]))
rospy.core.add_preshutdown_hook(lambda reason: order.append(["before", reason]))
rospy.core.add_shutdown_hook(lambda reason: order.append(["after", reason]))
rospy.signal_shutdown("done")
rospy.on_shutdown(lambda: order.append(["late"]))
facts["shutdown"] = {
    "order": order,
    "is_shutdown": rospy.is_shutdown(),
    "publish": outcome(latched.publish, "x"),
    "spin": outcome(rospy.spin),
    "get_time": rospy.get_time() > 0,
    "wait_for_message": outcome(rospy.wait_for_message, "nothing", String, 1),
}
sys.stdout.write(json.dumps(facts) + "\n")
