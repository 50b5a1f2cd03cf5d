"""The rooms of the library hold: an import against the arrows, a circle and anything else at the top are refused."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest

from ..conftest import tool
from ..processes import run

ROOT = Path(__file__).resolve().parents[2]
COMMAND = "from importlinter.cli import lint_imports_command; lint_imports_command()"


def lint(checkout: Path) -> tuple[int, str]:
    """The status and the words of lint-imports on the `rosmini` in `checkout`."""
    tool("importlinter")
    done = run(
        [sys.executable, "-c", COMMAND, "--no-cache"],
        cwd=checkout,
        env=os.environ | {"PYTHONPATH": str(checkout), "PYTHONIOENCODING": "utf-8"},
    )
    return done.returncode, done.stdout + done.stderr


@pytest.fixture
def checkout(tmp_path):
    ignored = shutil.ignore_patterns("__pycache__", "_assets")
    shutil.copytree(ROOT / "rosmini", tmp_path / "rosmini", ignore=ignored)
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def test_the_rooms_hold(checkout):
    status, words = lint(checkout)
    assert status == 0, words


WRONG = (
    ("core/names.py", "from rosmini.ros.rospy import client", "rosmini.core.names -> rosmini.ros.rospy.client"),
    ("core/graph/__init__.py", "def f():\n    import rosmini.viz", "rosmini.core.graph -> rosmini.viz"),
    ("core/graph/lanes.py", "from rosmini.core.graph import scheduler", ".lanes -> .scheduler"),
    ("msgs/__init__.py", "from rosmini.tools import main", "rosmini.msgs -> rosmini.tools.main"),
    ("sim/world.py", "from rosmini.navigation.amcl import node", "rosmini.sim.world -> rosmini.navigation.amcl.node"),
    ("tools/rosnode.py", "import rosmini.viz.view", "rosmini.tools.rosnode -> rosmini.viz.view"),
)


def test_a_wrong_import_is_refused(checkout):
    for module, line, _ in WRONG:
        with (checkout / "rosmini" / module).open("a", encoding="utf-8") as file:
            file.write(f"\n{line}\n")
    status, words = lint(checkout)
    assert status == 1, words
    assert [arrow for _, _, arrow in WRONG if arrow not in " ".join(words.split())] == []


def test_nothing_else_lies_at_the_top():
    found = {
        path.name
        for path in (ROOT / "rosmini").iterdir()
        # an older checkout leaves folders that hold only compiled files
        if not path.name.startswith(("_", ".")) and (path.is_file() or any(path.rglob("*.py")))
    }
    assert found == {"book", "core", "msgs", "navigation", "notebook", "py.typed", "ros", "sim", "tools", "viz"}
