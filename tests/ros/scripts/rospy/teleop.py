#!/usr/bin/env python
# Keyboard teleoperation with a thread that repeats the last command.
from __future__ import print_function

import select
import sys
import termios
import threading
import tty

import rospy
from geometry_msgs.msg import Twist

MOVES = {"i": (1, 0), ",": (-1, 0), "j": (0, 1), "l": (0, -1), "k": (0, 0)}


class PublishThread(threading.Thread):
    def __init__(self, rate):
        super(PublishThread, self).__init__()
        self.publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.x = self.th = 0.0
        self.condition = threading.Condition()
        self.done = False
        self.timeout = 1.0 / rate if rate != 0.0 else None
        self.start()

    def wait_for_subscribers(self):
        waited = 0
        while not rospy.is_shutdown() and self.publisher.get_num_connections() == 0:
            if waited == 4:
                print("Waiting for subscriber to connect to {}".format(self.publisher.name))
            rospy.sleep(0.005)
            waited += 1
        if rospy.is_shutdown():
            raise Exception("Got shutdown request before subscribers connected")

    def update(self, x, th):
        self.condition.acquire()
        self.x, self.th = x, th
        self.condition.notify()
        self.condition.release()

    def stop(self):
        self.done = True
        self.update(0, 0)
        self.join()

    def run(self):
        twist = Twist()
        while not self.done:
            self.condition.acquire()
            self.condition.wait(self.timeout)
            twist.linear.x, twist.angular.z = self.x, self.th
            self.condition.release()
            self.publisher.publish(twist)
        twist.linear.x = twist.angular.z = 0
        self.publisher.publish(twist)


def get_key(settings, timeout):
    tty.setraw(sys.stdin.fileno())
    rlist, _, _ = select.select([sys.stdin], [], [], timeout)
    key = sys.stdin.read(1) if rlist else ""
    termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)
    return key


if __name__ == "__main__":
    settings = termios.tcgetattr(sys.stdin)
    rospy.init_node("teleop")
    thread = PublishThread(rospy.get_param("~repeat_rate", 0.0))
    try:
        thread.wait_for_subscribers()
        while True:
            key = get_key(settings, rospy.get_param("~key_timeout", 0.005))
            if key in MOVES:
                thread.update(*MOVES[key])
            elif key == "\x03":
                break
    except Exception as e:
        print(e)
    finally:
        thread.stop()
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)
