#!/usr/bin/env python
# A server and a client with goal handles in one node; the modules by their own names.
import rospy
from actionlib.action_client import ActionClient, CommState
from actionlib.action_server import ActionServer
from actionlib.simple_action_client import SimpleActionClient, SimpleGoalState
from actionlib.simple_action_server import SimpleActionServer
import actionlib.msg
from actionlib.msg import TwoIntsAction, TwoIntsGoal, TwoIntsResult

rospy.init_node('handles')


def on_goal(handle):
    goal = handle.get_goal()
    if goal.a < 0:
        handle.set_rejected(None, 'negative')
        return
    handle.set_accepted()
    handle.set_succeeded(TwoIntsResult(sum=goal.a + goal.b), 'added')
    handle.set_aborted()


server = ActionServer('~add', TwoIntsAction, on_goal, auto_start=True)
client = ActionClient('~add', actionlib.msg.TwoIntsAction)
print(client.wait_for_server())
seen = []
handles = [client.send_goal(TwoIntsGoal(a, 2), lambda gh: seen.append(CommState.to_string(gh.get_comm_state())))
           for a in (1, -1)]
while any(gh.get_comm_state() != CommState.DONE for gh in handles):
    rospy.sleep(0.01)
for gh in handles:
    print(gh.get_terminal_state(), gh.get_goal_status_text(), gh.get_result().sum)
print(seen[-1], SimpleGoalState.to_string(2))
