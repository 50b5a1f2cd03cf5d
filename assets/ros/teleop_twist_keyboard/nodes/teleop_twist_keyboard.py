#!/usr/bin/env python3
"""Drive any robot with keys: u i o, j k l, m , . for the direction, with Shift sideways; q z w x e c for the speed; Ctrl-C ends.

A key sets the direction, which is held until another key comes; every key that has no meaning stops. Each key is one message; with
~repeat_rate it is sent again, with ~key_timeout a robot without a key stops. Keys, speeds and parameters are those of
teleop_twist_keyboard 1.0.0 (https://github.com/ros-teleop/teleop_twist_keyboard, branch master).
"""

import select
import sys
import termios
import tty

import rospy
from geometry_msgs.msg import Twist, TwistStamped

# ahead, to the left, up, and a turn to the left
MOVES = {
    "u": (1, 0, 0, 1), "i": (1, 0, 0, 0), "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1), "l": (0, 0, 0, -1),
    "m": (-1, 0, 0, -1), ",": (-1, 0, 0, 0), ".": (-1, 0, 0, 1),
    "U": (1, 1, 0, 0), "I": (1, 0, 0, 0), "O": (1, -1, 0, 0),
    "J": (0, 1, 0, 0), "L": (0, -1, 0, 0),
    "M": (-1, 1, 0, 0), "<": (-1, 0, 0, 0), ">": (-1, -1, 0, 0),
    "t": (0, 0, 1, 0), "b": (0, 0, -1, 0),
}  # fmt: skip
# factors of the linear and of the angular speed
FACTORS = {"q": (1.1, 1.1), "z": (0.9, 0.9), "w": (1.1, 1), "x": (0.9, 1), "e": (1, 1.1), "c": (1, 0.9)}
SPEED, TURN = 0.5, 1.0
LIMIT = 1000.0
HELP = """Keys:      u    i    o     ahead, with a turn or without
           j    k    l     turn on the spot; k stops
           m    ,    .     back; with Shift: sideways, without a turn
           t / b           up / down
q/z: 10 % faster / slower; w/x: straight on only; e/c: turning only
Any other key: stop; Ctrl-C: the end"""


def key(settings, seconds):
    """The next key, '' if none comes within so many seconds (None: wait for it), or 'end' where nothing more can come."""
    if settings is not None:
        tty.setraw(sys.stdin.fileno())
    try:
        ready, _, _ = select.select([sys.stdin], [], [], seconds)
        return (sys.stdin.read(1) or "end") if ready else ""
    finally:
        if settings is not None:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)


class Driver:
    """What is wanted, and the messages that say so."""

    def __init__(self):
        self.limits = rospy.get_param("~speed_limit", LIMIT), rospy.get_param("~turn_limit", LIMIT)
        self.speed = min(self.limits[0], rospy.get_param("~speed", SPEED))
        self.turn = min(self.limits[1], rospy.get_param("~turn", TURN))
        self.frame = rospy.get_param("~frame_id", "")
        self.type = TwistStamped if rospy.get_param("~stamped", False) else Twist
        self.publisher = rospy.Publisher("cmd_vel", self.type, queue_size=1)
        self.direction = (0, 0, 0, 0)

    def speeds(self):
        return "currently:\tspeed %s\tturn %s " % (self.speed, self.turn)

    def press(self, pressed):
        """Take a key that is not the end; '' is none, after the time-out."""
        if pressed in FACTORS:
            faster, sharper = FACTORS[pressed]
            self.speed = min(self.limits[0], self.speed * faster)
            self.turn = min(self.limits[1], self.turn * sharper)
            print(self.speeds())
        else:
            self.direction = MOVES.get(pressed, (0, 0, 0, 0))

    def send(self):
        message = self.type()
        twist = message
        if self.type is TwistStamped:
            message.header.stamp, message.header.frame_id = rospy.Time.now(), self.frame
            twist = message.twist
        ahead, left, up, turn = self.direction
        twist.linear.x, twist.linear.y, twist.linear.z = (ahead * self.speed, left * self.speed, up * self.speed)
        twist.angular.z = turn * self.turn
        self.publisher.publish(message)


def main():
    rospy.init_node("teleop_twist_keyboard")
    driver = Driver()
    rate, timeout = rospy.get_param("~repeat_rate", 0.0), rospy.get_param("~key_timeout", 0.0)
    settings = termios.tcgetattr(sys.stdin) if sys.stdin.isatty() else None
    print(HELP)
    print(driver.speeds())
    silent = 0.0
    try:
        while not rospy.is_shutdown():
            seconds = min((t for t in (1 / rate if rate else 0, timeout) if t), default=None)
            pressed = key(settings, seconds)
            if pressed in ("\x03", "end"):
                break
            silent = 0.0 if pressed else silent + seconds
            if pressed or (timeout and silent >= timeout and any(driver.direction)):
                driver.press(pressed)
            elif not rate:
                continue
            driver.send()
    finally:
        driver.direction = (0, 0, 0, 0)
        driver.send()


if __name__ == "__main__":
    main()
