"""A script for actionlib that tells what actionlib does, as JSON on its last line.

Run by real actionlib and by ours.
"""

import contextlib
import inspect
import itertools
import json
import sys

import actionlib
import rospy
from actionlib.msg import (
    TestAction,
    TestActionFeedback,
    TestActionGoal,
    TestActionResult,
    TestFeedback,
    TestGoal,
    TestResult,
)
from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray


def signature(thing):
    """Names of the parameters, with defaults that are plain values."""
    return [
        [name, one.default if isinstance(one.default, (int, float, str, type(None))) else None]
        for name, one in inspect.signature(thing).parameters.items()
    ]


PUBLIC = {
    actionlib.ActionClient: "__init__ stop send_goal cancel_all_goals cancel_goals_at_and_before_time "
    "wait_for_action_server_to_start wait_for_server",
    actionlib.ClientGoalHandle: "cancel get_comm_state get_goal_status get_goal_status_text get_result "
    "get_terminal_state",
    actionlib.SimpleActionClient: "__init__ wait_for_server send_goal send_goal_and_wait wait_for_result get_result "
    "get_state "
    "get_goal_status_text cancel_all_goals cancel_goals_at_and_before_time cancel_goal stop_tracking_goal",
    actionlib.ActionServer: "__init__ register_goal_callback register_cancel_callback start stop",
    actionlib.ServerGoalHandle: "get_default_result set_accepted set_canceled set_rejected set_aborted set_succeeded "
    "publish_feedback get_goal get_goal_id get_goal_status set_cancel_requested",
    actionlib.SimpleActionServer: "__init__ accept_new_goal is_new_goal_available is_preempt_requested is_active "
    "set_succeeded "
    "set_aborted publish_feedback get_default_result set_preempted register_goal_callback register_preempt_callback "
    "start",
}

rospy.init_node("peer")


def fail(*error):
    """Tell an error and end: the thread of a real simple server would never."""
    sys.__excepthook__(*error)
    rospy.signal_shutdown("failed")


sys.excepthook = fail
facts = {
    "signatures": {
        cls.__name__ + "." + name: signature(getattr(cls, name))
        for cls, names in PUBLIC.items()
        for name in names.split()
    },
    "numbers": {
        cls.__name__: {name: int(getattr(cls, name)) for name in names.split()}
        for cls, names in (
            (
                actionlib.CommState,
                "WAITING_FOR_GOAL_ACK PENDING ACTIVE WAITING_FOR_RESULT RECALLING PREEMPTING DONE LOST",
            ),
            (actionlib.TerminalState, "RECALLED REJECTED PREEMPTED ABORTED SUCCEEDED LOST"),
            (actionlib.SimpleGoalState, "PENDING ACTIVE DONE"),
        )
    },
    "names": [
        actionlib.CommState.to_string(4),
        actionlib.TerminalState.to_string(9),
        actionlib.SimpleGoalState.to_string(7),
    ],
}
# GoalStatus.to_string(0) is "_has_header" in real actionlib: it looks through the class for a name of the number.
STATUSES = [
    "PENDING", "ACTIVE", "PREEMPTED", "SUCCEEDED", "ABORTED", "REJECTED", "PREEMPTING", "RECALLING", "RECALLED",
    "LOST",
]  # fmt: skip


def wait(condition, what):
    end = rospy.get_rostime() + rospy.Duration(200)
    while not condition():
        if rospy.get_rostime() > end:
            raise RuntimeError("waited in vain for " + what)
        rospy.sleep(0.002)


# ---- the client's machine: this script plays the server, and tells it everything in every state ----

heard = {"status": 0, "result": 0}


def count(kind):
    def callback(message):
        heard[kind] += 1

    return callback


client = actionlib.ActionClient("played", TestAction)
goals = []
sent_here = rospy.Subscriber("played/goal", TestActionGoal, goals.append)
rospy.Subscriber("played/status", GoalStatusArray, count("status"))  # told after the client, in the same thread
rospy.Subscriber("played/result", TestActionResult, count("result"))
status_pub = rospy.Publisher("played/status", GoalStatusArray, queue_size=100)
result_pub = rospy.Publisher("played/result", TestActionResult, queue_size=100)
# A subscriber counts a connection before the publisher does, and what is published in between is lost.
goal_pub = getattr(client, "pub_goal", sent_here)
for one in (sent_here, goal_pub, status_pub, result_pub):
    wait(getattr(one, "get_num_connections", None) or one.num_connections, "connections")


def publish(kind, publisher, message):
    before = heard[kind]
    publisher.publish(message)
    wait(lambda: heard[kind] > before, kind)


def tell(handle_id, status):
    one = [] if status is None else [GoalStatus(GoalID(id=handle_id), status, "")]
    publish("status", status_pub, GoalStatusArray(status_list=one))


def finish(handle_id, status):
    message = TestActionResult(status=GoalStatus(GoalID(id=handle_id), status, "end"), result=TestResult(7))
    publish("result", result_pub, message)


WAYS = {
    "WAITING_FOR_GOAL_ACK": [],
    "PENDING": [0],
    "ACTIVE": [1],
    "RECALLING": [7],
    "PREEMPTING": [6],
    "WAITING_FOR_RESULT": [3],
    "WAITING_FOR_CANCEL_ACK": ["cancel"],
    "DONE": ["finish"],
}


def goal_in(state):
    """A goal in a state of the client's machine, its id, and the states that it comes through from there."""
    seen, before = [], len(goals)
    handle = client.send_goal(TestGoal(1), lambda gh: seen.append(actionlib.CommState.to_string(gh.get_comm_state())))
    wait(lambda: len(goals) > before, "the goal")
    name = goals[-1].goal_id.id
    for step in WAYS[state]:
        if step == "cancel":
            handle.cancel()
        elif step == "finish":
            finish(name, 3)
        else:
            tell(name, step)
    assert actionlib.CommState.to_string(handle.get_comm_state()) == state, (state, seen)
    del seen[:]
    return handle, name, seen


facts["client"] = {}
facts["client after a result"] = {}
facts["client not listed"] = {}
for state in WAYS:
    for number, status in enumerate(STATUSES[:9]):
        handle, name, seen = goal_in(state)
        tell(name, number)
        facts["client"][state + " hears " + status] = seen + [actionlib.CommState.to_string(handle.get_comm_state())]
        if number in (2, 3, 4, 5, 8) and state != "DONE":
            handle, name, seen = goal_in(state)
            finish(name, number)
            facts["client after a result"][state + " gets " + status] = seen + [
                handle.get_terminal_state(),
                handle.get_goal_status_text(),
                handle.get_result().result,
            ]
    handle, name, seen = goal_in(state)
    tell(name, None)
    facts["client not listed"][state] = seen + [handle.get_goal_status()]
facts["client cancels"] = {}
for state in ("WAITING_FOR_GOAL_ACK", "PENDING", "ACTIVE"):
    handle, name, seen = goal_in(state)
    handle.cancel()
    facts["client cancels"][state] = list(seen)

# ---- the server's machine: every step in every status ----

taken = []
server = actionlib.ActionServer("served", TestAction, taken.append, auto_start=False)
server.start()
sender = rospy.Publisher("served/goal", TestActionGoal, queue_size=10)
wait(sender.get_num_connections, "the server")
PATHS = {
    "PENDING": [],
    "ACTIVE": ["set_accepted"],
    "RECALLING": ["set_cancel_requested"],
    "PREEMPTING": ["set_accepted", "set_cancel_requested"],
    "REJECTED": ["set_rejected"],
    "RECALLED": ["set_canceled"],
    "SUCCEEDED": ["set_accepted", "set_succeeded"],
    "ABORTED": ["set_accepted", "set_aborted"],
    "PREEMPTED": ["set_accepted", "set_canceled"],
}
STEPS = [
    "set_accepted", "set_rejected", "set_succeeded", "set_aborted", "set_canceled", "set_cancel_requested",
]  # fmt: skip
facts["server"] = {}
for status, path in sorted(PATHS.items()):
    for step in STEPS:
        before = len(taken)
        sender.publish(TestActionGoal(goal_id=GoalID(rospy.Time.now(), status + step)))
        wait(lambda before=before: len(taken) > before, "a goal")
        handle = taken[-1]
        for one in path:
            getattr(handle, one)()
        assert STATUSES[handle.get_goal_status().status] == status
        answer = getattr(handle, step)()
        facts["server"][status + " " + step] = [STATUSES[handle.get_goal_status().status], answer]

# ---- the simple ones together ----

told = []
plan = {}
sent = set()
active = set()
fed = []


def execute(goal):
    # Real actionlib loses a result that arrives before send_goal() has returned, and feedback that arrives after its
    # result.
    if goal.goal in (8, 9):
        rospy.sleep(0.1)
    else:
        wait(lambda: goal.goal in sent, "send_goal() to return")
    told.append(["begin", goal.goal])
    for number in range(3):
        simple.publish_feedback(TestFeedback(10 * goal.goal + number))
    if goal.goal < 6:
        wait(lambda: goal.goal in active and 10 * goal.goal + 2 in fed, "the status and the feedback")
    while plan.get(goal.goal) == "wait" and not simple.is_preempt_requested():
        rospy.sleep(0.01)
    if simple.is_preempt_requested():
        simple.set_preempted(TestResult(-goal.goal), "stopped")
    elif plan.get(goal.goal) == "abort":
        simple.set_aborted(TestResult(0), "no way")
    elif plan.get(goal.goal) == "raise":
        raise ValueError("oh")
    elif plan.get(goal.goal) != "silent":
        simple.set_succeeded(TestResult(goal.goal), "there")
    told.append(["end", goal.goal])


rospy.set_param("simple/status_list_timeout", 100)
simple = actionlib.SimpleActionServer("simple", TestAction, execute, auto_start=False)
one = actionlib.SimpleActionClient("simple", TestAction)
two = actionlib.SimpleActionClient("simple", TestAction)
facts["no server"] = one.wait_for_server(rospy.Duration(0.1))
facts["no goal"] = [one.get_state(), one.get_result(), one.wait_for_result(), one.get_goal_status_text()[:5]]
simple.start()
facts["a server"] = [one.wait_for_server(), two.wait_for_server(rospy.Duration(200))]
# Real clients know of a connection before the server's end counts it: what it publishes in between is lost.
for end in ("status", "feedback", "result"):
    connections = getattr(getattr(simple.action_server, end + "_pub"), "get_num_connections", None)
    wait(lambda count=connections: count is None or count() > 0, "the server's connection on " + end)


def run(client, number, what="", cancel=False):
    """Send a goal; what its client's callbacks are told, and what it says at the end."""
    plan[number] = what
    said = []
    # Real actionlib does not know a goal before send_goal() has returned: the real server, which needs its lock,
    # accepts it no sooner.
    with getattr(simple, "lock", contextlib.nullcontext()):
        client.send_goal(
            TestGoal(number),
            lambda state, result: said.append(["done", state, result.result]),
            lambda: (said.append("active"), active.add(number)),
            lambda feedback: fed.append(feedback.feedback),
        )
    sent.add(number)
    if cancel:
        wait(lambda: "active" in said, "active")
        facts["too slow"] = [client.wait_for_result(rospy.Duration(0.05)), client.get_state()]
        client.cancel_goal()
    finished = client.wait_for_result(rospy.Duration(200))
    return said + [finished, client.get_state(), client.get_result().result]


facts["simple"] = {
    "succeeds": run(one, 1),
    "aborts": run(one, 2, "abort"),
    "raises": run(one, 3, "raise")[-3:],
    "says nothing": run(one, 4, "silent"),
    "is cancelled": run(one, 5, "wait", cancel=True),
}
plan[6], plan[7] = "wait", ""
ended = []
one.send_goal(TestGoal(6), lambda state, result: ended.append([6, state, result.result]))
sent.add(6)
wait(lambda: ["begin", 6] in told, "the first goal")
rospy.sleep(0.01)
two.send_goal(TestGoal(7), lambda state, result: ended.append([7, state, result.result]))
sent.add(7)
wait(lambda: len(ended) == 2, "both goals")
facts["a new goal preempts"] = sorted(ended)
plan[8] = "wait"
facts["send_goal_and_wait"] = [
    one.send_goal_and_wait(TestGoal(9)),
    one.send_goal_and_wait(TestGoal(8), rospy.Duration(0.1), rospy.Duration(5)),
]
wait(lambda: ["end", 8] in told, "the end")
rospy.sleep(0.1)
facts["told"] = told
facts["feedback"] = sorted(fed)
facts["in order"] = all(a < b for a, b in itertools.pairwise(fed) if a // 10 == b // 10)
statuses = rospy.wait_for_message("simple/status", GoalStatusArray, 200)
facts["listed"] = sorted(STATUSES[status.status] for status in statuses.status_list)
facts["id"] = [
    part if index < 2 else len(part.split(".")[1]) for index, part in enumerate(goals[0].goal_id.id.split("-"))
]
facts["feedback type"] = TestActionFeedback._md5sum
print(json.dumps(facts, default=int))
rospy.signal_shutdown("done")  # else the thread of the real simple server never ends
