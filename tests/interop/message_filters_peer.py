"""A script for message_filters that tells what it does, as JSON on its last line. Run by the real one and by ours.

Time is that of /clock, which the script publishes itself: so it can also go back.
"""

import json
import random

import message_filters
import rospy
from geometry_msgs.msg import PointStamped
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header, String

rospy.set_param("/use_sim_time", True)
rospy.init_node("peer")
rospy.set_param("/use_sim_time", False)
clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
facts = {}


def set_time(milliseconds):
    time = rospy.Time(milliseconds // 1000, milliseconds % 1000 * 1000000)
    clock.publish(time)
    while rospy.get_rostime() != time:
        rospy.rostime.wallsleep(0.0005)


def stamped(milliseconds, number):
    stamp = rospy.Time(milliseconds // 1000, milliseconds % 1000 * 1000000)
    return PointStamped(header=Header(stamp=stamp, frame_id=str(number)))


def story(make, inputs, stamps):
    """What a synchroniser gives out, for messages (input, stamp) one after another."""
    filters = [message_filters.SimpleFilter() for _ in range(inputs)]
    synchroniser = make(filters)
    found = []
    waits = []
    synchroniser.registerCallback(
        lambda *args: found.append([int(msg.header.frame_id) for msg in args[:-1]] + [args[-1]]), "extra"
    )
    for number, (index, stamp) in enumerate(stamps):
        filters[index].signalMessage(stamped(stamp, number))
        waits.append(
            [
                sorted((stamp.to_nsec(), int(msg.header.frame_id)) for stamp, msg in queue.items())
                for queue in synchroniser.queues
            ]
        )
    return found + waits


set_time(1000)
dice = random.Random(4)
facts["exact"] = []
facts["approximate"] = []
for _ in range(150):
    inputs, queue, slop = dice.choice([1, 2, 3, 4]), dice.choice([1, 2, 5]), dice.choice([0.01, 0.03, 0.1])
    jitter = dice.choice([0, 20, 100])
    stamps = [(dice.randrange(inputs), 10 * n + dice.randint(-jitter, jitter) + 200) for n in range(60)]
    coarse = [(index, stamp // 40 * 40) for index, stamp in stamps]
    facts["exact"].append(story(lambda f, q=queue: message_filters.TimeSynchronizer(f, q), inputs, coarse))
    facts["approximate"].append(
        story(lambda f, q=queue, s=slop: message_filters.ApproximateTimeSynchronizer(f, q, s), inputs, stamps)
    )
facts["sets"] = [sum(map(len, facts[kind])) - 150 * 60 for kind in ("exact", "approximate")]


class Own(message_filters.TimeSynchronizer):
    """Takes a set as soon as two of its inputs have it: by the queues alone."""

    def add(self, msg, my_queue, my_queue_index=None):
        my_queue[msg.header.stamp] = msg
        while len(my_queue) > self.queue_size:
            del my_queue[min(my_queue)]
        for stamp in sorted(set(self.queues[0]) & set(self.queues[1])):
            self.signalMessage(self.queues[0].pop(stamp), self.queues[1].pop(stamp))


stamps = [(dice.randrange(3), 100 + 40 * dice.randrange(12)) for n in range(60)]
facts["own"] = story(lambda f: Own(f, 5), 3, stamps)
plain = message_filters.TimeSynchronizer([message_filters.SimpleFilter()] * 2, 3)
plain.add(stamped(100, 1), plain.queues[1])
plain.queues[1].clear()
plain.add(stamped(200, 1), plain.queues[1])
facts["by hand"] = [[stamp.to_nsec() for stamp in queue] for queue in plain.queues]

# ---- a clock that goes back ----

facts["jumps"] = {}
for name, make in {
    "exact": lambda f: message_filters.TimeSynchronizer(f, 10),
    "exact, reset": lambda f: message_filters.TimeSynchronizer(f, 10, reset=True),
    "approximate": lambda f: message_filters.ApproximateTimeSynchronizer(f, 10, 0.05),
    "approximate, reset": lambda f: message_filters.ApproximateTimeSynchronizer(f, 10, 0.05, reset=True),
}.items():
    set_time(1000)
    filters = [message_filters.SimpleFilter(), message_filters.SimpleFilter()]
    synchroniser = make(filters)
    found = []
    synchroniser.registerCallback(lambda one, two, to=found: to.append([one.header.frame_id, two.header.frame_id]))
    for number, (now, index, stamp) in enumerate(
        [
            (5000, 0, 5000),
            (5000, 0, 3000),
            (5010, 1, 5000),
            (5020, 1, 5100),
            (3000, 1, 3000),
            (3000, 0, 5100),
            (3010, 0, 3000),
            (3020, 1, 3000),
            (3020, 0, 3000),
            (3020, 1, 3100),
            (3030, 0, 3100),
            (2000, 0, 2000),
            (2000, 1, 2000),
            (2010, 0, 2010),
            (2010, 1, 2010),
        ]
    ):
        set_time(now)
        filters[index].signalMessage(stamped(stamp, number))
    facts["jumps"][name] = found

# ---- messages without a header ----

set_time(7000)
filters = [message_filters.SimpleFilter(), message_filters.SimpleFilter()]
found = []
for allow in (False, True):
    synchroniser = message_filters.ApproximateTimeSynchronizer(filters, 5, 0.1, allow_headerless=allow)
    synchroniser.registerCallback(lambda one, two, allow=allow: found.append([allow, one.data, two.header.seq]))
filters[0].signalMessage(String("text"))
filters[1].signalMessage(PointStamped(header=Header(stamp=rospy.Time(7, 50000000))))
facts["headerless"] = found

# ---- a cache ----


def ids(answer):
    if answer is None:
        return None
    return [int(one.header.frame_id) for one in answer] if isinstance(answer, list) else int(answer.header.frame_id)


source = message_filters.SimpleFilter()
cache = message_filters.Cache(source, 4)
passed = []
cache.registerCallback(lambda msg: passed.append(int(msg.header.frame_id)))
none = rospy.Time(1)
facts["empty cache"] = [
    cache.getInterval(none, none), cache.getElemAfterTime(none), cache.getElemBeforeTime(none),
    cache.getLatestTime(), cache.getLastestTime(), cache.getOldestTime(), cache.getLast(),
]  # fmt: skip
for number, stamp in enumerate([100, 200, 300, 300, 500, 700]):
    source.signalMessage(stamped(stamp, number))
facts["cache"] = {"passed": passed, "kept": [[time.to_nsec() for time in cache.cache_times], ids(cache.cache_msgs)]}
for when in (50, 300, 400, 700, 900):
    time = stamped(when, 0).header.stamp
    facts["cache"][str(when)] = [
        ids(cache.getElemAfterTime(time)),
        ids(cache.getElemBeforeTime(time)),
        ids(cache.getInterval(stamped(300, 0).header.stamp, max(time, rospy.Time(0, 300000000)))),
    ]
facts["cache"]["ends"] = [
    cache.getOldestTime().to_nsec(),
    cache.getLatestTime().to_nsec(),
    cache.getLastestTime().to_nsec(),
    ids(cache.getLast()),
]
facts["caches"] = []
for _ in range(40):
    source = message_filters.SimpleFilter()
    cache = message_filters.Cache(source, dice.choice([1, 2, 5, 9]))
    for number in range(12):
        source.signalMessage(stamped(100 * dice.randrange(1, 9), number))
        begin, end = sorted(stamped(100 * dice.randrange(1, 9), 0).header.stamp for _ in "12")
        facts["caches"].append(
            [
                ids(cache.getInterval(begin, end)),
                ids(cache.getElemAfterTime(begin)),
                ids(cache.getElemBeforeTime(begin)),
                ids(cache.getLast()),
                cache.getLatestTime().to_nsec(),
                cache.getOldestTime().to_nsec(),
            ]
        )
text = message_filters.SimpleFilter()
kept = message_filters.Cache(text, 2, allow_headerless=True)
refused = message_filters.Cache(text, 2)
text.signalMessage(String("x"))
facts["headerless cache"] = [kept.getLast().data, kept.getLatestTime().to_nsec(), refused.getLast()]

# ---- subscribers ----

left = message_filters.Subscriber("left", PointStamped)
right = message_filters.Subscriber("right", PointStamped, queue_size=5)
both = message_filters.TimeSynchronizer([left, right], 10)
pairs = []
both.registerCallback(lambda one, two: pairs.append([int(one.header.frame_id), int(two.header.frame_id)]))
senders = [rospy.Publisher(name, PointStamped, queue_size=10) for name in ("left", "right")]
while not all(sender.get_num_connections() for sender in senders):
    rospy.rostime.wallsleep(0.01)
for number, sender in enumerate(senders):
    for stamp in (100, 200, 300):
        sender.publish(stamped(stamp, 1000 * number + stamp))
for _ in range(500):
    if len(pairs) == 3:
        break
    rospy.rostime.wallsleep(0.01)
facts["subscribers"] = {
    "pairs": pairs,
    "topic": [left.getTopic(), left.topic, left.name, left.resolved_name],
    "connections": left.get_num_connections(),
    "numbers": [left.registerCallback(print), left.registerCallback(print)],
}
left.unregister()
print(json.dumps(facts))
