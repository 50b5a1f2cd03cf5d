"""A script for interactive_markers that tells what it does, as JSON on its last line. Run by the real one and by ours.

Three markers and a menu, and what happens to them is drawn by lot. Feedback has no client: so none is refused, since a
new marker remembers none.
"""

import contextlib
import json
import random

import rospy
from geometry_msgs.msg import Pose
from interactive_markers.interactive_marker_server import (
    Header,
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerServer,
)
from interactive_markers.menu_handler import MenuHandler

rospy.init_node("peer")
server = InteractiveMarkerServer("basic", "/one", 10)
menu = MenuHandler()
lot = random.Random(5)
calls, updates, inits, applied = [], [], [], []


def calling(tag):
    return lambda feedback: calls.append([tag, feedback.marker_name, feedback.event_type])


def updated(message):
    if message.type == message.UPDATE:
        markers = sorted(
            [
                marker.name,
                marker.description,
                marker.pose.position.x,
                [[one.id, one.parent_id, one.title, one.command, one.command_type] for one in marker.menu_entries],
            ]
            for marker in message.markers
        )
        poses = [[one.name, one.header.frame_id, one.pose.position.x] for one in message.poses]
        updates.append([message.server_id, message.seq_num, markers, poses, list(message.erases)])


def full(message):
    applied[:] = [marker.name for marker in message.markers]
    found = [[marker.name, marker.description, marker.pose.position.x] for marker in message.markers]
    inits.append([message.server_id, message.seq_num, sorted(found)])


server.update_pub.publish = updated
server.init_pub.publish = full
handles = [menu.insert("a", callback=calling("a")), menu.insert("b", callback=calling("b"))]
handles.append(menu.insert("c", parent=1, callback=calling("c")))
handles.append(menu.insert("d", parent=3, command_type=1, command="rosrun a b", callback=calling("d")))


def pose_at(x):
    pose = Pose()
    pose.position.x = x
    return pose


def insert(name, number):
    marker = InteractiveMarker(name=name, description=str(number), pose=pose_at(number))
    marker.header.frame_id = "base"
    if lot.random() < 0.5:
        return server.insert(marker, calling(number), lot.choice([255, 1, 5]))
    return server.insert(marker, feedback_cb=calling(number))


def move(name, number):
    """The real one fails for a marker that was never applied."""
    header = lot.choice([Header(), Header(frame_id="odom")])
    return server.setPose(name, pose_at(number), header) if name in applied else None


def erase(name, number):
    return server.clear() if lot.random() < 0.1 else server.erase(name)


def call_back(name, number):
    return server.setCallback(name, calling(number), lot.choice([255, 1, 5]))


def apply_menu(name, number):
    """The real one fails for a marker that is not there."""
    menu.setVisible(lot.choice(handles), lot.random() < 0.8)
    menu.setCheckState(lot.choice(handles), lot.choice([menu.NO_CHECKBOX, menu.CHECKED, menu.UNCHECKED]))
    there = server.get(name) is not None and menu.apply(server, name)
    if all(server.get(other) is not None for other in "pqr"):
        menu.reApply(server)
    return [there, [[menu.getTitle(handle), menu.getCheckState(handle)] for handle in [*handles, 99]]]


def feed_back(name, number):
    """The real one fails where nothing is to be called."""
    feedback = InteractiveMarkerFeedback(marker_name=name, pose=pose_at(number), menu_entry_id=lot.randrange(6))
    feedback.event_type = lot.choice([1, 2, 3, 5])
    with contextlib.suppress(TypeError):
        server.processFeedback(feedback)


def apply_changes(name, number):
    return server.applyChanges()


story = []
for number in range(1000):
    act = lot.choice(
        [insert, insert, move, move, erase, call_back, apply_menu, feed_back, feed_back] + [apply_changes] * 3
    )
    name = lot.choice("pqr")
    answer = act(name, float(number))
    now = [server.get(one) for one in "pqr"]
    story.append(
        {
            "act": [number, act.__name__, name, answer],
            "now": [
                one and [one.name, one.description, one.pose.position.x, one.header.frame_id, len(one.menu_entries)]
                for one in now
            ],
            "told": [list(calls), list(updates), list(inits)],
        }
    )
    del calls[:], updates[:], inits[:]
print(json.dumps({"handles": handles, "story": story}))
