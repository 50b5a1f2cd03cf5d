"""Checks of the exercises in the chapter Actions: each runs a script with a separate robot."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect
from rosmini.book.trials import Trial
from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.msgs import action_class, message_class
from rosmini.msgs.std_msgs.msg import Empty

ACTION = "notebook/Drive"
"""The action that the chapter defines in a cell."""


SERVER = """
import math
import actionlib
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from notebook.msg import DriveAction, DriveFeedback, DriveResult
from sensor_msgs.msg import LaserScan

latest = {}

def on_odom(odom):
    latest["place"] = odom.pose.pose.position

def on_scan(scan):
    latest["ahead"] = min(scan.ranges[:20] + scan.ranges[-20:])
    latest["behind"] = min(scan.ranges[160:200])

def drive(goal):
    start, rate, speed = latest["place"], rospy.Rate(10), Twist()
    speed.linear.x = 0.2 if goal.distance > 0 else -0.2
    front = "ahead" if goal.distance > 0 else "behind"
    travelled = 0.0
    while travelled < abs(goal.distance):
        if server.is_preempt_requested():
            wheels.publish(Twist())
            server.set_preempted(DriveResult(travelled), "stopped")
            return
        if latest[front] < 0.3:
            wheels.publish(Twist())
            server.set_aborted(DriveResult(travelled), "blocked")
            return
        wheels.publish(speed)
        server.publish_feedback(DriveFeedback(travelled))
        rate.sleep()
        place = latest["place"]
        travelled = math.hypot(place.x - start.x, place.y - start.y)
    wheels.publish(Twist())
    server.set_succeeded(DriveResult(travelled), "arrived")

rospy.init_node("drive_server")
wheels = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("odom", Odometry, on_odom)
rospy.Subscriber("scan", LaserScan, on_scan)
while len(latest) < 3:
    rospy.sleep(0.1)
server = actionlib.SimpleActionServer("drive", DriveAction, drive, auto_start=False)
server.start()
rospy.spin()
"""
"""A server that drives in both directions."""


def _serve(trial: Trial) -> None:
    """Start the check's own action server. Raises `Wrong` if the reader has not defined the action."""
    expect_action()
    trial.start(Script("drive_server.py", SERVER))
    trial.run(1.0)


def expect_action() -> None:
    """Expect the action of the chapter."""
    try:
        action_class(ACTION)
    except Exception as error:
        raise Wrong(f"There is no action {ACTION}.", "run the cell %%action Drive") from error


def _client(trial: Trial) -> tuple[SimpleActionClient, Any]:
    """Return a client of the check, and the class of its goals. Raises `Wrong` if no server answers."""
    expect_action()
    client = SimpleActionClient(trial.graph.node("check"), "drive", action_class(ACTION))
    expect(
        client.wait_for_server(3.0),
        "No action server answers on /drive.",
        "keep the lines below the function, and call server.start()",
    )
    return client, message_class(f"{ACTION}Goal")


def _place(trial: Trial) -> float:
    """Return the robot's x coordinate [m]."""
    return float(trial.robot.truth()[0])


# ---- stop_button: a stop button ----


@exercise("stop_button", praise="It stops a robot without knowing who sent it, or where to.")
def stop_button(answer: Script) -> Any:
    """The node cancels all goals of the action at each message on /stop."""
    with Trial("arena", "_x:=-1.5") as trial:
        _serve(trial)
        client, goal = _client(trial)
        trial.start(answer)
        stop = trial.graph.node("finger").publisher("stop", Empty, queue_size=1)
        trial.run(0.5)
        expect(stop.num_connections(), "No node subscribes to /stop.", "keep the line rospy.Subscriber")
        for number in (1, 2):
            begin = _place(trial)
            client.send_goal(goal(distance=1.5))
            trial.run(2.0)
            expect(
                _place(trial) > begin + 0.2,
                f"Goal {number} was cancelled before a message on /stop.",
                "publish on drive/cancel in the callback only",
            )
            stop.publish(Empty())
            trial.run(1.5)
            state = client.get_state()
            expect(
                state is Status.PREEMPTED,
                f"After stop {number} the goal is {state.name}, not PREEMPTED.",
                "publish an empty GoalID on drive/cancel; make the publisher before the callback needs it",
            )
        trial.expect_no_errors()
        return trial.view()


# ---- reverse: a server for both directions ----

GOALS = (
    (0.6, None, Status.SUCCEEDED, 0.6),
    (-1.0, None, Status.SUCCEEDED, 1.0),
    (-9.0, 2.0, Status.PREEMPTED, 0.4),
    (-9.0, None, Status.ABORTED, 0.9),
    (9.0, None, Status.ABORTED, 3.45),
)
"""Goals in an arena of 4 m: distance [m], time of the cancellation [s], status at the end, distance driven [m]."""


@exercise("reverse", praise="It looks where it drives, in both directions.")
def reverse(answer: Script) -> Any:
    """A server that drives ahead and backwards, can be stopped, and gives up before a wall."""
    with Trial("arena") as trial:
        trial.start(answer)
        trial.run(1.0)
        client, goal = _client(trial)
        for distance, cancel, status, driven in GOALS:
            case = f"With the goal {distance:g} m" + (f", cancelled after {cancel:g} s," if cancel else "")
            begin = _place(trial)
            heard: list[Any] = []
            client.send_goal(goal(distance=distance), feedback_cb=heard.append)
            trial.run(cancel or 25.0)
            if cancel:
                client.cancel_goal()
                trial.run(1.0)
            found, result = client.get_state(), client.get_result()
            expect(
                found is status,
                f"{case} the goal is {found.name}, not {status.name}.",
                "end each goal with set_succeeded, set_preempted or set_aborted",
            )
            moved = (_place(trial) - begin) * (1 if distance > 0 else -1)
            expect(
                abs(moved - driven) < 0.12,
                f"{case} the robot moved {moved:.2f} m in that direction, not {driven:g} m.",
                "choose sign and side once; stop when travelled reaches abs(goal.distance)",
            )
            expect(
                abs(result.travelled - moved) < 0.1,
                f"{case} the result is {result.travelled:.2f} m, but the robot moved {moved:.2f} m.",
                "travelled is never negative, and every end of a goal has a result",
            )
            expect(heard, f"{case} there was no feedback.", "call server.publish_feedback in the loop")
        trial.expect_no_errors()
        return trial.view()


# ---- return_to_sender: a client that comes home ----

TRIPS = (("1.0", "20", 1.0), ("5.0", "30", 1.7), ("3.0", "4.0", 0.8))
"""Parameters of the client in an arena of 4 m: distance [m], patience [s]; the farthest point [m]."""


@exercise("return_to_sender", praise="It came home after a success, a wall and a timeout, and noticed a dead server.")
def return_to_sender(answer: Script) -> Any:
    """A client that sends the robot away and back, however the first goal ends."""
    _ends_without_server(answer)
    view = None
    for distance, patience, far in TRIPS:
        with Trial("arena") as trial:
            _serve(trial)
            trial.start(answer, f"_distance:={distance}", f"_patience:={patience}")
            places = []
            for _ in range(60):
                trial.run(0.5)
                places.append(_place(trial))
            case = f"With {distance} m and a patience of {patience} s"
            expect(
                abs(max(places) - far) < 0.15,
                f"{case} the robot got {max(places):.2f} m far, not {far:g} m.",
                "send DriveGoal(distance), wait for at most the patience, and then cancel",
            )
            expect(
                abs(places[-1]) < 0.12,
                f"{case} the robot ended {places[-1]:.2f} m from where it started.",
                "the second goal is -result.travelled; after cancel_goal, wait for the result",
            )
            trial.expect_no_errors()
            view = trial.view()
    return view


def _ends_without_server(answer: Script) -> None:
    """Expect the client to log an error and to end when the server dies while it drives."""
    with Trial("arena") as trial:
        _serve(trial)
        client = trial.start(answer, "_distance:=3.0", "_patience:=4.0")
        trial.run(2.0)
        trial.graph.nodes["/drive_server"].shutdown("power cut")
        trial.run(12.0)
        expect(
            client.poll() == 0, "When the server dies, your client never ends.", "each wait_for_result needs a timeout"
        )
        expect(
            "[ERROR]" in trial.output,
            "When the server dies, your client logs no error.",
            "test the result for None, and call rospy.logerr",
        )
