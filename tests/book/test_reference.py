"""The pages that the build makes from the code."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from book.tools.reference import ParameterTables, changeable, declared
from rosmini.navigation.amcl.parameters import AmclParameters

from ..processes import run

PAGE = Path(__file__).resolve().parents[2] / "book" / "about" / "api.md"


def test_the_examples_of_the_page_on_the_interface_run(tmp_path: Path) -> None:
    examples = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    (tmp_path / "examples.py").write_text("\n".join(examples), encoding="utf-8")
    done = run([sys.executable, "examples.py"], cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("hello\n" * 3)
    assert "Reached goal" in done.stdout


def test_each_package_has_its_parameters() -> None:
    packages = declared()
    assert AmclParameters in packages["amcl"]
    assert {"move_base", "costmap_2d", "stage_ros", "rosmini_sim", "turtlesim"} <= packages.keys()
    assert {"max_particles", "laser_max_beams"} <= changeable(AmclParameters)
    assert "initial_pose_x" not in changeable(AmclParameters)
    rows = list(ParameterTables.lines(ParameterTables.__new__(ParameterTables)))
    assert "| `max_particles` | `5000` | maximum number of particles (*int, 0 ... 10000, at run time*) |" in rows
