"""Run by the system's Python with real rosbag: writes a bag, or prints what is in bags."""

import hashlib
import json
import sys

import genpy
import rosbag
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import String


def header(cls, topic, caller, latching):
    return {
        "callerid": caller,
        "latching": latching,
        "md5sum": cls._md5sum,
        "message_definition": cls._full_text,
        "topic": topic,
        "type": cls._type,
    }


def write(path, compression):
    with rosbag.Bag(path, "w", compression=compression, chunk_threshold=20000) as bag:
        for i in range(200):
            t = genpy.Time(1000 + i, 1000 * i)
            bag.write("/chatter", String(f"hello {i}"), t, connection_header=header(String, "/chatter", "/talker", "0"))
            scan = LaserScan(ranges=[0.5 * i, float("inf")], range_max=3.5)
            scan.header.seq, scan.header.stamp, scan.header.frame_id = i, t, "laser"
            bag.write("/scan", scan, t)
        bag.write(
            "/map", String("world"), genpy.Time(1000), connection_header=header(String, "/map", "/map_server", "1")
        )
        bag.write(
            "/image", Image(height=100, width=100, step=100, encoding="mono8", data=bytes(10000)), genpy.Time(1001)
        )


def content(path):
    found = []
    with rosbag.Bag(path) as bag:
        for topic, raw, t, head in bag.read_messages(raw=True, return_connection_header=True):
            fields = {key: (value if isinstance(value, str) else value.decode()) for key, value in head.items()}
            found.append([topic, t.to_nsec(), hashlib.md5(raw[1]).hexdigest(), fields])
        strings = [m.data for topic, m, t in bag.read_messages(["/chatter"])]
        info = bag.get_type_and_topic_info()
        topics = {
            name: [one.msg_type, one.message_count, one.connections, one.frequency] for name, one in info.topics.items()
        }
        summary = [
            bag.get_message_count(), bag.get_message_count(["/scan"]), bag.get_start_time(), bag.get_end_time(),
            bag.version, list(bag.get_compression_info()), info.msg_types, topics, str(bag), bag.size,
        ]  # fmt: skip
    return {"messages": found, "strings": strings, "summary": summary}


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write(*sys.argv[2:])
    else:
        print(json.dumps([content(path) for path in sys.argv[2:]]))
