"""Running scripts in tests: what they print, and that nothing of them stays in the process."""

from __future__ import annotations

import io
import logging
import os
import random
import signal
import sys
import textwrap
import threading
import time
import warnings
from contextlib import contextmanager
from dataclasses import dataclass
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np  # noqa: F401 - adds warning filters when it is imported
import pytest

import rosmini.ros.rospy
from rosmini.ros.scripts import RunResult, ScriptSpec, run_scripts

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path


@dataclass
class Ran:
    """A finished run and what it printed, standard output and error together."""

    result: RunResult
    text: str

    @property
    def lines(self) -> list[str]:
        return self.text.splitlines()

    @property
    def status(self) -> int:
        return self.result.status


IN_BOTH_CLOCKS = {"test_run", "test_rospy_scripts", "test_stdin"}
"""The modules whose tests run in both clocks with each commit; at night all do."""


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Choose the clocks in which a test runs."""
    if "simulated" in metafunc.fixturenames:
        each_commit = metafunc.module.__name__.rpartition(".")[2] in IN_BOTH_CLOCKS
        wall = pytest.param(False, id="wall", marks=[] if each_commit else pytest.mark.nightly)
        metafunc.parametrize("simulated", [pytest.param(True, id="simulated"), wall])


def state() -> dict[str, Any]:
    return {
        "argv": list(sys.argv),
        "path": list(sys.path),
        "streams": (sys.stdin, sys.stdout, sys.stderr),
        "main": sys.modules["__main__"],
        "environ": {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"},
        "cwd": os.getcwd(),
        "random": random.getstate(),
        "logging": (list(logging.root.handlers), logging.root.level, logging.root),
        "filters": list(warnings.filters),
        "signals": [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)],
        "excepthook": sys.excepthook,
        "threading": (threading.Thread, threading.excepthook),
        "environ object": id(os.environ),
    }


@contextmanager
def nothing_left() -> Iterator[None]:
    """After a run the process is as it was: streams, modules, random state, threads."""
    before, threads = state(), set(threading.enumerate())
    modules = {name: module for name, module in sys.modules.items() if getattr(module, "__file__", None)}
    yield
    after = state()
    for key, value in before.items():
        assert after[key] == value, f"a script changed the host's {key}"
    deadline = time.monotonic() + PATIENCE
    while (left := set(threading.enumerate()) - threads) and time.monotonic() < deadline:
        for thread in left:
            thread.join(0.05)
    assert not left, f"threads are left: {left}"
    strangers = {
        name
        for name, module in sys.modules.items()
        if name not in modules and "pytest-of" in str(getattr(module, "__file__", ""))
    }
    assert not strangers, f"modules of scripts are left: {strangers}"
    replaced = [name for name, module in modules.items() if name in sys.modules and sys.modules[name] is not module]
    assert not replaced, f"modules were replaced: {replaced}"


def enders(holds: Callable[[], bool]) -> tuple[ScriptSpec, dict[str, ModuleType]]:
    """A script that ends the run, as Ctrl-C does, once a condition holds; and the modules it needs."""
    host = ModuleType("host")
    vars(host).update(holds=holds, stop=lambda: signal.raise_signal(signal.SIGINT))
    source = "import host, time\nwhile not host.holds():\n    time.sleep(0.005)\nhost.stop()\n"
    return ScriptSpec("end", (), source=source), {**rosmini.ros.rospy.modules(), "host": host}


class Runner:
    """Runs scripts, texts or files, several at once, in the clock of the test."""

    def __init__(self, simulated: bool) -> None:
        self.simulated = simulated

    def __call__(
        self,
        *specs: ScriptSpec | str,
        args: tuple[str, ...] = (),
        stdin: Any = "",
        prefix: bool = True,
        until: str | None = None,
        out: io.StringIO | None = None,
        **options: Any,
    ) -> Ran:
        """Run them until all have ended, or as soon as the line `until` was printed. `out` has what they print."""
        out = out or io.StringIO()
        whole = [spec if isinstance(spec, ScriptSpec) else self.text("script", spec, *args) for spec in specs]
        options = {"simulated": self.simulated, "grace": 0.3, **options}
        if until is not None:
            end, modules = enders(lambda: until in out.getvalue().splitlines())
            whole.append(end)
            options |= {"modules": modules, "duration": PATIENCE, "grace": 3.0}
        with nothing_left():
            result = run_scripts(whole, stdin=stdin, stdout=out, stderr=out, prefix=prefix, **options)
        return Ran(result, out.getvalue())

    def text(self, name: str, source: str, *args: str) -> ScriptSpec:
        """A script that is in no file."""
        return ScriptSpec(name, args, source=textwrap.dedent(source))

    def file(self, folder: Path, name: str, source: str, *args: str) -> ScriptSpec:
        """A script, written to `folder`."""
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(source), encoding="utf-8")
        return ScriptSpec(str(path), args)


@pytest.fixture
def run(simulated: bool) -> Runner:
    return Runner(simulated)


@pytest.fixture
def sim() -> Runner:
    """In simulated time only."""
    return Runner(simulated=True)
