"""A workspace with a package whose scripts talk, end and hold on, for the tests of what runs."""

from __future__ import annotations

from pathlib import Path

MANIFEST = (
    "<package format='2'><name>speaking</name><version>1.0.0</version><description>-</description>"
    "<maintainer email='a@example.org'>A</maintainer><license>BSD</license></package>"
)

TALKER = """#!/usr/bin/env python3
import os
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
rospy.on_shutdown(lambda: print("shut down", flush=True))
publisher = rospy.Publisher("chatter", String, queue_size=10, latch=True)
publisher.publish(rospy.get_param("~greeting", "hello"))
print(rospy.get_name(), os.environ.get("NUMBER"), rospy.resolve_name("chatter"), flush=True)
rospy.spin()
"""

ENDING = """#!/usr/bin/env python3
import sys
import rospy
rospy.init_node("ending")
rospy.sleep(float(sys.argv[1]))
print("ends", flush=True)
sys.exit(int(sys.argv[2]))
"""

STUBBORN = """#!/usr/bin/env python3
import signal
import time
signal.signal(signal.SIGINT, signal.SIG_IGN)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
print("stubborn", flush=True)
while True:
    time.sleep(0.1)
"""


def make(folder: Path, **launch_files: str) -> Path:
    """Make the package `speaking`, with these launch files; return the folder that it is in."""
    package = folder / "src" / "speaking"
    for inside in ("scripts", "launch"):
        (package / inside).mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST, encoding="utf-8")
    for name, text in (("talker.py", TALKER), ("ending.py", ENDING), ("stubborn.py", STUBBORN)):
        (package / "scripts" / name).write_text(text, encoding="utf-8")
        (package / "scripts" / name).chmod(0o755)
    for name, inside in launch_files.items():
        (package / "launch" / f"{name}.launch").write_text(f"<launch>\n{inside}\n</launch>\n", encoding="utf-8")
    return folder / "src"
