"""How cells are coloured in the book: the body of `%%node` is Python, of `%%launch` XML, of `%%terminal` a shell's."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from ipython_pygments_lexers import IPython3Lexer
from pygments.lexer import Lexer
from pygments.lexers.html import XmlLexer
from pygments.lexers.python import PythonLexer
from pygments.lexers.shell import BashLexer
from pygments.lexers.special import TextLexer
from pygments.token import Keyword, Operator, Text

if TYPE_CHECKING:
    from collections.abc import Iterator

BODIES: dict[str, Any] = {
    "node": PythonLexer,
    "launch": XmlLexer,
    "terminal": BashLexer,
    "msg": TextLexer,
    "srv": TextLexer,
    "action": TextLexer,
}
"""The lexers of what is below the line of a magic."""

_MAGIC = re.compile(rf"\A(%%)({'|'.join(BODIES)})\b([^\n]*\n?)")


class CellLexer(Lexer):  # type: ignore[misc]  # pygments is untyped
    """Colours a cell of a notebook."""

    name = "A cell of a notebook with rosmini"
    aliases = ("rosmini-cell",)

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._options = options

    def get_tokens_unprocessed(self, text: str) -> Iterator[tuple[int, Any, str]]:
        """Yield where each token begins, its kind and its text."""
        magic = _MAGIC.match(text)
        if magic is None:
            yield from IPython3Lexer(**self._options).get_tokens_unprocessed(text)
            return
        for group, kind in ((1, Operator), (2, Keyword), (3, Text)):
            yield magic.start(group), kind, magic[group]
        body = BODIES[magic[2]](**self._options)
        for at, token, value in body.get_tokens_unprocessed(text[magic.end() :]):
            yield magic.end() + at, token, value
