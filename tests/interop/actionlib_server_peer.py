"""A script for action servers alone: goals and cancellations in every order, and how long goals are listed.

Run by both.
"""

import json

import actionlib
import rospy
from actionlib.goal_id_generator import GoalIDGenerator
from actionlib.msg import TestAction, TestActionGoal, TestActionResult
from actionlib.server_goal_handle import ServerGoalHandle
from actionlib.status_tracker import StatusTracker
from actionlib_msgs.msg import GoalID, GoalStatus

rospy.init_node("peer")
facts = {}


def wait(condition, what):
    end = rospy.get_rostime() + rospy.Duration(200)
    while not condition():
        if rospy.get_rostime() > end:
            raise RuntimeError("waited in vain for " + what)
        rospy.sleep(0.002)


def wait_for_listener(server):
    """Wait until somebody receives the results of a server.

    A subscriber counts a connection before the publisher does, and what is published in between is lost.
    """
    results = server.result_pub
    wait(getattr(results, "get_num_connections", None) or results.num_connections, "a listener to its results")


class Bench:
    """A server, and what it is told and says."""

    def __init__(self, name):
        self.taken, self.cancelled, self.results = [], [], []
        self.heard = 0
        self.server = actionlib.ActionServer(
            name, TestAction, self.taken.append, lambda gh: self.cancelled.append(gh.get_goal_id().id), False
        )
        self.server.start()
        rospy.Subscriber(name + "/goal", TestActionGoal, self.count)
        rospy.Subscriber(name + "/cancel", GoalID, self.count)
        ear = rospy.Subscriber(name + "/result", TestActionResult, self.keep)
        self.goal = rospy.Publisher(name + "/goal", TestActionGoal, queue_size=10)
        self.cancel = rospy.Publisher(name + "/cancel", GoalID, queue_size=10)
        wait(lambda: self.goal.get_num_connections() and self.cancel.get_num_connections(), "the server")
        wait(ear.get_num_connections, "its results")
        wait_for_listener(self.server)

    def count(self, message):
        self.heard += 1

    def keep(self, message):
        self.results.append([message.status.goal_id.id, message.status.status, bool(message.status.text)])

    def tell(self, publisher, message):
        before = self.heard
        publisher.publish(message)
        wait(lambda: self.heard > before, "a message")

    def send(self, name, seconds):
        self.tell(self.goal, TestActionGoal(goal_id=GoalID(rospy.Time(seconds), name)))

    def withdraw(self, name, seconds):
        self.tell(self.cancel, GoalID(rospy.Time(seconds), name))

    def handle(self, name):
        return next(gh for gh in self.taken if gh.get_goal_id().id == name)

    def told(self):
        ended = [tracker for tracker in self.server.status_list if tracker.status.status in (2, 3, 4, 5, 8)]
        wait(lambda: len(self.results) >= len(ended), "the results")
        rospy.sleep(0.02)
        return {
            "taken": [plain(gh.get_goal_id()) for gh in self.taken],
            "cancelled": list(map(name_of, self.cancelled)),
            "results": [[name_of(one[0]), *one[1:]] for one in self.results],
            "list": [
                [plain(one.status.goal_id), one.status.status, bool(one.status.text), one.goal is None]
                for one in self.server.status_list
            ],
            "last": self.server.last_cancel.secs,
        }


GIVEN = {0, 50, 120, 150, 160, 200, 250, 300, 2000000000}


def name_of(name):
    return "made" if name.startswith("/peer-") else name


def plain(goal_id):
    stamp = goal_id.stamp.secs if goal_id.stamp.nsecs == 0 and goal_id.stamp.secs in GIVEN else "now"
    return [name_of(goal_id.id), stamp]


rospy.sleep(0.0101)  # so that no "now" looks like a given stamp
LATER = [("d", 120), ("e", 250), ("unknown", 160), ("", 120), ("f", 0), ("a", 50), ("g", 300)]
for number, (name, stamp) in enumerate(
    (name, stamp) for name in ("", "a", "b", "c", "unknown") for stamp in (0, 50, 150, 200, 2000000000)
):
    bench = Bench(f"cancel{number}")
    for one, seconds in (("a", 50), ("b", 200), ("c", 300), ("r", 150)):
        bench.send(one, seconds)
    bench.handle("b").set_accepted()
    bench.handle("c").set_accepted()
    bench.handle("c").set_succeeded()
    bench.handle("r").set_cancel_requested()
    bench.withdraw(name, stamp)
    fact = facts[f"cancel {name!r} {stamp}"] = [bench.told()]
    for one, seconds in LATER:
        bench.send(one, seconds)
    fact.append(bench.told())
    bench.withdraw("second", 0)
    bench.withdraw("unknown", 0)
    bench.withdraw("", 100)
    bench.send("second", 120)
    bench.send("r", 150)  # a goal that is being recalled, sent again
    bench.send("h", 0)
    bench.send("", 0)
    fact.append(bench.told())
    bench.server.stop()

# ---- how long a goal is listed ----

rospy.set_param("listed/status_list_timeout", 0.4)
rospy.set_param("simple/status_list_timeout", 0.4)
bench = Bench("listed")
for one in ("pending", "done", "over"):
    bench.send(one, 100)
held = bench.handle("done")
held.set_accepted()
held.set_succeeded()
bench.handle("over").set_rejected()
bench.withdraw("never", 0)
facts["listed"] = [bench.told()["list"]]
wait(lambda: len(bench.server.status_list) == 1, "the list to shrink")
facts["listed"].append(bench.told()["list"])
bench.send("done", 100)  # no longer known: taken anew
facts["listed"].append(bench.told()["list"])
bench.server.stop()

simple = actionlib.SimpleActionServer("simple", TestAction, lambda goal: simple.set_succeeded(), False)
facts["fresh"] = [
    simple.current_goal.get_goal(),
    simple.next_goal.get_goal(),
    simple.is_active(),
    simple.current_goal.get_goal_id().id,
    simple.current_goal == simple.next_goal,
    simple.action_server.ActionGoal is TestActionGoal,
    simple.action_server.ActionResultType()._type,
]
simple.start()
client = actionlib.SimpleActionClient("simple", TestAction)
client.wait_for_server()
wait_for_listener(simple.action_server)
facts["simple"] = [client.send_goal_and_wait(TestAction().action_goal.goal)]
facts["simple"].append([one.status.status for one in simple.action_server.status_list])
wait(lambda: not simple.action_server.status_list, "the simple server's list to be empty")
facts["simple"].append(simple.current_goal.get_goal_status().status)

# ---- the parts by themselves ----

first, second = GoalIDGenerator("who"), GoalIDGenerator()
ids = [first.generate_ID(), first.generate_ID(), second.generate_ID()]
facts["ids"] = [[one.id.split("-")[0], one.id.split("-")[2] == f"{one.stamp.secs}.{one.stamp.nsecs}"] for one in ids]
counts = [int(one.id.split("-")[1]) for one in ids]
facts["counts"] = [count - counts[0] for count in counts]
first.set_name("other")
facts["renamed"] = first.generate_ID().id.split("-")[0]
goal = TestActionGoal(goal_id=GoalID(rospy.Time(7), "x"))
tracker, note = (StatusTracker(None, None, goal), StatusTracker(GoalID(rospy.Time(), "y"), GoalStatus.RECALLING))
facts["trackers"] = [
    [one.goal is None, plain(one.status.goal_id), one.status.status, one.handle_destruction_time.to_nsec()]
    for one in (tracker, note, StatusTracker(goal=TestActionGoal()))
]
empty = ServerGoalHandle()
facts["empty"] = [empty.get_goal(), empty.get_goal_id().id, empty.get_goal_status().status, empty.goal, empty == empty]
empty.set_accepted()
facts["empty does"] = empty.set_cancel_requested()
own = ServerGoalHandle(tracker, bench.server, None)
facts["own"] = [
    own.get_goal_id().id,
    own.goal is goal,
    own == own,
    own.status_tracker is tracker,
    own.action_server is bench.server,
]
facts["names"] = [
    actionlib.GoalIDGenerator is GoalIDGenerator,
    actionlib.GoalID is GoalID,
    actionlib.action_server.StatusTracker is StatusTracker,
    actionlib.simple_action_client.GoalStatus is actionlib.GoalStatus,
    actionlib.get_name_of_constant(actionlib.TerminalState, 4),
    actionlib.get_name_of_constant(actionlib.CommState, 99),
]
print(json.dumps(facts, default=int))
rospy.signal_shutdown("done")
