"""Colours of cells: what is below the line of a magic is coloured as what it is."""

from __future__ import annotations

import pytest

pytest.importorskip("sphinx")

from pygments.lexers import PythonLexer
from pygments.token import Token

from book.tools.lexer import BODIES, CellLexer


def tokens(text: str) -> list[tuple[object, str]]:
    return [pair for pair in CellLexer().get_tokens(text) if pair[1].strip()]


@pytest.mark.parametrize(
    ("cell", "token"),
    [
        ("%%node talker.py\nimport rospy\n", (Token.Keyword.Namespace, "import")),
        ('%%launch a.launch\n<launch>\n  <node pkg="a"/>\n</launch>', (Token.Name.Tag, "<launch")),
        ("%%terminal --new\necho 'a b'\n", (Token.Name.Builtin, "echo")),
        ("%load_ext rosmini\nimport rospy\n", (Token.Keyword.Namespace, "import")),
    ],
)
def test_what_a_body_is(cell: str, token: tuple[object, str]) -> None:
    assert token in tokens(cell)


def test_the_line_of_the_magic_is_one() -> None:
    assert tokens("%%node talker.py _rate:=5\nx = 1\n")[:3] == [
        (Token.Operator, "%%"),
        (Token.Keyword, "node"),
        (Token.Text, " talker.py _rate:=5\n"),
    ]


def test_python_stays_what_it_was() -> None:
    text = "def f(a: int) -> str:\n    return f'{a % 2}'\n"
    assert list(CellLexer().get_tokens(text)) == list(PythonLexer().get_tokens(text))


@pytest.mark.parametrize("name", BODIES)
def test_nothing_of_a_cell_is_lost(name: str) -> None:
    for text in (f"%%{name} a\n# x\ny: 1 <b/>\n", f"%%{name}\n", f"%%{name}s\nx\n"):
        found = list(CellLexer(ensurenl=False, stripnl=False).get_tokens_unprocessed(text))
        assert "".join(value for _, _, value in found) == text
        assert all(text.startswith(value, at) for at, _, value in found)
