"""Checks of the exercises in the chapter Threads and spin: each runs a script that has slow and fast work to do."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.std_msgs.msg import Float64, Header

WALL_X = 2.0
"""x coordinate of the arena's east wall [m]; a robot at the origin faces it."""

# ---- brake_first: slow work beside the brake ----


@exercise("brake_first", praise="The slow work no longer delays the brake.")
def brake_first(answer: Script) -> Any:
    """The robot stops before the wall, and looks at new scans at the same time."""
    for start in (0.8, -1.5):
        with Trial("arena", f"_x:={start}") as trial:
            ages: list[float] = []
            graph = trial.graph

            def note(header: Any, graph: Any = graph, ages: list[float] = ages) -> None:
                ages.append((graph.now() - header.stamp).to_sec())

            graph.node("check").subscriber("looked", Header, note)
            trial.start(answer)
            trial.run(20.0)
            x, _, _ = trial.robot.truth()
            trial.run(1.0)
            gap, moved = WALL_X - x, abs(trial.robot.truth()[0] - x)
            expect(x > start + 0.2, "The robot did not drive.", "publish a command for each scan, or in a timer")
            expect(gap > 0.12, "The robot hit the wall.", "send the command in a callback that does not call look()")
            expect(moved < 0.01, "The robot did not stop.", "send a zero command, too")
            expect(
                0.3 <= gap <= 0.55,
                f"The robot stopped {gap:.2f} m from the wall, not between 0.3 and 0.55 m.",
                "stop if something ahead is nearer than 0.5 m",
            )
            expect(
                len(ages) >= 21,
                f"In 21 s it looked at {len(ages)} scans.",
                "call look(scan) in a loop of the main program",
            )
            expect(min(ages) >= 0.5, "You have made look() faster.", "leave look() as it is")
            expect(
                max(ages) < 0.9,
                f"It looked at a scan that was {max(ages):.1f} s old in the end.",
                "always take the newest scan: let the callback replace it",
            )
            trial.expect_no_errors()
            view = trial.view()
    return view


# ---- weight_on_board: a lock ----

PARCELS = (("front_door", 2.0), ("back_door", 0.5), ("front_door", 1.0), ("front_door", 4.0), ("back_door", 1.5))
"""Doors and the weights of the parcels [kg]."""


@exercise("weight_on_board", praise="No parcel is lost, however they meet at the doors.", gaps=2)
def weight_on_board(answer: Script) -> None:
    """A node that adds weights from two topics, in two threads."""
    with Trial("empty", is_shown=False) as trial:
        check = trial.graph.node("check")
        loads: list[float] = []
        doors = {name: check.publisher(name, Float64, queue_size=10) for name in ("front_door", "back_door")}
        check.subscriber("load", Float64, lambda message: loads.append(message.data))
        trial.start(answer)
        trial.run(0.5)
        for name, door in doors.items():
            expect(door.num_connections(), f"No node subscribes to /{name}.", "keep the lines rospy.Subscriber")
        for pause in (1.0, 0.0):
            loads.clear()
            for name, weight in PARCELS:
                doors[name].publish(Float64(weight))
                trial.run(pause or 0.02)
            trial.run(3.0)
            when = "one after the other" if pause else "at the same time"
            total = sum(weight if name == "front_door" else -weight for name, weight in PARCELS)
            total *= 1 if pause else 2
            said = f"{len(PARCELS)} parcels came {when}; load was published {len(loads)} times."
            expect(len(loads) == len(PARCELS), said, "publish load after each parcel")
            expect(
                abs(loads[-1] - total) < 1e-6,
                f"When parcels came {when}, the last load was {loads[-1]:g} kg, not {total:g} kg.",
                "both callbacks need the same lock, while they read, compute and write"
                if not pause
                else "front_door adds, back_door subtracts",
            )
        trial.expect_no_errors()


# ---- steady: repeat the newest wish ----


@exercise("steady", praise="The robot drives smoothly, and stops if the remote control is silent.")
def steady(answer: Script) -> Any:
    """A node that repeats the newest wish at 10 Hz, for two seconds."""
    with Trial("arena", "_x:=-1.5") as trial:
        check, sent = trial.graph.node("check"), []
        check.subscriber("cmd_vel", Twist, lambda m: sent.append((m.linear.x, m.angular.z)))
        wish = check.publisher("wish", Twist, queue_size=1)
        trial.start(answer)
        trial.run(1.0)
        expect(wish.num_connections(), "No node subscribes to /wish.", "use rospy.Subscriber with type Twist")
        expect(not any(map(any, sent)), "It drove before the first wish.", "begin with a zero command")
        for speed, turn, seconds, wanted in ((0.2, 0.0, 1.0, 1.0), (0.1, 0.5, 4.0, 2.0), (0.15, -0.3, 3.0, 2.0)):
            sent.clear()
            command = Twist()
            command.linear.x, command.angular.z = speed, turn
            wish.publish(command)
            trial.run(seconds)
            case = f"In the {seconds:g} s after a wish"
            expect(
                abs(len(sent) - 10 * seconds) <= 2,
                f"{case} it sent {len(sent)} commands, not ten a second.",
                "rate = rospy.Rate(10), and rate.sleep() in the loop",
            )
            same = sum(each == (speed, turn) for each in sent)
            zero = sum(each == (0.0, 0.0) for each in sent)
            expect(
                abs(same - 10 * wanted) <= 2 and same + zero >= len(sent) - 2,
                f"{case} {same} commands were the wish and {zero} were zero.",
                "repeat the newest wish while it is at most 2 s old; then publish Twist()",
            )
        trial.expect_no_errors()
        return trial.view()
