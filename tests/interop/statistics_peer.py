"""What rospy's statistics say of messages that arrive at given times. Run by the real rospy only; no Master is needed.

Standard input: JSON, a list of [arrival, stamp, sequence number], in nanoseconds. Output: the published statistics.
"""

import json
import sys
from types import SimpleNamespace

import rospy
from rospy.impl import statistics

found = []
now = [0]
parameters = {}
nanoseconds = rospy.Duration.to_nsec


class Publisher:
    """Takes what rospy publishes."""

    def __init__(self, *_, **__):
        pass

    def publish(self, message):
        """Keep the fields of a message."""
        names = [name for name in message.__slots__ if name.startswith(("period", "stamp_age"))]
        row = {name: nanoseconds(getattr(message, name)) for name in names}
        row.update(delivered_msgs=message.delivered_msgs, dropped_msgs=message.dropped_msgs)
        row.update(window_start=message.window_start.to_nsec(), window_stop=message.window_stop.to_nsec())
        found.append(row)


class Clock(rospy.Time):
    """Time as the test has it."""

    @classmethod
    def now(cls):
        """Return the arrival of the current message."""
        return rospy.Time(0, now[0])


statistics.rospy = SimpleNamespace(
    Publisher=Publisher,
    Time=Clock,
    Duration=rospy.Duration,
    get_name=lambda: "/listener",
    get_param=lambda name, default: default,
    logerr=lambda *text: sys.exit(str(text)),
)
rows = json.load(sys.stdin)
now[0] = rows[0][0]
logger = statistics.SubscriberStatisticsLogger(SimpleNamespace(name="/chatter"))
for arrival, stamp, seq in rows:
    now[0] = arrival
    header = SimpleNamespace(stamp=rospy.Time(0, stamp), seq=seq)
    logger.callback(SimpleNamespace(_has_header=True, header=header), "/talker", 0)
print(json.dumps(found))
