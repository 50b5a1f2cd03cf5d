#!/usr/bin/env python
from __future__ import print_function

import sys

import rospy
import actionlib
from actionlib_msgs.msg import GoalStatus, GoalStatusArray
from actionlib_tutorials.msg import FibonacciAction, FibonacciGoal


def done(state, result):
    print('done', actionlib.TerminalState.to_string(state), result.sequence)


def active():
    print('active')


if __name__ == '__main__':
    rospy.init_node('fibonacci_client')
    client = actionlib.SimpleActionClient('fibonacci', FibonacciAction)
    print('server', client.wait_for_server(rospy.Duration(1000.0)))
    client.send_goal(FibonacciGoal(order=int(sys.argv[1])), done_cb=done, active_cb=active)
    if not client.wait_for_result(rospy.Duration.from_sec(float(sys.argv[2]))):
        print('too slow', client.get_state() == GoalStatus.ACTIVE)
        client.cancel_goal()
        client.wait_for_result()
    print(client.get_result().sequence, type(client.get_result().sequence).__name__)
    print(GoalStatus.to_string(client.get_state()))
    status = rospy.wait_for_message('/fibonacci/status', GoalStatusArray, timeout=1000)
    print('listed', [one.goal_id.id.split('-')[:2] for one in status.status_list])
    sys.exit(0 if client.get_state() == actionlib.GoalStatus.SUCCEEDED else 3)
