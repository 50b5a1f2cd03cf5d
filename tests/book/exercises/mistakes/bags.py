"""Wrong answers to the exercises of the chapter Bags: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

SILENCE = solution("bags", "longest_silence")

WAY_BACK = solution("bags", "way_back")

MISTAKES = {
    "longest_silence": [
        wrong("silence.py", SILENCE, "max(later", "min(later"),
        wrong("silence.py", SILENCE, "max(later", "sum(later"),
        wrong("silence.py", SILENCE, "sys.argv[2]", '"/chatter"'),
        wrong("silence.py", SILENCE, "(sys.argv[2])", "()"),
        wrong("silence.py", SILENCE, "print(", "(lambda x: x)("),
        wrong("silence.py", SILENCE, "sys.argv[1]", '"nosuch.bag"'),
    ],
    "fast_commands": [
        lambda: "topic == '/cmd_vel'",
        lambda: "m.linear.x > 0.1",
        lambda: "topic == '/cmd_vel' and m.linear.x >= 0.1",
        lambda: "topic == '/cmd_vel' and m.angular.z > 0.1",
        lambda: "topic == '/cmd_vel' and abs(m.linear.x) > 0.1",
        lambda: "topic == '/odom' and m.linear.x > 0.1",
        lambda: 1,
    ],
    "way_back": [
        wrong("way_back.py", WAY_BACK, "reversed(list(zip(drive, drive[1:])))", "zip(drive, drive[1:])"),
        wrong("way_back.py", WAY_BACK, "    command.linear.x *= -1\n"),
        wrong("way_back.py", WAY_BACK, "    command.angular.z *= -1\n"),
        wrong("way_back.py", WAY_BACK, "end - begin", "0.1"),
        wrong("way_back.py", WAY_BACK, "    cmd_vel.publish(command)\n"),
        wrong("way_back.py", WAY_BACK, "sys.argv[1]", '"nosuch.bag"'),
    ],
}
