"""Chapter 15: its figures are numbered in order, and its script runs as the page lists it."""

from __future__ import annotations

import re
from pathlib import Path

from book.tools import notebooks
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag
from rosmini.ros.scripts import ScriptSpec, run_scripts

from .conftest import figure_numbers

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "15_bags.ipynb"


def test_every_figure_is_numbered_in_order():
    numbers = figure_numbers(CHAPTER.stem)
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) == 5


def test_the_listed_script_runs(tmp_path, monkeypatch, capsys):
    prose = "\n".join(cell.source for cell in notebooks.read(CHAPTER).cells if cell.cell_type == "markdown")
    (script,) = re.findall(r"^```python\n(import rosbag\n.*?)^```", prose, re.DOTALL | re.MULTILINE)
    monkeypatch.chdir(tmp_path)
    twist = message_class("geometry_msgs/Twist")()
    twist.linear.x = 0.25
    with Bag("drive.bag", "w") as bag:
        bag.write("/cmd_vel", twist, Time(5))
    assert run_scripts([ScriptSpec("reader", source=script)], prefix=False).status == 0
    assert capsys.readouterr().out == "5.0 0.25\n"
