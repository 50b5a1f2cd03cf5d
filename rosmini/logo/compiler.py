"""From the tokens of a line, or of a list that is run, to instructions for the machine.

How much a word takes depends on the procedures that are known when it is run, so a list is compiled when it is first
run, and again when procedures have changed.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from .absent import advice
from .errors import LogoError, suggestion
from .reader import Token, tokens
from .values import DEEPEST, LogoList, Value, show

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


class Op(IntEnum):
    """What an instruction does; the operand stack holds None where a procedure gave no value."""

    PUSH = 0
    """Push a value."""
    LOAD = 1
    """Push what a name stands for."""
    REPORT = 2
    """Take inputs, push what a primitive reports."""
    COMMAND = 3
    """Take inputs, do what a primitive does, push nothing."""
    CONTROL = 4
    """Take inputs, and let a primitive enter or leave frames."""
    CALL = 5
    """Take inputs, and enter a procedure."""
    DISCARD = 6
    """Take what is left of an instruction, which must be no value."""
    NEED = 7
    """Require that what was called last gave a value."""


Instruction: TypeAlias = tuple[Op, Any, Any, int]
"""What to do, with what, with how many inputs or for whom, and the line."""

Code: TypeAlias = tuple[Instruction, ...]


@dataclass(frozen=True)
class Primitive:
    """A word that Logo knows by itself.

    ``inputs`` are the names of its inputs, ``act`` is called with the machine and their values. In parentheses it takes
    ``least`` to ``most`` inputs. A ``reports`` returns a value, a ``controls`` changes the machine's frames.
    """

    name: str
    inputs: tuple[str, ...]
    act: Callable[..., Any]
    help: str
    short: tuple[str, ...] = ()
    reports: bool = False
    controls: bool = False
    least: int = field(default=-1)
    most: int = field(default=-1)

    def __post_init__(self) -> None:
        for bound in ("least", "most"):
            if getattr(self, bound) < 0:
                object.__setattr__(self, bound, len(self.inputs))

    @property
    def usage(self) -> str:
        """How it is written: ``forward distance``."""
        return " ".join((self.name, *self.inputs))


@dataclass
class Procedure:
    """A procedure of a program."""

    name: str
    inputs: tuple[str, ...]
    body: tuple[LogoList, ...]
    line: int
    cache: Any = field(default=None, repr=False, compare=False)
    """Its instructions, and the words that they were made with."""


class Words(NamedTuple):
    """The words that are known: primitives by all their names, and procedures."""

    primitives: Mapping[str, Primitive]
    procedures: Mapping[str, Procedure]

    def unknown(self, token: Token) -> LogoError:
        """The error for a word that is none of them."""
        if token.value in ("to", "end"):
            return LogoError(
                f"{token.text} stands only at the start of a line, outside of brackets", token.line
            )
        known = [*self.primitives, *self.procedures]
        guess = advice(token.text, known) or suggestion(str(token.value), known)
        return LogoError(f"I don't know how to {token.text}{guess}", token.line)


_INFIX = {
    "=": ("equalp", 1), "<>": ("notequalp", 1), "<": ("lessp", 1), ">": ("greaterp", 1), "<=": ("lessequalp", 1),
    ">=": ("greaterequalp", 1), "+": ("sum", 2), "-": ("difference", 2), "*": ("product", 3), "/": ("quotient", 3),
}  # fmt: skip

_VALUE, _COMMAND = object(), object()


def compile_body(body: tuple[LogoList, ...], words: Words) -> Code:
    """The instructions of lines, each of which leaves nothing. Raises ``LogoError``."""
    code: list[Instruction] = []
    for line in body:
        code += _Compiler(tokens(line), words).lines()
    return tuple(code)


def compile_block(block: LogoList, words: Words) -> Code:
    """The instructions of a list, which leave one value or None. Raises ``LogoError``."""
    return tuple(_Compiler(tokens(block), words).block())


def compile_values(values: LogoList, words: Words) -> tuple[Code, int]:
    """The instructions of a list of expressions, and how many values they leave. Raises ``LogoError``."""
    compiler = _Compiler(tokens(values), words)
    count = 0
    while compiler.next is not None:
        compiler.input("for")
        count += 1
    return tuple(compiler.code), count


class _Compiler:
    """A parser by precedence climbing, which writes instructions as it goes."""

    def __init__(self, line: list[Token], words: Words) -> None:
        self.line = line
        self.words = words
        self.at = 0
        self.depth = 0
        self.code: list[Instruction] = []

    @property
    def next(self) -> Token | None:
        return self.line[self.at] if self.at < len(self.line) else None

    def lines(self) -> list[Instruction]:
        while self.next is not None:
            self.finish(self.next, self.expression(1, ""))
        return self.code

    def block(self) -> list[Instruction]:
        kind: Any = _COMMAND
        last: Token | None = None
        while self.next is not None:
            if last is not None:
                self.finish(last, kind)
            last = self.next
            kind = self.expression(1, "")
        if kind is _COMMAND:
            self.code.append((Op.PUSH, None, None, 0))
        return self.code

    def finish(self, first: Token, kind: Any) -> None:
        if kind is not _COMMAND:
            self.code.append((Op.DISCARD, None, None, first.line))

    def input(self, consumer: str) -> None:
        """An expression whose value is needed."""
        self.need(self.expression(1, consumer), consumer)

    def need(self, kind: Any, consumer: str) -> None:
        if kind is _COMMAND:
            raise LogoError(
                f"what comes before or after {consumer} is a command and gives no value",
                self.line[self.at - 1].line,
            )
        if isinstance(kind, Token) and consumer not in ("output", "op"):  # which sees for itself
            self.code.append((Op.NEED, kind.text, consumer, kind.line))

    def expression(self, level: int, consumer: str) -> Any:
        """Parse operands and operators that bind at least as strongly as ``level``; return what they leave."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise LogoError(f"an expression is nested more than {DEEPEST} deep", self.line[self.at].line)
        kind = self.operand(consumer)
        while (token := self.next) is not None and token.kind in ("infix", "minus"):
            name, strength = _INFIX[token.text]
            if strength < level:
                break
            self.need(kind, token.text)
            self.at += 1
            self.need(self.expression(strength + 1, token.text), token.text)
            self.code.append((Op.REPORT, self.words.primitives[name], 2, token.line))
            kind = _VALUE
        self.depth -= 1
        return kind

    def operand(self, consumer: str) -> Any:
        token = self.next
        if token is None:
            line = self.line[-1].line if self.line else 0
            raise LogoError(f"not enough inputs to {consumer}{self.usage(consumer)}", line)
        self.at += 1
        if token.kind == "value":
            self.code.append((Op.PUSH, token.value, None, token.line))
        elif token.kind == "thing":
            self.code.append((Op.LOAD, token.value, None, token.line))
        elif token.kind in ("negative", "minus"):
            self.minus(token)
        elif token.kind == "(":
            return self.parentheses(token)
        elif token.kind == "word":
            return self.call(token, consumer)
        else:
            what = f"not enough inputs to {consumer}{self.usage(consumer)}: " if consumer else ""
            raise LogoError(f"{what}a value is missing before {token.text}", token.line)
        return _VALUE

    def minus(self, token: Token) -> None:
        after = self.next
        if after is not None and after.kind == "value" and isinstance(after.value, int | float):
            self.at += 1
            self.code.append((Op.PUSH, -after.value, None, token.line))
        else:
            self.need(self.expression(4, "-"), "-")
            self.code.append((Op.REPORT, self.words.primitives["minus"], 1, token.line))

    def call(self, token: Token, consumer: str) -> Any:
        """A word with as many inputs as it has by default."""
        inputs = self.inputs_of(token)
        primitive = self.words.primitives.get(str(token.value))
        if consumer and primitive is not None and not primitive.reports and not primitive.controls:
            raise LogoError(
                f"not enough inputs to {consumer}{self.usage(consumer)}: {token.text}, which comes next, is a "
                "command and gives no value",
                token.line,
            )
        for _ in inputs:
            self.input(token.text)
        return self.invoke(token, len(inputs))

    def parentheses(self, opened: Token) -> Any:
        """An expression in parentheses, or a word with as many inputs as there are."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise LogoError(f"parentheses are nested more than {DEEPEST} deep", opened.line)
        token = self.next
        kind = self.greedy(token) if token is not None and token.kind == "word" else None
        if kind is None:
            kind = self.expression(1, "")
        if self.next is None or self.next.kind != ")":
            raise LogoError("too much inside ()", opened.line)
        self.at += 1
        self.depth -= 1
        return kind

    def greedy(self, token: Token) -> Any:
        """A call with all inputs up to the parenthesis, or None if an operator comes first."""
        inputs = self.inputs_of(token)
        following = self.line[self.at + 1] if self.at + 1 < len(self.line) else None
        if following is not None and following.kind in ("infix", "minus") and not inputs:
            return None
        self.at += 1
        count = 0
        while self.next is not None and self.next.kind != ")":
            self.input(token.text)
            count += 1
        primitive = self.words.primitives.get(str(token.value))
        least, most = (len(inputs),) * 2 if primitive is None else (primitive.least, primitive.most)
        if count < least:
            raise LogoError(f"not enough inputs to {token.text}{self.usage(token.text)}", token.line)
        if count > most:
            raise LogoError(f"too much inside (): {token.text} takes {most} inputs, not {count}", token.line)
        return self.invoke(token, count)

    def invoke(self, token: Token, count: int) -> Any:
        primitive = self.words.primitives.get(str(token.value))
        if primitive is None:
            self.code.append((Op.CALL, token.value, count, token.line))
            return token
        op = Op.CONTROL if primitive.controls else Op.REPORT if primitive.reports else Op.COMMAND
        self.code.append((op, primitive, count, token.line))
        return token if primitive.controls else _VALUE if primitive.reports else _COMMAND

    def inputs_of(self, token: Token) -> tuple[str, ...]:
        name = str(token.value)
        known = self.words.procedures.get(name) or self.words.primitives.get(name)
        if known is None:
            raise self.words.unknown(token)
        return known.inputs

    def usage(self, name: str) -> str:
        known = self.words.procedures.get(name.lower()) or self.words.primitives.get(name.lower())
        return "" if known is None or not known.inputs else f" ({' '.join((known.name, *known.inputs))})"


def described(value: Value | None) -> str:
    """A value for an error message: not too long."""
    if value is None:
        return "nothing"
    text = show(value)
    return text if len(text) <= 60 else text[:57] + "..."
