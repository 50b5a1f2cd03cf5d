"""What all tests share: the checkout, and the switch between `skip` and `fail` for what a machine may lack."""

from __future__ import annotations

import importlib
import json
import logging
import os
import re
import shutil
import signal
import sys
from contextlib import contextmanager, nullcontext
from importlib import import_module
from pathlib import Path
from types import CodeType
from typing import TYPE_CHECKING, Any

import pytest
from _pytest.assertion import rewrite
from hypothesis import HealthCheck, settings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

PROCESSES = f"{__name__.removesuffix('conftest')}processes"

ROOT = Path(__file__).resolve().parents[1]

HANDLES = {"signal", "threading", "select", "pty", "run_scripts"}
"""What a function names that has to do with processes, signals or threads, beside `tests/processes.py`."""

FIXTURES = {"kernel", "new_kernel", "shared_kernel", "chromium", "master", "run", "sim"}
"""What stands in a `conftest.py` and has to do with them."""

TIDY = set(
    re.findall(
        r"\w+",
        """actionlib catkin expressions geometry graph introspection launch logo msgs navigation net notebook packages
        report rosparam rospy scripts tf urdf""",
    )
)
"""Folders whose tests are seen to leave nothing behind; the others have not been gone through yet."""

# How long an example takes depends on the machine. Each commit is judged by the same examples; at night they are new.
AT_ANY_SPEED: Any = {
    "deadline": None,
    "suppress_health_check": [HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
}
settings.register_profile("commit", max_examples=10, derandomize=True, **AT_ANY_SPEED)
settings.register_profile("nightly", max_examples=500, **AT_ANY_SPEED)
settings.load_profile("commit")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let tests be repeated in one process: what fails once in a hundred runs is found without collecting again."""
    parser.addoption("--repeat", type=int, default=1, metavar="N", help="run each test N times")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give each test as many cases as `--repeat` says."""
    if (times := metafunc.config.getoption("repeat")) > 1:
        metafunc.fixturenames.append("repetition")
        metafunc.parametrize("repetition", range(times))


def pytest_configure() -> None:
    """Give SIGINT its meaning back: a shell's background programs, and all their children, have it ignored."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_sessionstart(session: pytest.Session) -> None:
    """Do once, before the processes that share the tests each do it: compile navigation's loops and rewrite asserts.

    The loops are compiled in a process beside this one. Nothing is done again that is in a cache.
    """
    option = session.config.option
    is_worker = hasattr(session.config, "workerinput")
    if getattr(option, "numprocesses", None) and not is_worker and not option.collectonly:
        code = "from rosmini.navigation.kernels import compile_all; compile_all()"
        with import_module(PROCESSES).start([sys.executable, "-c", code], stderr=None) as compiler:
            if not sys.dont_write_bytecode:
                rewrite_asserts(session.config)
            compiler.wait()


def rewrite_asserts(config: pytest.Config) -> None:
    """Store the test modules with their asserts rewritten, where pytest looks for them; it has no public door for it.

    It takes longer than all the rest of collecting them, and each process of the tests would do it to all of them.
    """
    paths = [Path(arg.partition("::")[0]) for arg in config.args]
    for path in (file for at in paths for file in ([at] if at.is_file() else at.rglob("test_*.py"))):
        stored = rewrite.get_cache_dir(path) / f"{path.stem}{rewrite.PYC_TAIL}"
        if path.suffix == ".py" and not stored.is_file():
            stored.parent.mkdir(parents=True, exist_ok=True)
            digest, code = rewrite._rewrite_test(path, config)
            rewrite._write_pyc(config.stash[rewrite.assertstate_key], code, digest, stored)


def codes(function: Any) -> Iterator[CodeType]:
    """The code of a function or of a class's methods, and of what is defined inside."""
    todo = [each.__code__ for each in [function, *vars(function).values()] if hasattr(each, "__code__")]
    while todo:
        yield (code := todo.pop())
        todo += [constant for constant in code.co_consts if isinstance(constant, CodeType)]


def starts_something(item: pytest.Function) -> bool:
    """Whether a test, or a function or fixture that it uses, has to do with processes, signals or threads."""
    used = vars(item.module)
    seen, todo = set(item.fixturenames), [item.function, *map(used.get, item.fixturenames)]
    while todo:
        function = getattr(todo[-1], "__wrapped__", todo.pop())  # a fixture keeps its function there
        names = {name for code in codes(function) for name in code.co_names} if function else set()
        if names & HANDLES or any(getattr(used.get(name), "__module__", "") == PROCESSES for name in names):
            return True
        todo += [
            used[name] for name in names - seen if getattr(used.get(name), "__module__", "") == item.module.__name__
        ]
        seen |= names
    return not FIXTURES.isdisjoint(item.fixturenames)


def nightly(*cases: Any) -> list[Any]:
    """Cases of a parametrised test that run at night only."""
    rows = (case if isinstance(case, tuple) else (case,) for case in cases)
    return [pytest.param(*row, marks=pytest.mark.nightly) for row in rows]


def left_for_nightly(config: pytest.Config, item: pytest.Item) -> bool:
    """Whether a test is left for `.ci/nightly`: it is marked, and the command line names neither marker nor file."""
    if "nightly" in config.getoption("markexpr") or item.get_closest_marker("nightly") is None:
        return False
    named = (config.invocation_params.dir / arg.partition("::")[0] for arg in config.args)
    return item.path not in [path.resolve() for path in named]


def mixed(items: list[pytest.Item]) -> list[pytest.Item]:
    """Spread the chapters over the test files: chapters compute all the time, while a third of the tests wait."""
    files: dict[Path, list[pytest.Item]] = {}
    for item in items:
        files.setdefault(item.path, []).append(item)
    chapters = [path for path in files if path.suffix == ".ipynb"]
    places = {path: place for place, path in enumerate(path for path in files if path.suffix != ".ipynb")}
    places |= {path: i * len(places) / len(chapters) for i, path in enumerate(chapters)}
    return [item for path in sorted(places, key=places.__getitem__) for item in files[path]]


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave tests for the night; for `-m processes` mark those that have to do with processes, signals or threads."""
    left = {item for item in items if left_for_nightly(config, item)}
    if left:
        config.hook.pytest_deselected(items=[*left])
        items[:] = [item for item in items if item not in left]
    items[:] = mixed(items)
    if "processes" not in config.getoption("markexpr"):
        return
    known: dict[Any, bool] = {}
    for item in items:
        if isinstance(item, pytest.Function):
            # the thousands of cases of one function are looked at once
            key = (item.function, *item.fixturenames)
            if key not in known:
                known[key] = starts_something(item)
            if known[key]:
                item.add_marker("processes")


def state_of_process() -> dict[str, Any]:
    """What a test may change while it runs."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}
    graphs = getattr(sys.modules.get("rosmini.core.graph.graph"), "_default", {})
    return {
        "the working directory": os.getcwd(),
        "the environment": environment,
        "sys.path": list(sys.path),
        "sys.argv": list(sys.argv),
        "the recursion limit": sys.getrecursionlimit(),
        "nodes of the default graph": [name for graph in graphs.values() for name in graph.nodes if name != "/rosout"],
        "the root logger's handlers": list(logging.root.handlers),
    }


@contextmanager
def nothing_left(folder: Path) -> Iterator[None]:
    """Fail if the process is not as it was: `state_of_process()`, and no module of a file below `folder`."""
    before, modules = state_of_process(), set(sys.modules)
    yield
    after = state_of_process()
    changed = [f"{what}: {value} is now {after[what]}" for what, value in before.items() if after[what] != value]
    changed += [
        f"sys.modules: {name} of {file}"
        for name in sys.modules.keys() - modules
        if (file := str(getattr(sys.modules[name], "__file__", None))).startswith(f"{folder}{os.sep}")
    ]
    assert not changed, "\n".join(["the test has left behind:", *changed])


@pytest.fixture(autouse=True)
def nothing_left_in_the_process(request: pytest.FixtureRequest, shared_tmp: Path) -> Iterator[None]:
    """A test of `TIDY` leaves the process as it was, so that the next one passes in whatever order they run."""
    tests = ROOT / "tests"
    is_tidy = tests in request.path.parents and request.path.relative_to(tests).parts[0] in TIDY
    with nothing_left(shared_tmp) if is_tidy else nullcontext():
        yield


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def shared_tmp(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A temporary folder that all xdist workers of this run share."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base


def required(what: str) -> bool:
    """Whether `ROSMINI_REQUIRE_<what>` forbids to skip tests for want of it."""
    return os.environ.get(f"ROSMINI_REQUIRE_{what}") == "1"


def tool(name: str) -> Any:
    """A module of the group make; skips without it, or fails if ROSMINI_REQUIRE_TOOLS=1."""
    if required("TOOLS"):
        return importlib.import_module(name)
    return pytest.importorskip(name, reason="it is in the group make: uv sync --group make")


MYPY = """
import json, sys
from mypy import api
results = [api.run(arguments) for arguments in json.load(sys.stdin)]
json.dump(["".join(r[0] for r in results), "".join(r[1] for r in results), max(r[2] for r in results)], sys.stdout)
"""


@pytest.fixture
def mypy() -> Callable[..., tuple[str, str, int]]:
    """Run mypy once for each list of arguments; return both outputs, joined, and the highest exit status.

    In a process of its own: mypy leaves 0.9 GB behind in the one that it runs in.
    """
    tool("mypy")

    def check(*runs: list[str]) -> tuple[str, str, int]:
        done = import_module(PROCESSES).run([sys.executable, "-c", MYPY], stdin=json.dumps(runs), check=True)
        out, err, status = json.loads(done.stdout)
        return out, err, status

    return check


@pytest.fixture(scope="session")
def zsh() -> str:
    """Where zsh is; skips without it, or fails if ROSMINI_REQUIRE_ZSH=1."""
    found = shutil.which("zsh")
    if found is None and required("ZSH"):
        pytest.fail("there is no zsh, and ROSMINI_REQUIRE_ZSH=1", pytrace=False)
    if found is None:
        pytest.skip("there is no zsh")
    return found


@pytest.fixture(scope="session")
def book_html() -> Path:
    """The folder of the built book, which ROSMINI_BOOK names; skips without it."""
    if "ROSMINI_BOOK" not in os.environ:
        pytest.skip("build the book (uv run rosmini book), and set ROSMINI_BOOK=book/_build/html")
    return ROOT / os.environ["ROSMINI_BOOK"]
