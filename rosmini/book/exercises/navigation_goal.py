"""Checks of the exercises in the chapter A goal by click: a pose, a way home, and goals that take too long."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from rosmini.msgs.std_msgs.msg import Empty

from .move_base import PlayedMoveBase

Point = tuple[float, float]

# ---- goal_of: be the tool ----

PULLS: tuple[tuple[Point, Point], ...] = (
    ((1.0, 2.0), (4.0, 2.0)),
    ((0.0, 0.0), (0.0, 0.5)),
    ((-1.0, 3.0), (-2.0, 3.0)),
    ((2.0, 2.0), (1.0, 1.0)),
    ((5.0, -1.0), (5.3, -1.4)),
)


@exercise("goal_of", praise="RViz's button computes exactly this.")
def goal_of(answer: Any) -> None:
    """The goal from the point where the mouse was pressed and the direction of the drag."""
    for press, release in PULLS:
        goal = answer(press, release)
        pulled = f"From {press} to {release}"
        expect(
            getattr(goal, "_type", None) == "geometry_msgs/PoseStamped",
            f"{pulled} it returned {type(goal).__name__}.",
            "return a PoseStamped",
        )
        frame, at = goal.header.frame_id, goal.pose.position
        expect(frame == "map", f"{pulled} the goal is in the frame {frame!r}, not 'map'.", "set goal.header.frame_id")
        expect(
            math.dist((at.x, at.y), press) < 1e-6,
            f"{pulled} the goal is at ({at.x:g}, {at.y:g}).",
            "the position of the goal is where the mouse was pressed",
        )
        _expect_heading(goal, math.atan2(release[1] - press[1], release[0] - press[0]), pulled)


def _expect_heading(goal: Any, yaw: float, what: str) -> None:
    """Expect a quaternion of length 1 that turns by `yaw` about z."""
    q = goal.pose.orientation
    length = math.sqrt(q.x**2 + q.y**2 + q.z**2 + q.w**2)
    expect(
        abs(length - 1) < 1e-3,
        f"{what} the quaternion has the length {length:.2f}, which move_base refuses.",
        "set z = sin(yaw / 2) and w = cos(yaw / 2)",
    )
    off = math.remainder(2 * math.atan2(q.z, q.w) - yaw, math.tau)
    expect(
        abs(off) < 1e-3 and abs(q.x) < 1e-6 and abs(q.y) < 1e-6,
        f"{what} the heading should be {math.degrees(yaw):.0f} degrees; yours is off by "
        f"{math.degrees(off):.0f} degrees.",
        "use math.atan2(dy, dx) of the drag; a quaternion contains half of the angle",
    )


# ---- home: take me back ----

BEGIN, LATER = (-1.0, 2.0, 0.6), (3.0, 0.5, -2.0)


def _pose(frame: str, pose: tuple[float, float, float]) -> Any:
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = pose[:2]
    message.pose.pose.orientation.z = math.sin(pose[2] / 2)
    message.pose.pose.orientation.w = math.cos(pose[2] / 2)
    return message


@exercise("home", praise="One message brings the robot home from anywhere.")
def home(answer: Script) -> None:
    """The first pose becomes the goal on each request, and only then; its frame may have any name."""
    for frame in ("map", "floor_2"):
        with TurtleTrial(None) as trial:
            desk = trial.graph.node("desk")
            heard: list[Any] = []
            desk.subscriber("move_base_simple/goal", PoseStamped, heard.append)
            poses = desk.publisher("amcl_pose", PoseWithCovarianceStamped, queue_size=5)
            # a script that waits for one pose unsubscribes; keep a subscriber, or the publisher warns
            desk.subscriber("amcl_pose", PoseWithCovarianceStamped, lambda _: None)
            ask = desk.publisher("home", Empty, queue_size=5)
            trial.start(answer)
            for pose in (BEGIN, LATER):
                trial.run(1.0)
                poses.publish(_pose(frame, pose))
            trial.run(1.0)
            expect(not heard, "It sent a goal before there was a message on home.", "publish in on_home")
            for asked in (1, 2):
                ask.publish(Empty())
                trial.run(1.0)
                expect(
                    len(heard) == asked,
                    f"There were {asked} messages on home, but {len(heard)} goals.",
                    "publish one message on move_base_simple/goal for each message on home",
                )
            goal = heard[-1]
            at, named = goal.pose.position, goal.header.frame_id
            expect(
                named == frame,
                f"amcl_pose was in the frame {frame!r}, but the goal is in {named!r}.",
                "copy begin.header.frame_id",
            )
            expect(
                math.dist((at.x, at.y), BEGIN[:2]) < 1e-6,
                f"The robot was first at {BEGIN[:2]}, but the goal is at ({at.x:g}, {at.y:g}).",
                "use the first pose, not the last",
            )
            _expect_heading(goal, BEGIN[2], "At home")


# ---- waiter: no time to lose ----

TABLES = [(1.0, 0.0), (2.0, 1.0), (0.0, 2.0)]
PATIENCE = 5.0


@exercise("waiter", praise="Two of three tables are served, and the kitchen knows which one is not.")
def waiter(answer: Script) -> None:
    """Three goals in order; the slow one, a different one each time, is cancelled after five seconds."""
    for slow in (TABLES[1], TABLES[0]):
        with TurtleTrial(None) as trial:
            played = PlayedMoveBase(trial.graph, lasting={slow})
            handle = trial.start(answer)
            trial.run(25.0)
            expect(bool(played.begun), "move_base received no goal.", "call client.send_goal(goal)")
            expect(
                not played.faults,
                f"A goal is wrong: {''.join(played.faults[:1])}.",
                "set header.frame_id, and orientation.w to 1",
            )
            expect(
                played.begun == TABLES,
                f"Within 25 s the goals were {played.begun}, with the path to {slow} blocked.",
                "wait_for_result(rospy.Duration(5)) returns False at the timeout",
            )
            hurried = [place for place in played.cut if place != slow]
            expect(
                not hurried,
                f"The goal {str(hurried)[1:-1]} was cancelled, although it needs only three seconds.",
                "wait for the result of each goal",
            )
            took = played.took[slow]
            expect(
                abs(took - PATIENCE) < 0.5,
                f"The goal {slow} was cancelled after {took:.1f} s, not after {PATIENCE:g}.",
                "use a timeout of rospy.Duration(5)",
            )
            expect(handle.poll() is not None, "The script still runs after the third goal.", "end without spin()")
