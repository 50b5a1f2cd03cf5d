"""What belongs to one script stays with it, and nothing reaches the host."""

import pytest

from rosmini.ros.scripts import ScriptSpec, run_scripts


def test_modules_of_the_same_name_keep_apart(run, tmp_path):
    node = """
    import time
    import helper
    from pack.inner import deep
    time.sleep(0.002)
    def later():
        import lazy
        import importlib
        return lazy.WHO, importlib.import_module("pack.inner.deep").WHO, importlib.import_module("helper") is helper
    time.sleep(0.002)
    helper.bump()
    print(helper.WHO, helper.COUNT, deep.WHO, deep.up(), *later())
    """
    specs = []
    for who in ("one", "two"):
        folder = tmp_path / who
        run.file(folder, "helper.py", f"WHO = {who!r}\nCOUNT = 0\ndef bump():\n    global COUNT\n    COUNT += 1\n")
        run.file(folder, "lazy.py", f"from helper import WHO\nassert WHO == {who!r}\n")
        run.file(folder, "pack/__init__.py", "from . import inner\nfrom .inner.deep import WHO\n")
        run.file(folder, "pack/inner/__init__.py", "")
        run.file(
            folder,
            "pack/inner/deep.py",
            "from .. import inner\nfrom helper import WHO\ndef up():\n    from .. import inner as again\n    return "
            "again is inner\n",
        )
        specs.append(run.file(folder, f"{who}.py", node))
    assert sorted(run(*specs).lines) == ["[one] one 1 one True one one True", "[two] two 1 two True two two True"]


def test_import_forms(run, tmp_path):
    run.file(tmp_path, "mod.py", "__all__ = ['a']\na, b = 1, 2\n")
    run.file(tmp_path, "pkg/__init__.py", "__all__ = ['x']\n")
    run.file(tmp_path, "pkg/x.py", "name = __name__\n")
    run.file(tmp_path, "space/y.py", "name = __name__\n")
    spec = run.file(
        tmp_path,
        "node.py",
        """
        import os.path, xml.dom.minidom, concurrent.futures.thread, logging.handlers
        from mod import *
        from pkg import *
        import pkg.x as px, space.y, mod as m
        print(a, 'b' in dir(), x.name, px is x, space.y.name, m.b, __import__('pkg.x').x is x)
        print(os.path.sep == os.sep, xml.dom.minidom.__name__, logging.handlers.__name__)
        for text in ('import nope', 'from mod import nope', 'import pkg.nope', 'import mod.nope', 'from . import mod'):
            try:
                exec(text)
            except ImportError as error:
                print(type(error).__name__)
        """,
    )
    assert run(spec, prefix=False).lines == [
        "1 False pkg.x True space.y 2 True", "True xml.dom.minidom logging.handlers", "ModuleNotFoundError",
        "ImportError", "ModuleNotFoundError", "ModuleNotFoundError", "ImportError",
    ]  # fmt: skip


def test_folders_added_to_the_path(run, tmp_path):
    run.file(tmp_path / "lib", "extra.py", "value = 7\n")
    run.file(tmp_path / "src", "deep.py", "value = 8\n")
    spec = run.file(
        tmp_path / "scripts",
        "node.py",
        "import os, sys\nsys.path.append(os.path.join(os.path.dirname(__file__), '..', 'lib'))\n"
        "import extra, deep\nprint(extra.value, deep.value, sys.path[0] == os.path.dirname(__file__))\n",
    )
    assert run(spec, folders=[str(tmp_path / "src")]).lines == ["[node] 7 8 True"]


def test_a_broken_module_beside_a_script(sim, tmp_path):
    sim.file(tmp_path, "old.py", "x = 1\nprint x\n")
    ran = sim(sim.file(tmp_path, "node.py", "import old\n"))
    assert ran.status == 1
    assert "old.py, line 2: this is Python 2" in ran.text
    assert 'node.py", line 1' in ran.text


def test_a_module_that_fails_can_be_tried_again(sim, tmp_path):
    sim.file(tmp_path, "flaky.py", "import __main__\n__main__.n += 1\nassert __main__.n > 1\nok = True\n")
    spec = sim.file(
        tmp_path,
        "node.py",
        "n = 0\ntry:\n    import flaky\nexcept AssertionError:\n    import flaky\nprint(flaky.ok, n)\n",
    )
    assert sim(spec).lines == ["[node] True 2"]


def test_random_is_the_scripts_own(run):
    import random

    import numpy as np

    host = random.Random(5)
    legacy = np.random.RandomState(5)
    expected = [host.random() for _ in range(3)]
    state = np.random.get_state()[1].tolist()
    source = """
    import random, time, numpy as np
    from numpy.random import rand
    random.seed({0}); np.random.seed({0})
    out = []
    for _ in range(3):
        out.append(random.random())
        time.sleep(0.001)
        out.append(np.random.normal())
        np.random.mtrand.seed
    print(out, rand() >= 0)
    """
    alone = run(source.format(5)).lines[0]
    both = run(run.text("script", source.format(5)), run.text("other", source.format(6))).lines
    assert alone in both
    assert alone.startswith(f"[script] [{expected[0]}, {legacy.normal()}, {expected[1]}, {legacy.normal()}")
    assert np.random.get_state()[1].tolist() == state


def test_logging_is_the_scripts_own(run):
    a = """
    import logging, time
    logging.basicConfig(level=logging.DEBUG, format="A %(name)s %(message)s")
    time.sleep(0.002)
    logging.getLogger("x").debug("hello")
    logging.config = None
    """
    b = """
    import logging, logging.config, sys, time
    handler = {"class": "logging.StreamHandler", "stream": "ext://sys.stdout"}
    logging.config.dictConfig({"version": 1, "handlers": {"h": handler},
                               "root": {"level": "WARNING", "handlers": ["h"]}})
    time.sleep(0.004)
    logging.getLogger("x").debug("not shown")
    logging.warning("shown")
    """
    assert run(run.text("a", a), run.text("b", b)).lines == ["[a] A x hello", "[b] shown"]


def test_environment(run, monkeypatch):
    monkeypatch.setenv("ROSMINI_TEST", "host")
    source = """
    import os, subprocess, sys, time
    os.environ["ROSMINI_TEST"] = "{0}"
    os.environ.setdefault("ROSMINI_NEW", "{0}")
    del os.environ["PATH"]
    time.sleep(0.002)
    print(os.environ["ROSMINI_TEST"], os.getenv("ROSMINI_NEW"), "PATH" in os.environ)
    """
    assert run(run.text("a", source.format("one")), run.text("b", source.format("two"))).lines == [
        "[a] one one False",
        "[b] two two False",
    ]


def test_warnings_streams_and_builtins(run):
    a = """
    import builtins, sys, time, warnings
    warnings.simplefilter("error")
    builtins.shared = 1
    sys.stdout = open(__import__("os").devnull, "w")
    sys.argv.append("x")
    sys.tracebacklimit = 0
    time.sleep(0.002)
    print("unseen", file=sys.stdout)
    sys.stdout.close()
    sys.stdout = sys.__stdout__ = None
    sys.stderr.write(f"{shared} {sys.argv[1:]}\\n")
    """
    b = """
    import sys, time, warnings
    warnings.simplefilter("ignore")
    time.sleep(0.004)
    warnings.warn("quiet")
    try:
        shared
    except NameError:
        print("mine", sys.argv[1:], hasattr(sys, "tracebacklimit"))
    """
    assert run(run.text("a", a), run.text("b", b)).lines == ["[a] 1 ['x']", "[b] mine [] False"]


def test_redirected_output_and_pickles(run, tmp_path):
    run.file(tmp_path, "shapes.py", "class Point:\n    def __init__(self, x):\n        self.x = x\n")
    spec = run.file(
        tmp_path,
        "node.py",
        """
        import contextlib, copy, inspect, io, pickle, time
        from dataclasses import dataclass
        from shapes import Point
        @dataclass
        class Mine:
            x: 'int'
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            print("inside")
            time.sleep(0.02)
            print("still")
        print(repr(text.getvalue()))
        copied = [pickle.loads(pickle.dumps(each)) for each in (Point(3), Mine(4))]
        print(copied[0].x, copied[1], inspect.getsource(Point).split(':')[0])
        """,
    )
    assert run(spec, run.text("b", "import time\ntime.sleep(0.0005)\nprint('out')")).lines == [
        "[b] out",
        "[node] 'inside\\nstill\\n'",
        "[node] 3 Mine(x=4) class Point",
    ]


def test_atexit_runs_last_in_first_out(run):
    ran = run(
        """
        import atexit, sys
        atexit.register(print, "first")
        @atexit.register
        def broken():
            raise ValueError("in atexit")
        def never(): print("never")
        atexit.register(never); atexit.unregister(never)
        atexit.register(print, "last", end="!\\n")
        sys.exit(2)
        """
    )
    assert ran.lines[0] == "[script] last!"
    assert ran.lines[-1] == "[script] first"
    assert "ValueError: in atexit" in ran.text
    assert ran.status == 2


def test_signal_handlers(run):
    ran = run(
        """
        import signal, time
        def handle(number, frame):
            print("got", signal.Signals(number).name)
        print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)
        print(signal.signal(signal.SIGTERM, handle) is signal.SIG_DFL, signal.getsignal(signal.SIGTERM) is handle)
        signal.raise_signal(signal.SIGTERM)
        try:
            signal.signal(signal.SIGTERM, "no")
        except TypeError as error:
            print("TypeError")
        """
    )
    assert [line.removeprefix("[script] ") for line in ran.lines] == ["True", "True True", "got SIGTERM", "TypeError"]


def test_alarm(sim):
    signal = pytest.importorskip("signal")
    if not hasattr(signal, "SIGALRM"):
        pytest.skip("no alarm on this system")
    ran = sim(
        """
        import signal, time
        class Late(Exception): pass
        def late(n, f): raise Late
        signal.signal(signal.SIGALRM, late)
        signal.alarm(2)
        try:
            time.sleep(10)
        except Late:
            print("late at", time.monotonic())
        signal.alarm(5); print(signal.alarm(0))
        """
    )
    assert ran.lines == ["[script] late at 2.0", "[script] 5"]


def test_clocks_follow_simulated_time(sim):
    ran = sim(
        """
        import time, datetime
        from datetime import date, datetime as dt, timedelta
        t, m, p, n = time.time(), time.monotonic(), time.perf_counter(), time.time_ns()
        d = dt.now()
        time.sleep(90)
        print(time.time() - t, time.monotonic() - m, time.perf_counter() - p, time.time_ns() - n)
        in_utc = dt.now(datetime.timezone.utc).timestamp()
        print((dt.now() - d).total_seconds(), in_utc == time.time(), isinstance(d, dt))
        print(time.gmtime() == time.gmtime(time.time()), time.strftime("%Y", time.gmtime()), dt.utcnow().isoformat())
        print(isinstance(d + timedelta(1), date), date.today().year, issubclass(dt, date), repr(dt(2020, 1, 2)))
        class A:
            clock = time.time
        print(A().clock() == time.time())
        import pickle
        print(pickle.loads(pickle.dumps(dt.utcnow())) == dt.utcnow())
        """,
        prefix=False,
    )
    assert ran.lines == [
        "90.0 90.0 90.0 90000000000",
        "90.0 True True",
        "True 1970 1970-01-01T00:18:10",
        "True 1970 True datetime.datetime(2020, 1, 2, 0, 0)",
        "True",
        "True",
    ]


@pytest.mark.parametrize(("line", "hinted"), [("x = input()", True), ("x = str(input())", False)])
def test_numbers_that_python_2_read_from_input(tmp_path, capsys, line, hinted):
    script = tmp_path / "goal.py"
    script.write_text(f"{line}\nabs(x)\n", encoding="utf-8")
    assert run_scripts([ScriptSpec(str(script))], stdin="5\n", prefix=False).status == 1
    assert ("float(input(" in capsys.readouterr().err) is hinted
