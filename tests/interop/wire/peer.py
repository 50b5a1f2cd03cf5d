#!/usr/bin/env python3
"""A node that does what it is told: one command a line on standard input, one answer a line on standard output.

Run by real rospy and by ours. A command is JSON, {"do": name, ...}; an answer is JSON after "@ ". Messages travel as
YAML, as `rostopic echo` shows them.
"""

import faulthandler
import json
import os
import signal
import sys

import actionlib
import genpy
import roslib.message
import rospy
import tf2_ros
import yaml
from actionlib.msg import TestAction, TestFeedback, TestGoal, TestResult
from geometry_msgs.msg import TransformStamped

publishers, heard, subscribers, services, proxies, kept = {}, {}, {}, {}, {}, {}


def wait(condition):
    """Wait in wall time; the test has the patience."""
    while not condition() and not rospy.is_shutdown():
        rospy.rostime.wallsleep(0.005)


def fill(message, content):
    genpy.message.fill_message_args(message, content if isinstance(content, list) else [content])
    return message


def plain(message):
    return yaml.load(str(message), getattr(yaml, "CSafeLoader", yaml.SafeLoader))


def advertise(topic, type, **options):
    cls = roslib.message.get_message_class(type)
    publishers[topic] = rospy.Publisher(topic, cls, **{"queue_size": 100, **options})


def publish(topic, messages):
    for content in messages:
        publishers[topic].publish(fill(publishers[topic].data_class(), content))


def connected(topic, count=1):
    """Wait until so many are connected to the publisher."""
    wait(lambda: publishers[topic].get_num_connections() == count)
    return count


def flood(topic, size, count):
    """Publish `count` messages of `size` bytes, as fast as it goes; return how many seconds of wall time it took."""
    data = "x" * size
    for _ in range(count):
        publishers[topic].publish(data)
    return count


def connections(topic):
    return publishers[topic].get_num_connections()


def unadvertise(topic):
    publishers.pop(topic).unregister()


def subscribe(topic, type="*", what="message", **options):
    """Hear messages; with `what`, only their "header", the "size" of their text, or the "x" of an odometry."""
    heard[topic] = []
    cls = rospy.AnyMsg if type == "*" else roslib.message.get_message_class(type)
    look = {
        "message": plain,
        "header": lambda message: message._connection_header,
        "size": lambda message: [len(message.data), len(set(message.data))],
        "x": lambda message: message.pose.pose.position.x,
    }[what]
    subscribers[topic] = rospy.Subscriber(topic, cls, lambda message: heard[topic].append(look(message)), **options)


def unsubscribe(topic):
    subscribers.pop(topic).unregister()


def hear(topic, count=1):
    """Wait until so many messages were heard; return them, and forget them."""
    wait(lambda: len(heard[topic]) >= count)
    found = heard[topic][:]
    del heard[topic][: len(found)]
    return found


def forget(topic):
    del heard[topic][:]


def hear_until(topic, field, value):
    """Forget what is heard until a message's field has a value; return that message."""
    while not rospy.is_shutdown():
        for message in hear(topic):
            if message[field] == value:
                return message
    return None


def header(topic):
    """The header of the connection through which a message came."""
    cls = rospy.AnyMsg
    message = rospy.wait_for_message(topic, cls)
    return message._connection_header


def serve(service, type, answer):
    cls = roslib.message.get_service_class(type)
    requests = heard.setdefault(service, [])

    def handle(request):
        requests.append(plain(request))
        if answer == "raise":
            raise ValueError("not today")
        return None if answer is None else fill(cls._response_class(), answer)

    services[service] = rospy.Service(service, cls, handle)


def stop_serving(service):
    services.pop(service).shutdown()


def call(service, type, request, count=1, persistent=False):
    rospy.wait_for_service(service)
    cls = roslib.message.get_service_class(type)
    proxy = proxies.get(service) if persistent else None
    if proxy is None:
        proxy = proxies[service] = rospy.ServiceProxy(service, cls, persistent=persistent)
    try:
        for _ in range(count):
            answer = proxy(fill(cls._request_class(), request))
    except rospy.ServiceException as error:
        return {"error": str(error)}
    return plain(answer)


def call_now(service, type):
    """Call, as a server that is gone is called: once more through the persistent proxy, and through a new one."""
    cls = roslib.message.get_service_class(type)
    try:
        return plain(rospy.ServiceProxy(service, cls)(cls._request_class()))
    except rospy.ServiceException as error:
        return {"error": str(error)}


def forget_proxy(service):
    proxies.pop(service).close()


def publish_until_alone(topic):
    """Publish until the connection to a subscriber that is gone has broken."""

    def alone():
        publishers[topic].publish("anyone?")
        return publishers[topic].get_num_connections() == 0

    wait(alone)


def now_is(seconds):
    wait(lambda: rospy.get_time() == seconds)
    return rospy.get_time()


def param(method, *arguments):
    try:
        return getattr(rospy, method)(*arguments)
    except KeyError as error:
        return {"KeyError": str(error)}


def cached_becomes(name, value):
    wait(lambda: rospy.get_param_cached(name) == value)
    return rospy.get_param_cached(name)


def log(level, text):
    getattr(rospy, "log" + level)("%s", text)


def now():
    return rospy.get_time()


def sleep(seconds):
    """Sleep in the node's time; return how long that was in it."""
    before = rospy.get_time()
    rospy.sleep(seconds)
    return rospy.get_time() - before


def tick(topic="clock", seconds=0.0):
    """Publish a time on /clock."""
    publishers[topic].publish(rospy.Time.from_sec(seconds))


def answer_late(topic, seconds):
    """Let real rospy take its time between its answer to a subscriber of a topic and the first message to it."""
    if hasattr(rospy, "topics"):  # ours has no such moment
        publication = rospy.topics.get_topic_manager().get_publisher_impl(rospy.resolve_name(topic))
        add = publication.add_connection
        publication.add_connection = lambda link: (rospy.rostime.wallsleep(seconds), add(link))[1]


def serve_action(name):
    """Serve actionlib/TestAction: feedback 1, 2, the goal; a goal below 0 waits for a cancel.

    It begins when the client says that it follows the goal: rospy's would not hear of what comes sooner.
    """

    def execute(goal):
        wait(lambda: rospy.get_param(name + "/followed", None) == goal.goal)
        for number in (1, 2, goal.goal):
            server.publish_feedback(TestFeedback(number))
        wait(lambda: goal.goal >= 0 or server.is_preempt_requested())
        if server.is_preempt_requested():
            server.set_preempted(TestResult(0), "cancelled")
        else:
            server.set_succeeded(TestResult(2 * goal.goal), "there")

    server = kept[name] = actionlib.SimpleActionServer(name, TestAction, execute, auto_start=False)
    server.start()


def send_goal(name, goal, cancel=False):
    client = kept.get(name) or kept.setdefault(name, actionlib.SimpleActionClient(name, TestAction))
    client.wait_for_server()
    feedback = []
    client.send_goal(TestGoal(goal), feedback_cb=lambda message: feedback.append(message.feedback))
    rospy.set_param(name + "/followed", goal)
    if cancel:
        wait(lambda: len(feedback) == 3)
        client.cancel_goal()
    client.wait_for_result()
    return [client.get_state(), client.get_result().result, client.get_goal_status_text()]


def send_transform(parent, child, x, static=False):
    kind = tf2_ros.StaticTransformBroadcaster if static else tf2_ros.TransformBroadcaster
    one = TransformStamped()
    one.header.stamp, one.header.frame_id, one.child_frame_id = rospy.Time.now(), parent, child
    one.transform.translation.x, one.transform.rotation.w = x, 1.0
    kept.setdefault(("tf", static), kind()).sendTransform(one)


def broadcast(parent, child, x):
    """Send a transform ten times a second."""
    kept["timer"] = rospy.Timer(rospy.Duration(0.1), lambda event: send_transform(parent, child, x))


def look_up(target, source):
    if "buffer" not in kept:
        kept["buffer"] = tf2_ros.Buffer()
        kept["listener"] = tf2_ros.TransformListener(kept["buffer"])
    wait(lambda: kept["buffer"].can_transform(target, source, rospy.Time(0)))
    return kept["buffer"].lookup_transform(target, source, rospy.Time(0)).transform.translation.x


def test_config(path):
    """The module that dynamic_reconfigure's own Test.cfg became, read as it is."""
    import types

    module = types.ModuleType("TestConfig")
    with open(path, encoding="utf-8") as source:
        exec(source.read(), module.__dict__)
    return module


def serve_config(path):
    from dynamic_reconfigure.server import Server

    kept["config"] = []

    def changed(config, level):
        kept["config"].append([config["int_"], config["str_"]])
        return config

    kept["config server"] = Server(test_config(path), changed)


def configured():
    return kept["config"]


def configure(node, changes):
    from dynamic_reconfigure.client import Client

    client = Client(node)
    found = client.update_configuration(changes)
    description = [one["name"] for one in client.get_parameter_descriptions()]
    client.close()
    return [found["int_"], found["str_"], description]


def every(topic, period=0.1):
    """Publish a count again and again."""
    count = [0]

    def send(event):
        count[0] += 1
        publishers[topic].publish(fill(publishers[topic].data_class(), [count[0]]))

    kept[("every", topic)] = rospy.Timer(rospy.Duration(period), send)


def every_joint_state(topic, name, position):
    message = publishers[topic].data_class(name=[name], position=[position])

    def send(event):
        message.header.stamp = rospy.Time.now()
        publishers[topic].publish(message)

    kept[("every", topic)] = rospy.Timer(rospy.Duration(0.1), send)


def state(method, *arguments):
    """What a call of the Master answers."""
    return getattr(rospy.get_master(), method)(*arguments)


def end():
    rospy.signal_shutdown("told to end")


def main():
    faulthandler.register(signal.SIGUSR1)  # what all threads do, to standard error
    rospy.init_node("peer")
    if "PEER_ADVERTISES" in os.environ:
        advertise(os.environ["PEER_ADVERTISES"], "std_msgs/String")
    print("@ " + json.dumps(["ready", rospy.get_name(), rospy.get_node_uri()]), flush=True)
    while not rospy.is_shutdown():
        line = sys.stdin.readline()
        if not line:
            break
        command = json.loads(line)
        arguments = command.pop("with", [])
        try:
            answer = globals()[command.pop("do")](*arguments, **command)
        except rospy.ROSInterruptException:
            break
        except Exception as error:
            answer = {"raised": type(error).__name__ + ": " + str(error)}
        print("@ " + json.dumps(answer), flush=True)
    rospy.signal_shutdown("no more commands")


main()
