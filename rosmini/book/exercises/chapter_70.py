"""What is right in the exercises of chapter 70, a goal by click: a pose, a way home, and goals that take too long."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from rosmini.msgs.std_msgs.msg import Empty

from .chapter_39 import PlayedMoveBase

Point = tuple[float, float]

# ---- 70.1: be the tool ----

PULLS: tuple[tuple[Point, Point], ...] = (
    ((1.0, 2.0), (4.0, 2.0)),
    ((0.0, 0.0), (0.0, 0.5)),
    ((-1.0, 3.0), (-2.0, 3.0)),
    ((2.0, 2.0), (1.0, 1.0)),
    ((5.0, -1.0), (5.3, -1.4)),
)


@exercise("70.1", praise="That is all that the button does.")
def goal_of(answer: Any) -> None:
    """The place where the mouse went down, and the heading in which it was pulled."""
    for press, release in PULLS:
        goal = answer(press, release)
        pulled = f"From {press} to {release}"
        expect(
            getattr(goal, "_type", None) == "geometry_msgs/PoseStamped",
            f"{pulled} it returned {type(goal).__name__}.",
            "return a PoseStamped",
        )
        frame, at = goal.header.frame_id, goal.pose.position
        expect(frame == "map", f"{pulled} the goal is in the frame {frame!r}.", "goal.header.frame_id")
        expect(
            math.dist((at.x, at.y), press) < 1e-6,
            f"{pulled} the goal is at ({at.x:g}, {at.y:g}).",
            "the mouse goes down where the robot shall be",
        )
        _expect_heading(goal, math.atan2(release[1] - press[1], release[0] - press[0]), pulled)


def _expect_heading(goal: Any, yaw: float, what: str) -> None:
    """The quaternion has the length 1, and turns by `yaw` about z."""
    q = goal.pose.orientation
    length = math.sqrt(q.x**2 + q.y**2 + q.z**2 + q.w**2)
    expect(
        abs(length - 1) < 1e-3,
        f"{what} the quaternion has the length {length:.2f}, which move_base refuses.",
        "z = sin(yaw / 2), w = cos(yaw / 2)",
    )
    off = math.remainder(2 * math.atan2(q.z, q.w) - yaw, math.tau)
    expect(
        abs(off) < 1e-3 and abs(q.x) < 1e-6 and abs(q.y) < 1e-6,
        f"{what} the heading is {math.degrees(yaw):.0f} degrees, and yours is {math.degrees(off):.0f} degrees off.",
        "math.atan2(dy, dx) of the pull; a quaternion holds half of the angle",
    )


# ---- 70.2: take me back ----

BEGIN, LATER = (-1.0, 2.0, 0.6), (3.0, 0.5, -2.0)


def _pose(frame: str, pose: tuple[float, float, float]) -> Any:
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = pose[:2]
    message.pose.pose.orientation.z = math.sin(pose[2] / 2)
    message.pose.pose.orientation.w = math.cos(pose[2] / 2)
    return message


@exercise("70.2", praise="Wherever it has been sent, one message brings it home.")
def home(answer: Script) -> None:
    """The first pose is the goal, as often as somebody asks, and only then; its frame may have any name."""
    for frame in ("map", "floor_2"):
        with TurtleTrial(None) as trial:
            desk = trial.graph.node("desk")
            heard: list[Any] = []
            desk.subscriber("move_base_simple/goal", PoseStamped, heard.append)
            poses = desk.publisher("amcl_pose", PoseWithCovarianceStamped, queue_size=5)
            # who waits for one pose is not there for the next: without a listener, a publisher warns
            desk.subscriber("amcl_pose", PoseWithCovarianceStamped, lambda _: None)
            ask = desk.publisher("home", Empty, queue_size=5)
            trial.start(answer)
            for pose in (BEGIN, LATER):
                trial.run(1.0)
                poses.publish(_pose(frame, pose))
            trial.run(1.0)
            expect(not heard, "It sent a goal before anybody had asked for it.", "publish in on_home")
            for asked in (1, 2):
                ask.publish(Empty())
                trial.run(1.0)
                expect(
                    len(heard) == asked,
                    f"Somebody asked {asked} times, and there were {len(heard)} goals.",
                    "one message on move_base_simple/goal for each on home",
                )
            goal = heard[-1]
            at, named = goal.pose.position, goal.header.frame_id
            expect(
                named == frame,
                f"amcl_pose was in the frame {frame!r}, and the goal is in {named!r}.",
                "begin.header.frame_id",
            )
            expect(
                math.dist((at.x, at.y), BEGIN[:2]) < 1e-6,
                f"It was at {BEGIN[:2]} first, and the goal is at ({at.x:g}, {at.y:g}).",
                "the first pose, not the last",
            )
            _expect_heading(goal, BEGIN[2], "At home")


# ---- 70.3: no time to lose ----

TABLES = [(1.0, 0.0), (2.0, 1.0), (0.0, 2.0)]
PATIENCE = 5.0


@exercise("70.3", praise="Two of three are served, and the kitchen knows why.")
def waiter(answer: Script) -> None:
    """Three goals in order, and the one that lasts is cancelled after five seconds; it is another one each time."""
    for slow in (TABLES[1], TABLES[0]):
        with TurtleTrial(None) as trial:
            played = PlayedMoveBase(trial.graph, lasting={slow})
            handle = trial.start(answer)
            trial.run(25.0)
            expect(bool(played.begun), "No goal came to move_base.", "client.send_goal(goal)")
            expect(
                not played.faults,
                f"A goal is wrong: {''.join(played.faults[:1])}.",
                "header.frame_id, orientation.w = 1",
            )
            expect(
                played.begun == TABLES,
                f"Within 25 s the goals were {played.begun}, with somebody in the way at {slow}.",
                "wait_for_result(rospy.Duration(5)) returns False when the time is over",
            )
            hurried = [place for place in played.cut if place != slow]
            expect(
                not hurried,
                f"The goal {str(hurried)[1:-1]} was called off, and took three seconds only.",
                "wait for each",
            )
            took = played.took[slow]
            expect(
                abs(took - PATIENCE) < 0.5,
                f"The goal {slow} was called off after {took:.1f} s, not after {PATIENCE:g}.",
                "rospy.Duration(5)",
            )
            expect(
                handle.poll() is not None, "After the third goal the script goes on.", "no spin() at the end"
            )
