"""What is measured of launch files: reading those of a robot's navigation into a plan, beside real roslaunch."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.ros.launch import Plan, read

from . import Measure

if TYPE_CHECKING:
    from .peer import Rospy

NODE = Path(__file__).with_name("launch_node.py")
FILES = Path(__file__).parents[2] / "ros" / "launch" / "data" / "shapes"

SUBJECTS = {"navigation.launch": "5 files, 5 nodes, a xacro", "slam.launch": "2 files, 2 nodes"}


def plan_of(name: str) -> Plan:
    """Read a file, looking for packages again."""
    return read(FILES / name, packages=PackageIndex([assets_dir() / "ros"]), environ={})


def ours_ms(name: str, count: int) -> float:
    """Return the milliseconds of CPU that a reading takes."""
    plan_of(name)
    begin = time.process_time()
    for _ in range(count):
        plan_of(name)
    return (time.process_time() - begin) * 1e3 / count


def real_ms(python: str, name: str, count: int) -> float:
    """Return the same of real roslaunch. Raises ``RosminiError`` if it reads something else than ours."""
    environment = {
        **os.environ,
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),  # our xacro is its, too
        "ROS_PACKAGE_PATH": str(assets_dir() / "ros"),
    }
    environment.pop("TURTLEBOT3_MODEL", None)
    done = subprocess.run(
        [python, str(NODE), str(FILES / name), str(count)],
        capture_output=True, check=True, encoding="utf-8", env=environment,
    )  # fmt: skip
    spent, nodes, params = done.stdout.split()
    plan = plan_of(name)
    if (int(nodes), int(params)) != (len(plan.nodes), len(plan.settings)):
        raise RosminiError(f"{name} means something else to real roslaunch, so there is no figure")
    return float(spent)


def measures(rospy: Rospy | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""
    python = rospy.python if rospy is not None and _has_roslaunch(rospy) else None
    for name, what in SUBJECTS.items():
        count = max(int(10 * scale), 1)
        yield Measure(
            f"read {name}: {what}",
            "ms of CPU",
            lambda name=name, count=count: ours_ms(name, count),  # type: ignore[misc]
            None if python is None else lambda name=name, count=count: real_ms(python, name, count),  # type: ignore[misc]
            "roslaunch",
            more_is_better=False,
        )


def _has_roslaunch(rospy: Rospy) -> bool:
    words = [rospy.python, "-c", "import roslaunch.xmlloader"]
    return subprocess.run(words, capture_output=True, check=False).returncode == 0
