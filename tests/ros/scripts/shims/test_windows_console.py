"""Keyboard scripts in a simulated Windows console: no ``termios``, and a ``msvcrt`` with keys in it."""

from __future__ import annotations

import io
import sys
from types import ModuleType

import pytest

from rosmini.ros.scripts.shims import terminal


class Console(io.StringIO):
    """Lines for whoever reads them."""

    def isatty(self) -> bool:
        return True


@pytest.fixture
def keys(monkeypatch):
    """The keys that are pressed, on a system without ``termios`` and ``tty``."""
    pressed: list[str] = []
    msvcrt = ModuleType("msvcrt")
    msvcrt.kbhit = lambda: bool(pressed)
    msvcrt.getwch = lambda: pressed.pop(0)
    msvcrt.getch = lambda: pytest.fail("the console's own getch() holds up the graph")
    monkeypatch.setitem(sys.modules, "msvcrt", msvcrt)
    real = terminal._optional
    monkeypatch.setattr(terminal, "_optional", lambda name: None if name in ("termios", "tty") else real(name))
    return pressed


UNIX = """
import select, sys, termios, tty
settings = termios.tcgetattr(sys.stdin)
def get_key():
    tty.setraw(sys.stdin.fileno())
    ready = select.select([sys.stdin], [], [], 0.1)[0]
    key = sys.stdin.read(1) if ready else ''
    termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)
    return key
print([get_key() for _ in range(4)])
print(input('name? '))
"""

WINDOWS = """
import msvcrt, time
found = []
while len(found) < 4:
    found.append(msvcrt.getch().decode() if msvcrt.kbhit() else '')
    time.sleep(0.1)
print(found)
"""


@pytest.mark.parametrize(("source", "lines"), [(UNIX, ["name? Ada"]), (WINDOWS, [])], ids=["termios", "msvcrt"])
def test_keys_of_a_windows_console(run, keys, source, lines):
    keys += ["w", "\x03"]
    ran = run(source, stdin=Console("Ada\n"), prefix=False)
    assert ran.lines == ["['w', '\\x03', '', '']", *lines]


def test_keys_that_were_supplied_reach_msvcrt(run, keys):
    ran = run("import msvcrt\nprint(msvcrt.kbhit(), msvcrt.getch(), msvcrt.getwch())", stdin="ab")
    assert ran.lines == ["[script] True b'a' b"]


def test_without_a_console_the_error_says_what_to_do(run, keys, monkeypatch):
    monkeypatch.delitem(sys.modules, "msvcrt")
    ran = run("try:\n    import termios\nexcept ImportError as error:\n    print(error)", stdin=Console(""))
    assert "No module named 'termios': this terminal has none." in ran.text


def test_there_is_no_msvcrt_elsewhere(run):
    if sys.platform == "win32":
        pytest.skip("there is one on Windows")
    ran = run("try:\n    import msvcrt\nexcept ImportError as error:\n    print(error)")
    assert ran.lines == ["[script] No module named 'msvcrt'"]


def test_typed_text_is_read_in_the_encoding_of_its_stream(run, tmp_path):
    (tmp_path / "typed").write_bytes("Gr\u00fc\u00dfe\n".encode("cp1252"))
    with (tmp_path / "typed").open(encoding="cp1252") as stream:
        ran = run("print(input())", stdin=stream)
    assert ran.lines == ["[script] Gr\u00fc\u00dfe"]
