"""Numbers, comparisons, logic and chance."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from rosmini.logo.compiler import Primitive
from rosmini.logo.errors import BadInput, LogoError
from rosmini.logo.turtles import cosine, sine
from rosmini.logo.values import (
    EXACT,
    LogoList,
    Value,
    boolean,
    is_equal,
    number,
    number_in,
    show,
    tidy,
    truth,
    whole,
    word,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.logo.machine import Machine

Number = int | float


def _sum(_: Machine, *values: Value) -> Number:
    total: Number = 0
    for value in values:
        total = tidy(total + number(value))
    return total


def _product(_: Machine, *values: Value) -> Number:
    total: Number = 1
    for value in values:
        total = tidy(total * number(value))
    return total


def _difference(_: Machine, first: Value, second: Value) -> Number:
    return tidy(number(first) - number(second))


def _quotient(_: Machine, first: Value, second: Value) -> Number:
    a, b = number(first), number(second)
    _not_zero(b)
    if isinstance(a, int) and isinstance(b, int) and a % b == 0:
        return a // b
    return tidy(a / b)


def _remainder(_: Machine, first: Value, second: Value) -> Number:
    a, b = number(first), number(second)
    _not_zero(b)
    if isinstance(a, int) and isinstance(b, int):
        return abs(a) % abs(b) * (-1 if a < 0 else 1)
    return math.fmod(a, b)


def _modulo(_: Machine, first: Value, second: Value) -> Number:
    a, b = number(first), number(second)
    _not_zero(b)
    return a % b


def _not_zero(value: Number) -> None:
    if value == 0:
        raise LogoError("nothing can be divided by zero")


def _power(_: Machine, base: Value, exponent: Value) -> Number:
    a, b = number(base), number(exponent)
    if a == 0 and b < 0:
        _not_zero(0)
    if a < 0 and b != int(b):
        raise BadInput(show(exponent), "a whole number, since the base is negative")
    try:
        found = math.pow(a, b)
    except OverflowError:
        found = math.inf
    exact = isinstance(a, int) and isinstance(b, int) and b >= 0 and abs(found) <= EXACT
    return a**b if exact else tidy(found)


def _one(function: Callable[[Number], Number]) -> Callable[[Machine, Value], Number]:
    def act(_: Machine, value: Value) -> Number:
        return tidy(function(number(value)))

    return act


def _positive(
    function: Callable[[Number], Number], wanted: str, least: float
) -> Callable[[Machine, Value], Number]:
    def act(_: Machine, value: Value) -> Number:
        given = number(value)
        if given < least:
            raise BadInput(show(value), wanted)
        return tidy(function(given))

    return act


def _round(value: Number) -> int:
    return math.floor(abs(value) + 0.5) * (-1 if value < 0 else 1)


def _exp(value: Number) -> float:
    return math.exp(value) if value < 710 else math.inf


def _tan(value: Number) -> float:
    if cosine(value) == 0:
        raise BadInput(show(value), "an angle that has a tangent")
    return sine(value) / cosine(value)


def _arctan(_: Machine, *values: Value) -> float:
    if len(values) == 1:
        return math.degrees(math.atan(number(values[0])))
    return math.degrees(math.atan2(number(values[1]), number(values[0])))


def _compare(test: Callable[[Number, Number], bool]) -> Callable[[Machine, Value, Value], str]:
    def act(_: Machine, first: Value, second: Value) -> str:
        return boolean(test(number(first), number(second)))

    return act


def _is_same(machine: Machine, first: Value, second: Value) -> bool:
    """Whether two values are equal; each member of two lists that may be is counted as a step."""
    if isinstance(first, LogoList) and isinstance(second, LogoList) and len(first) == len(second):
        machine.steps += min(first.weight, second.weight)
    return is_equal(first, second)


def _equal(machine: Machine, first: Value, second: Value) -> str:
    return boolean(_is_same(machine, first, second))


def _not_equal(machine: Machine, first: Value, second: Value) -> str:
    return boolean(not _is_same(machine, first, second))


def _before(_: Machine, first: Value, second: Value) -> str:
    return boolean(word(first).lower() < word(second).lower())


def _and(_: Machine, *values: Value) -> str:
    return boolean(sum(truth(value) for value in values) == len(values))


def _or(_: Machine, *values: Value) -> str:
    return boolean(sum(truth(value) for value in values) > 0)


def _not(_: Machine, value: Value) -> str:
    return boolean(not truth(value))


def _random(machine: Machine, *values: Value) -> int:
    if len(values) == 1:
        return int(machine.random.integers(whole(values[0], 1, wanted="a whole number of 1 or more")))
    low, high = (whole(value) for value in values)
    if high < low:
        raise BadInput(show(values[1]), f"a whole number of {low} or more")
    return int(machine.random.integers(low, high + 1))


def _rerandom(machine: Machine, *values: Value) -> None:
    seed = whole(values[0], 0, wanted="a whole number of 0 or more") if values else machine.seed
    machine.random = np.random.default_rng(seed)


def _numberp(_: Machine, value: Value) -> str:
    return boolean(number_in(value) is not None)


def _row(name: str, inputs: str, act: Callable[..., Value | None], text: str, **more: object) -> Primitive:
    return Primitive(name, tuple(inputs.split()), act, text, reports=True, **more)  # type: ignore[arg-type]


ARITHMETIC = (
    _row("sum", "number number", _sum, "adds; also written with +", least=0, most=99),
    _row("difference", "number number", _difference, "subtracts; also written with -"),
    _row("product", "number number", _product, "multiplies; also written with *", least=0, most=99),
    _row("quotient", "number number", _quotient, "divides; also written with /"),
    _row(
        "remainder", "number number", _remainder, "what a division leaves, with the sign of the first number"
    ),
    _row("modulo", "number number", _modulo, "what a division leaves, with the sign of the second number"),
    _row("minus", "number", _one(lambda a: -a), "changes the sign; also written with -"),
    _row("power", "base exponent", _power, "raises to a power"),
    _row("sqrt", "number", _positive(math.sqrt, "a number of 0 or more", 0), "the square root"),
    _row("abs", "number", _one(abs), "the number without its sign"),
    _row("int", "number", _one(math.trunc), "the number without what is behind the point"),
    _row("round", "number", _one(_round), "the nearest whole number"),
    _row("exp", "number", _one(_exp), "e to this power"),
    _row("ln", "number", _positive(math.log, "a number above 0", 5e-324), "the natural logarithm"),
    _row(
        "log10",
        "number",
        _positive(math.log10, "a number above 0", 5e-324),
        "the logarithm to the base of 10",
    ),
    _row("sin", "degrees", _one(sine), "the sine"),
    _row("cos", "degrees", _one(cosine), "the cosine"),
    _row("tan", "degrees", _one(_tan), "the tangent"),
    _row(
        "arctan",
        "number",
        _arctan,
        "the angle of this tangent in degrees; (arctan x y) that of a point",
        most=2,
    ),
    _row("equalp", "thing thing", _equal, "whether both are equal; also written with =", short=("equal?",)),
    _row(
        "notequalp",
        "thing thing",
        _not_equal,
        "whether they differ; also written with <>",
        short=("notequal?",),
    ),
    _row("lessp", "number number", _compare(lambda a, b: a < b), "also written with <", short=("less?",)),
    _row(
        "greaterp", "number number", _compare(lambda a, b: a > b), "also written with >", short=("greater?",)
    ),
    _row(
        "lessequalp",
        "number number",
        _compare(lambda a, b: a <= b),
        "also written with <=",
        short=("lessequal?",),
    ),
    _row(
        "greaterequalp",
        "number number",
        _compare(lambda a, b: a >= b),
        "also written with >=",
        short=("greaterequal?",),
    ),
    _row(
        "beforep", "word word", _before, "whether the first comes first in a dictionary", short=("before?",)
    ),
    _row("numberp", "thing", _numberp, "whether it is a number", short=("number?",)),
    _row("and", "truth truth", _and, "whether all are true", least=0, most=99),
    _row("or", "truth truth", _or, "whether one of them is true", least=0, most=99),
    _row("not", "truth", _not, "the opposite"),
    _row(
        "random",
        "number",
        _random,
        "a whole number from 0 up to below this; (random a b) one from a to b",
        most=2,
    ),
    Primitive("rerandom", (), _rerandom, "begins the random numbers again; (rerandom n) others", most=1),
)
"""Words that reckon."""
