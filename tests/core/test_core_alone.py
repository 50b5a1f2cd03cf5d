"""`rosmini/core` is a complete pub/sub library: it works without the other rooms, with its own dependencies only."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest

from ..processes import run

ROOT = Path(__file__).resolve().parents[2]
DEPENDENCIES = ["catkin_pkg", "defusedxml", "greenlet", "numpy", "PIL", "pymunk", "yaml"]
BEHIND_THEM = ["_cffi_backend", "_yaml", "cffi", "dateutil", "docutils", "pyparsing", "six"]
"""Modules that the dependencies import themselves."""

BLOCK_THE_REST = f"""
import sys

class Blocker:
    allowed = {{*sys.stdlib_module_names, "rosmini", *{DEPENDENCIES + BEHIND_THEM!r}}}

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in self.allowed:
            raise ModuleNotFoundError(f"{{name}} is not a dependency of core", name=name)

for name in set(sys.modules) - {{"__main__"}}:  # what the interpreter's own .pth files imported
    if name.partition(".")[0] not in Blocker.allowed:
        del sys.modules[name]
sys.meta_path.insert(0, Blocker())
"""

TALKER_AND_LISTENER = """
from rosmini import Graph
from rosmini.msgs import std_msgs

def hear(message):
    print(f"{listener.now().to_sec():.1f} {message.data}")

with Graph() as graph:
    listener = graph.node("listener")
    listener.subscriber("chatter", std_msgs.msg.String, hear)
    talker = graph.node("talker")
    chatter = talker.publisher("chatter", std_msgs.msg.String, queue_size=10)
    talker.timer(1.0, lambda event: chatter.publish(data="hello"))
    graph.run(2.5)
"""

EVERY_MODULE = """
import pkgutil
import rosmini.core, rosmini.msgs

for package in (rosmini.core, rosmini.msgs):
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if module.name == "rosmini.core.graph.promise_stacks":
            continue  # can be imported on Emscripten only
        __import__(module.name)
        print(module.name)
"""


@pytest.fixture(scope="module")
def core_alone(tmp_path_factory):
    """A folder with the core of the library, the messages and the packages' files, and nothing else."""
    folder = tmp_path_factory.mktemp("core_alone")
    ignored = shutil.ignore_patterns("__pycache__")
    for room in ("core", "msgs"):
        shutil.copytree(ROOT / "rosmini" / room, folder / "rosmini" / room, ignore=ignored)
    for file in ("__init__.py", "py.typed"):
        shutil.copy(ROOT / "rosmini" / file, folder / "rosmini")
    shutil.copytree(ROOT / "assets", folder / "rosmini" / "_assets", ignore=ignored)
    return folder


def run_alone(folder: Path, script: str) -> list[str]:
    """Run `script` in a fresh interpreter in which nothing but core and its dependencies can be imported."""
    (folder / "script.py").write_text(BLOCK_THE_REST + script, encoding="utf-8")
    done = run([sys.executable, "script.py"], cwd=folder, env=os.environ | {"PYTHONPATH": str(folder)})
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_a_listener_hears_a_talker(core_alone):
    assert run_alone(core_alone, TALKER_AND_LISTENER) == ["1001.0 hello", "1002.0 hello"]


def test_every_module_of_core_can_be_imported(core_alone):
    imported = run_alone(core_alone, EVERY_MODULE)
    files = [path for room in ("core", "msgs") for path in (core_alone / "rosmini" / room).rglob("*.py")]
    # Three are not listed: `core` and `msgs` themselves, and the module for Emscripten.
    assert len(imported) == len(files) - 3


def test_another_room_cannot_be_imported(core_alone):
    assert run_alone(core_alone, "import importlib.util as u\nprint(u.find_spec('rosmini.sim'))") == ["None"]
