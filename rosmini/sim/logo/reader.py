"""Reading a program: text becomes lines of words and lists, and these become expressions, in two steps as in Logo.

A list is data until it is run, so the text between brackets is split at spaces only: ``[:a+1]`` has one member. When a
line or a list is run, its words are split further, at operators and parentheses, and parsed. The rules are those
of the UCBLogo manual, "Tokenization", without arrays and backslashes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

from .values import MAX_DEPTH, MAX_SIZE, LogoError, LogoList, Value, number_in, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from .words import Primitive


@dataclass(frozen=True)
class Procedure:
    """A procedure, from `to` to `end`."""

    name: str
    inputs: tuple[str, ...]
    body: tuple[LogoList, ...]
    line: int

    @property
    def usage(self) -> str:
        """The procedure's name with its inputs."""
        return " ".join((self.name, *self.inputs))


_SPLIT = re.compile(
    r"(?P<skip>;[^\n]*|~[ \t]*(?:;[^\n]*)?\n|[^\S\n]+)|(?P<newline>\n)|(?P<open>\[)|(?P<close>\])"
    r"|(?P<word>(?:(?!~[ \t]*(?:;|\n))[^\s\[\];])+|.)"
)
_PARTS = re.compile(
    r'(?P<quoted>"[^()]*)|(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?(?=[()+\-*/=<>]|\Z))'
    r"|(?P<infix><=|>=|<>|[+*/=<>])|(?P<minus>-)|(?P<paren>[()])|(?P<word>[^()+\-*/=<>]+)"
)
_NAME = re.compile(r'[^\s\[\]()+\-*/=<>":;~]+')

# -- text to lines -----------------------------------------------------------------------------------------------------


def read(text: str, first_line: int = 1) -> tuple[dict[str, Procedure], tuple[LogoList, ...]]:
    r"""Return the procedures that a program defines, and all its other lines. Raises ``LogoError``.

    >>> procedures, lines = read("to square :side\n repeat 4 [fd :side rt 90]\nend\nsquare 50")
    >>> procedures["square"].inputs, lines
    (('side',), ([square 50],))
    """
    if len(text) > MAX_SIZE:
        raise LogoError(f"the program has more than {MAX_SIZE} characters")
    procedures: dict[str, Procedure] = {}
    others: list[LogoList] = []
    lines = _lines(text, first_line)
    for line in lines:
        first = _first(line)
        if first == "end":
            raise LogoError("end without a to before it", _line_of(line))
        if first != "to":
            others.append(line)
            continue
        made = _procedure(line, lines)
        if made.name in procedures:
            before = procedures[made.name].line
            raise LogoError(f"{made.name} is already defined, in line {before}", made.line)
        procedures[made.name] = made
    return procedures, tuple(others)


class _Open(NamedTuple):
    """A list whose closing bracket has not been read."""

    line: int
    items: list[Value]
    lines: list[int]

    def add(self, item: Value, line: int) -> None:
        self.items.append(item)
        self.lines.append(line)

    def close(self) -> LogoList:
        return LogoList(self.items, tuple(self.lines))


def _lines(text: str, number: int) -> Iterator[LogoList]:
    """Yield the lines of a text that are not empty. A list may extend over several lines."""
    levels = [_Open(number, [], [])]
    for found in _SPLIT.finditer(text):
        if found["skip"] is not None:
            number += found[0].count("\n")
        elif found["newline"] is not None:
            number += 1
            if len(levels) == 1 and levels[0].items:
                yield levels[0].close()
                levels = [_Open(number, [], [])]
        elif found["open"] is not None:
            if len(levels) > MAX_DEPTH:
                raise LogoError(f"lists are nested more than {MAX_DEPTH} deep", number)
            levels.append(_Open(number, [], []))
        elif found["close"] is not None:
            if len(levels) == 1:
                raise LogoError("a ] without a [ before it", number)
            closed = levels.pop()
            levels[-1].add(closed.close(), closed.line)
        else:
            levels[-1].add(found[0], number)
    if len(levels) > 1:
        raise LogoError("this [ is never closed", levels[-1].line)
    if levels[0].items:
        yield levels[0].close()


def _procedure(title: LogoList, rest: Iterator[LogoList]) -> Procedure:
    line = _line_of(title)
    if len(title) < 2:
        raise LogoError("to needs a name: to square :side", line)
    written = title.items[1]
    if not isinstance(written, str) or not _NAME.fullmatch(written) or number_in(written) is not None:
        raise LogoError(f"{written} cannot be the name of a procedure", line)
    inputs: list[str] = []
    for item in title.items[2:]:
        if not isinstance(item, str) or not item.startswith(":") or not _NAME.fullmatch(item[1:]):
            message = f"to {written}: only inputs such as :side follow the name; instructions begin in the next line"
            raise LogoError(message, line)
        if item[1:].lower() in inputs:
            raise LogoError(f"to {written}: the input {item} appears twice", line)
        inputs.append(item[1:].lower())
    body: list[LogoList] = []
    for each in rest:
        if _first(each) == "end":
            if len(each) > 1:
                raise LogoError("end must be alone in its line", _line_of(each))
            return Procedure(written.lower(), tuple(inputs), tuple(body), line)
        if _first(each) == "to":
            raise LogoError(f"to {written} has no end before the next to, in line {_line_of(each)}", line)
        body.append(each)
    raise LogoError(f"to {written} has no end: write end on a separate line", line)


def _first(line: LogoList) -> str:
    first = line.items[0]
    return first.lower() if isinstance(first, str) else ""


def _line_of(line: LogoList) -> int:
    return line.lines[0] if line.lines else 0


# -- lines to expressions ----------------------------------------------------------------------------------------------


class Token(NamedTuple):
    """A part of an instruction: ``text`` as it was written, and its value if it has one."""

    kind: Literal["value", "variable", "word", "infix", "minus", "sign", "(", ")"]
    """A `sign` is a minus directly before its operand and after a space, so it is not binary."""
    text: str
    line: int
    value: Value = ""


class Constant(NamedTuple):
    """A value that is written in the program."""

    value: Value
    line: int


class Variable(NamedTuple):
    """The value of a variable."""

    name: str
    line: int


class Call(NamedTuple):
    """A call of a primitive or a procedure."""

    word: Primitive | Procedure
    inputs: tuple[Expression, ...]
    text: str
    line: int


Expression: TypeAlias = "Constant | Variable | Call"

_INFIX = {
    "=": ("equalp", 1), "<>": ("notequalp", 1), "<": ("lessp", 1), ">": ("greaterp", 1), "<=": ("lessequalp", 1),
    ">=": ("greaterequalp", 1), "+": ("sum", 2), "-": ("difference", 2), "*": ("product", 3), "/": ("quotient", 3),
}  # fmt: skip
_SIGN = 4
"""A sign binds more strongly than any operator."""


def parse(line: LogoList, primitives: Mapping[str, Primitive], procedures: Mapping[str, Procedure]) -> list[Expression]:
    """Return the instructions of a line or of a list that is run. Raises ``LogoError``."""
    parser = _Parser(line, primitives, procedures)
    found = []
    while parser.next is not None:
        found.append(parser.expression(1, ""))
    return found


def _tokens(line: LogoList) -> Iterator[Token]:
    for i, item in enumerate(line):
        number = line.lines[i] if line.lines else 0
        if isinstance(item, str):
            yield from _tokens_of(item, number)
        else:
            yield Token("value", "", number, item)


def _tokens_of(raw: str, line: int) -> Iterator[Token]:
    for part in _PARTS.finditer(raw):
        text = part[0]
        if part["quoted"] is not None:
            yield Token("value", text, line, text[1:])
        elif part["number"] is not None:
            value = number_in(text)
            if value is None:
                raise LogoError(f"{text} is too large for a number", line)
            yield Token("value", text, line, value)
        elif part["minus"] is not None:
            yield Token("sign" if part.start() == 0 and len(raw) > 1 else "minus", text, line)
        elif part["infix"] is not None:
            yield Token("infix", text, line)
        elif part["paren"] is not None:
            yield Token("(" if text == "(" else ")", text, line)
        elif text.startswith(":"):
            if not _NAME.fullmatch(text[1:]):
                raise LogoError(f"{text} is not a variable: a name must follow the colon", line)
            yield Token("variable", text, line, text[1:].lower())
        else:
            yield Token("word", text, line, text.lower())


class _Parser:
    """A parser by precedence climbing."""

    def __init__(
        self, line: LogoList, primitives: Mapping[str, Primitive], procedures: Mapping[str, Procedure]
    ) -> None:
        self.tokens = list(_tokens(line))
        self.primitives = primitives
        self.procedures = procedures
        self.index = 0
        self.depth = 0

    @property
    def next(self) -> Token | None:
        return self.tokens[self.index] if self.index < len(self.tokens) else None

    def expression(self, strength: int, consumer: str) -> Expression:
        """Parse operands and operators that bind at least this strongly, for the word that takes the value."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            line = self.tokens[self.index - 1].line
            raise LogoError(f"an expression is nested more than {MAX_DEPTH} deep", line)
        found: Expression = self.operand(consumer)
        while (token := self.next) is not None and token.kind in ("infix", "minus"):
            name, own = _INFIX[token.text]
            if own < strength:
                break
            self.index += 1
            left = self.value(found, token.text)
            right = self.value(self.expression(own + 1, token.text), token.text)
            found = Call(self.primitives[name], (left, right), token.text, token.line)
        self.depth -= 1
        return found

    def value(self, found: Expression, consumer: str) -> Expression:
        """Raise ``LogoError`` for the call of a command, which gives no value."""
        if isinstance(found, Call) and not isinstance(found.word, Procedure) and not found.word.gives_value:
            raise self.missing(consumer, f": {found.text} is a command and gives no value", found.line)
        return found

    def operand(self, consumer: str) -> Expression:
        token = self.next
        if token is None or token.kind in (")", "infix"):
            before = f": a value is missing before {token.text}" if token else ""
            raise self.missing(consumer, before, (token or self.tokens[-1]).line)
        self.index += 1
        if token.kind == "value":
            return Constant(token.value, token.line)
        if token.kind == "variable":
            return Variable(str(token.value), token.line)
        if token.kind == "(":
            return self.parentheses(token)
        if token.kind == "word":
            word = self.known(token)
            inputs = [self.value(self.expression(1, token.text), token.text) for _ in word.inputs]
            return Call(word, tuple(inputs), token.text, token.line)
        if self.next is not None and isinstance(self.next.value, int | float):
            self.index += 1
            return Constant(-self.tokens[self.index - 1].value, token.line)  # type: ignore[operator]
        operand = self.value(self.expression(_SIGN, "-"), "-")
        return Call(self.primitives["minus"], (operand,), "-", token.line)

    def parentheses(self, opened: Token) -> Expression:
        found = self.expression(1, "")
        if self.next is None or self.next.kind != ")":
            raise LogoError("this ( is never closed, or encloses more than one value", opened.line)
        self.index += 1
        return found

    def known(self, token: Token) -> Primitive | Procedure:
        name = str(token.value)
        word = self.procedures.get(name) or self.primitives.get(name)
        if word is None:
            if name in ("to", "end"):
                raise LogoError(f"{token.text} is allowed only at the start of a line", token.line)
            guess = suggestion(name, [*self.primitives, *self.procedures])
            raise LogoError(f"I don't know how to {token.text}{guess}", token.line)
        return word

    def missing(self, consumer: str, reason: str, line: int) -> LogoError:
        word = self.procedures.get(consumer.lower()) or self.primitives.get(consumer.lower())
        usage = f" ({word.usage})" if word is not None else ""
        return LogoError(f"not enough inputs to {consumer or 'an instruction'}{usage}{reason}", line)
