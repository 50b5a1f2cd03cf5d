"""The pages that the build makes from the code."""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

from book.tools.reference import FidelityTables, ParameterTables, changeable, declared, fidelity
from rosmini.navigation.amcl.parameters import AmclParameters

from ..processes import run

TESTS = Path(__file__).resolve().parents[1]
PAGE = TESTS.parent / "book" / "about" / "api.md"


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


def test_each_row_of_the_page_on_fidelity_has_its_subject_and_a_test_that_exists() -> None:
    rows = [row for area in fidelity().values() for row in area]
    assert len(rows) > 40
    assert all({"subject", "ros", "test"} <= row.keys() <= {"subject", "ros", "rosmini", "test"} for row in rows)
    for key in ("subject", "test"):
        assert len({row[key] for row in rows}) == len(rows)
    for row in rows:
        file, _, function = row["test"].partition("::")
        tree = ast.parse((TESTS / file).read_text(encoding="utf-8"))
        assert function in {each.name for each in tree.body if isinstance(each, ast.FunctionDef)}, row["test"]


def test_a_row_shows_the_words_of_its_test() -> None:
    shown = "\n".join(FidelityTables.lines(FidelityTables.__new__(FidelityTables)))
    assert "| The same. | *the same line prints the same*, `interop/test_rosnode_rostopic.py` |" in shown
