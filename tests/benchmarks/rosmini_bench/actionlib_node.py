"""The action peer of ``rosmini bench``, with real rospy in the system's Python: ``actionlib_node.py ROLE goals COUNT``.

The talker is the action server. The listener is the client: it measures, and prints the figure as its last line.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from typing import Any

import actionlib  # type: ignore[import-not-found,import-untyped,unused-ignore]  # the system Python has it
import rospy  # type: ignore[import-not-found]
from actionlib.msg import TestAction, TestActionFeedback, TestFeedback, TestGoal, TestResult  # type: ignore[import-not-found,import-untyped,unused-ignore]


def serve(count: int) -> None:
    """Work on so many goals."""
    left = threading.Semaphore(0)

    def work(handle: Any) -> None:
        number = handle.get_goal().goal
        handle.set_accepted()
        handle.publish_feedback(TestFeedback(number))
        handle.set_succeeded(TestResult(2 * number))
        if number >= 0:
            left.release()

    actionlib.ActionServer("bench", TestAction, work, auto_start=False).start()
    for _ in range(count):
        left.acquire()
    time.sleep(1.0)


def ask(count: int) -> float:
    """Send so many goals, each after the end of the one before; return how many a second."""
    client = actionlib.ActionClient("bench", TestAction)
    told: list[int] = []
    # Heard on the topic: the client drops feedback that comes after its result, which with real threads it often does.
    rospy.Subscriber("bench/feedback", TestActionFeedback, lambda message: told.append(message.feedback.feedback))
    client.wait_for_server()
    while not told:  # a real server answers a subscriber before it sends to it: what it says in between is lost
        handle = client.send_goal(TestGoal(-1), lambda _: None, lambda *_: None)
        deadline = time.time() + 1
        while not told and time.time() < deadline:
            time.sleep(0.001)
    told.clear()
    begin = time.time()
    for number in range(count):
        done = threading.Event()

        def moved(handle: Any, done: threading.Event = done) -> None:
            if handle.get_comm_state() == actionlib.CommState.DONE:
                done.set()

        handle = client.send_goal(TestGoal(number), moved, lambda *_: None)
        if not done.wait(30) or handle.get_result().result != 2 * number:
            sys.exit("a goal came to nothing")
    seconds = time.time() - begin
    deadline = time.time() + 10
    while len(told) < count and time.time() < deadline:
        time.sleep(0.01)
    if told != list(range(count)):
        sys.exit("feedback was lost")
    return count / seconds


def main() -> None:
    """Play the role given on the command line."""
    role, _, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    rospy.init_node("bench_" + role, anonymous=True, disable_signals=True)
    if role == "talker":
        serve(count)
    else:
        print(json.dumps(ask(count)))
    rospy.signal_shutdown("measured")


if __name__ == "__main__":
    main()
