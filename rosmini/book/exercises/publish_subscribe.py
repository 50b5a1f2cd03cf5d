"""Checks of the exercises in the chapter Publish and subscribe: nodes in the middle, and a service of callbacks."""

from __future__ import annotations

from contextlib import redirect_stdout
from io import StringIO
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import Float32

COURIER = """
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Float32

def on_order(order):
    command = Twist()
    command.linear.x = 0.2
    end = rospy.Time.now() + rospy.Duration(order.data / 0.2)
    while rospy.Time.now() < end:
        cmd_vel.publish(command)
        rospy.sleep(0.1)

rospy.init_node("courier")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("order", Float32, on_order)
rospy.spin()
"""

TURN = """
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Float32

def on_alarm(distance):
    global until
    until = rospy.Time.now() + rospy.Duration(3.1)

def drive(event):
    command = Twist()
    if rospy.Time.now() < until:
        command.angular.z = 1.0
    else:
        command.linear.x = 0.2
    cmd_vel.publish(command)

rospy.init_node("turner")
until = rospy.Time()
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("alarm", Float32, on_alarm)
rospy.Timer(rospy.Duration(0.1), drive)
rospy.spin()
"""


# ---- history: the last three orders ----

SENT = (0.9, 0.2, 0.3, 0.4)
"""Distances of the orders [m]."""


@exercise("history", praise="A latched topic keeps one message; your node keeps three.", gaps=2)
def history(answer: Script) -> Any:
    """A node sends the last messages to each new subscriber, and a late robot drives them."""
    heard: dict[str, list[float]] = {"early": [], "late": [], "later": []}

    def listen(trial: Trial, name: str) -> None:
        trial.graph.node(name).subscriber("history", Float32, lambda order: heard[name].append(round(order.data, 3)))
        trial.run(0.2)

    with Trial("room") as trial:
        trial.start(answer)
        trial.run(0.5)
        expect("/history" in trial.graph.nodes, "There is no node /history.", "do not change the name in init_node")
        listen(trial, "early")
        office = trial.graph.node("office")
        order = office.publisher("order", Float32, queue_size=10)
        trial.run(0.5)
        expect(order.num_connections(), "Your node does not subscribe to /order.", "use rospy.Subscriber")
        for number, distance in enumerate(SENT):
            order.publish(distance)
            trial.run(0.5)
            if number == 1:
                listen(trial, "late")
        office.shutdown()
        listen(trial, "later")
        for name, right, when in (("late", SENT[:2], "the second"), ("later", SENT[1:], "the last")):
            expect(
                heard[name] == list(right),
                f"A subscriber to /history that started after {when} of the orders {_listed(SENT)} received "
                f"{_listed(heard[name]) or 'nothing'}, not {_listed(right)}.",
                "keep the last three, and send them in peer_subscribe, the oldest first",
            )
        expect(
            heard["early"] == [],
            f"A subscriber that started before all orders received {_listed(heard['early'])} on /history.",
            "send the orders only to the new subscriber: publish_to_peer",
        )
        trial.start(Script("courier.py", COURIER), "order:=history")
        trial.run(6.0)
        trial.expect_no_errors()
        return trial.view()


# ---- alarm: say it once ----

LIMIT = 1.0
"""A distance below this raises the alarm [m]."""


@exercise("alarm", praise="Your node remembers one bit, and that is enough.")
def alarm(answer: Script) -> Any:
    """A filter passes on a distance when it falls below the limit, and a robot turns round."""
    got: list[float] = []
    right: list[float] = []
    was_near = False

    def watch(scan: Any) -> None:
        nonlocal was_near
        is_near = scan.ranges[0] < LIMIT
        if is_near and not was_near:
            right.append(round(scan.ranges[0], 3))
        was_near = is_near

    with Trial("arena") as trial:
        witness = trial.graph.node("witness")
        witness.subscriber("scan", LaserScan, watch)
        witness.subscriber("alarm", Float32, lambda message: got.append(round(message.data, 3)))
        trial.start(answer)
        trial.start(Script("turn.py", TURN))
        trial.run(40.0)
        trial.expect_no_errors()
        expect(got, "There was no alarm, although the robot came close to a wall.", "compare with 1.0, and publish")
        expect(
            got == right,
            f"There were {len(got)} alarms ({_listed(got[:5])}); there should be {len(right)} ({_listed(right[:5])}).",
            "publish if this scan is near and the one before was not",
        )
        return trial.view()


def _listed(values: Any) -> str:
    return ", ".join(f"{value:g}" for value in values)


# ---- better_service: a better event service ----


@exercise("better_service", praise="An error in one subscriber affects neither the publisher nor other subscribers.")
def better_service(answer: Any) -> None:
    """An event service that survives its subscribers."""
    with redirect_stdout(StringIO()):  # it may print anything about a failed callback
        _examine(answer())


def _examine(service: Any) -> None:
    got: list[tuple[str, Any]] = []

    def first(event: Any) -> None:
        got.append(("first", event))
        service.unsubscribe("news", first)

    def second(event: Any) -> None:
        got.append(("second", event))
        raise ValueError(event)

    def third(event: Any) -> None:
        got.append(("third", event))

    try:
        service.publish("empty", 0)
    except Exception as error:
        expect(False, f"publish on a topic without subscribers raised {type(error).__name__}.", "dict.get")
    for callback in (first, second, third):
        service.subscribe("news", callback)
    service.subscribe("other", lambda event: got.append(("other", event)))
    for event in (1, 2):
        try:
            service.publish("news", event)
        except ValueError:
            expect(
                False, "A callback failed, and its exception reached the publisher.", "use try and except in publish"
            )
        if event == 1:
            called = [name for name, _ in got]
            expect("other" not in called, "A subscriber to another topic was called.", "keep a list for each topic")
            expect(
                "third" in called,
                "A callback failed, and the callbacks after it were not called.",
                "put try inside the loop",
            )
            expect(
                "second" in called,
                "A callback unsubscribed itself, and the next one was skipped.",
                "iterate over a copy of the list",
            )
            expect(
                called == ["first", "second", "third"],
                f"The calls were {called}.",
                "call them in the order of subscription",
            )
    expect(
        got[3:] == [("second", 2), ("third", 2)],
        f"After first had unsubscribed, the next event went to {[name for name, _ in got[3:]]}.",
        "remove the callback from its topic's list in unsubscribe",
    )
