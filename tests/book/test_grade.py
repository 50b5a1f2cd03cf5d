"""`rosmini grade`: points for right answers, and plain words for submissions that go wrong, which stop nothing else."""

from __future__ import annotations

import csv
import json
import sys

import pytest

from rosmini.book.grade import TOOL
from rosmini.book.submission import SubmissionError

ORDER = 'order = "a1 b1 b2 a2 b3"'
CHECK = 'check("lane_order", order)'
STOP = """\
%%node stop.py
# Exercise: stop
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    command.linear.x = 0.2 if scan.ranges[0] > 0.5 else 0.0
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan)
rospy.spin()
"""


def write(path, *sources):
    path.parent.mkdir(parents=True, exist_ok=True)
    cells = [{"cell_type": "code", "source": source, "metadata": {}, "outputs": []} for source in sources]
    path.write_text(json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}), encoding="utf-8")


def grade(folder, *words, limit=300):
    """Return the rows of `grades.csv` by student."""
    TOOL.run(folder, "--output", folder.parent / "out", "--limit", limit, *words)
    with (folder.parent / "out" / "grades.csv").open(encoding="utf-8", newline="") as file:
        return {row["student"]: row for row in csv.DictReader(file)}


def test_answers_are_checked_again_whatever_the_notebook_calls_check(tmp_path):
    folder = tmp_path / "submitted"
    write(folder / "ada" / "ps1" / "work.ipynb", "from rosmini.book import check", ORDER, f"assert {CHECK}")
    write(folder / "bob.ipynb", "def check(*answer): return True", 'order = "b1"', CHECK)
    replaced = "import rosmini.book.checks as checks\nchecks.expect = lambda *words: None"
    write(folder / "cleo.ipynb", "from rosmini.book import check", replaced, 'order = "b1"', CHECK)
    (folder / "dan").mkdir()
    rows = grade(folder)
    assert {name: (row["lane_order"], row["points"]) for name, row in rows.items()} == {
        "ada": ("1", "1"), "bob": ("0", "0"), "cleo": ("0", "0"), "dan": ("0", "0"),
    }  # fmt: skip
    assert rows["dan"]["remarks"]
    assert "rosmini.book.checks.expect" in (tmp_path / "out" / "cleo.html").read_text(encoding="utf-8")


@pytest.mark.processes
def test_what_ends_a_submission_is_reported_and_costs_only_its_cell(tmp_path):
    folder = tmp_path / "submitted"
    bad = {
        "exit": "import os; os._exit(3)",
        "hang": "import time\nwhile True:\n    try: time.sleep(1000)\n    except BaseException: pass",
        "raise": "1 / 0",
    }
    if sys.platform == "linux":
        bad["memory"] = "found = []\nwhile True: found.append(bytearray(100_000_000))"
        bad["forks"] = "import os, time\nwhile True:\n    os.fork() or time.sleep(1000)"
    for name, source in bad.items():
        write(folder / f"{name}.ipynb", source, ORDER, CHECK)
    write(folder / "worse.ipynb", "1 / 0", CHECK)
    (folder / "broken.ipynb").write_text("{", encoding="utf-8")
    rows = grade(folder, "--jobs", 3, limit=40)
    assert {name: rows[name]["points"] for name in bad} == dict.fromkeys(bad, "1")
    for name in bad.keys() - {"raise"}:
        assert f"{name}.ipynb, cell 1 " in rows[name]["remarks"]
    assert "40 s" in rows["hang"]["remarks"]
    assert "exit status 3" in rows["exit"]["remarks"]
    assert rows["raise"]["remarks"] == ""
    assert "worse.ipynb, cell 1: ZeroDivisionError" in rows["worse"]["remarks"]
    assert "broken.ipynb" in rows["broken"]["remarks"]


def test_a_script_is_tried_with_each_seed_and_its_drives_are_on_the_page(tmp_path):
    folder = tmp_path / "submitted"
    write(folder / "ada.ipynb", "%load_ext rosmini", STOP)
    rows = grade(folder, "--exercises", "stop", "--seeds", "101,102")
    assert rows["ada"]["stop"] == "1"
    page = (tmp_path / "out" / "ada.html").read_text(encoding="utf-8")
    assert page.count("<iframe") == 2
    assert "seed 102" in page


def test_a_package_answers_the_project(tmp_path):
    package = tmp_path / "submitted" / "ada" / "ws" / "src" / "patrol_robot"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>patrol_robot</name><version>0.0.0</version><description>x</description>'
        '<maintainer email="a@example.com">A</maintainer><license>MIT</license></package>',
        encoding="utf-8",
    )
    rows = grade(tmp_path / "submitted")
    assert rows["ada"]["project"] == "0"
    assert "test/*.test" in (tmp_path / "out" / "ada.html").read_text(encoding="utf-8")


def test_a_folder_without_submissions_is_an_error(tmp_path):
    with pytest.raises(SubmissionError):
        grade(tmp_path)
