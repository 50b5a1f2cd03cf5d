"""Text is read and written as UTF-8 by name, not in the encoding of a machine's locale (cp1252 on Windows)."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "tests" / "ros" / "scripts"
"""In folders below it are scripts as the public writes them."""


def sources() -> list[Path]:
    """The project's own Python files."""
    found = [path for top in ("rosmini", "assets", "tests", "book") for path in (ROOT / top).rglob("*.py")]
    return sorted(path for path in found if SCRIPTS not in path.parent.parents and "_build" not in path.parts)


def is_text(call: ast.Call, place: int) -> bool:
    """Whether a call of `open`, with its mode at this place, opens text. An odd mode means another `open`."""
    given = {keyword.arg: keyword.value for keyword in call.keywords}
    mode = given.get("mode", call.args[place] if len(call.args) > place else ast.Constant("r"))
    return isinstance(mode, ast.Constant) and isinstance(mode.value, str) and set("rwxat+") >= set(mode.value)


def needs_encoding(call: ast.Call) -> bool:
    """Whether a call reads or writes text in the encoding of the machine's locale."""
    named = {keyword.arg for keyword in call.keywords}
    if named & {"encoding", None}:
        return False
    match call.func:
        case ast.Name("open"):
            return is_text(call, 1) and len(call.args) < 4
        case ast.Attribute(ast.Name("io" | "os"), "open" | "fdopen"):
            return is_text(call, 1) and len(call.args) < 4
        case ast.Attribute(_, "read_text"):
            return not call.args
        case ast.Attribute(_, "write_text"):
            return len(call.args) < 2
        case ast.Attribute(ast.Name("webbrowser" | "Image"), "open"):
            return False
        case ast.Attribute(_, "open"):
            return is_text(call, 0) and len(call.args) < 3
        case ast.Attribute(ast.Name("subprocess"), _):
            return bool(named & {"text", "universal_newlines"})
        case ast.Attribute(_, "TextIOWrapper" | "NamedTemporaryFile" | "TemporaryFile" as name):
            return name == "TextIOWrapper" or ("mode" in named and is_text(call, 0))
    return False


CALLS = re.compile(r"open\(|_text\(|text=|universal_newlines|TextIOWrapper|TemporaryFile")
"""What stands in a line that begins one of these calls."""


def findings(text: str) -> list[int]:
    """The lines whose calls need an encoding."""
    lines = text.splitlines()
    if all(len(CALLS.findall(line)) <= line.count("encoding") for line in lines):
        return []  # parsing takes longer
    tree = ast.parse(text)
    statements = [node.value for node in ast.walk(tree) if isinstance(node, ast.Expr)]
    # What `open` returns and nobody takes is no file.
    others = {each for each in statements if isinstance(each, ast.Call) and ast.unparse(each.func).endswith(".open")}
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and node not in others]
    return [call.lineno for call in calls if needs_encoding(call)]


def test_every_text_file_has_its_encoding():
    found = [
        f"{path.relative_to(ROOT)}:{line}" for path in sources() for line in findings(path.read_text(encoding="utf-8"))
    ]
    assert found == [], "say encoding='utf-8'"


@pytest.mark.parametrize(
    ("code", "seen"),
    [
        ("f = open(p)", True),
        ("f = open(p, 'w')", True),
        ("f = open(p, mode='a+')", True),
        ("open(p, 'rb')", False),
        ("open(p, 'w', encoding='utf-8')", False),
        ("open(p, **options)", False),
        ("f = p.open()", True),
        ("bag.open()", False),
        ("f = p.open('r')", True),
        ("f = p.open('wb')", False),
        ("p.read_text()", True),
        ("p.read_text('utf-8')", False),
        ("p.write_text(t)", True),
        ("p.write_text(t, encoding='utf-8')", False),
        ("f = io.open(p)", True),
        ("f = os.fdopen(p, 'w')", True),
        ("os.fdopen(p, 'wb')", False),
        ("subprocess.run(p, text=True)", True),
        ("subprocess.Popen(p, encoding='utf-8')", False),
        ("subprocess.run(p)", False),
        ("io.TextIOWrapper(p)", True),
        ("tempfile.NamedTemporaryFile(mode='w')", True),
        ("tempfile.NamedTemporaryFile()", False),
        ("Image.open(p)", False),
        ("webbrowser.open(address)", False),
    ],
)
def test_what_the_gate_sees(code, seen):
    assert bool(findings(code)) is seen
