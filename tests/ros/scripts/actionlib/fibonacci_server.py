#!/usr/bin/env python
# The server of a student: a class, an execute callback, a rate.
import rospy
import actionlib
import actionlib_tutorials.msg


class FibonacciServer(object):
    _feedback = actionlib_tutorials.msg.FibonacciFeedback()
    _result = actionlib_tutorials.msg.FibonacciResult()

    def __init__(self, name):
        self._action_name = name
        self._as = actionlib.SimpleActionServer(
            self._action_name, actionlib_tutorials.msg.FibonacciAction, execute_cb=self.execute_cb, auto_start=False)
        self._as.start()

    def execute_cb(self, goal):
        r = rospy.Rate(20)
        success = True
        self._feedback.sequence = []
        self._feedback.sequence.append(0)
        self._feedback.sequence.append(1)
        print('%s: order %i from %i, %i' % (self._action_name, goal.order,
                                            self._feedback.sequence[0], self._feedback.sequence[1]))
        for i in range(1, goal.order):
            if self._as.is_preempt_requested():
                print('%s: preempted' % self._action_name)
                self._as.set_preempted()
                success = False
                break
            self._feedback.sequence.append(self._feedback.sequence[i] + self._feedback.sequence[i - 1])
            self._as.publish_feedback(self._feedback)
            r.sleep()
        if success:
            self._result.sequence = self._feedback.sequence
            print('%s: succeeded' % self._action_name)
            self._as.set_succeeded(self._result)


if __name__ == '__main__':
    rospy.init_node('fibonacci')
    server = FibonacciServer(rospy.get_name())
    rospy.spin()
