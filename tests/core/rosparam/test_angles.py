"""Angles in parameter files: what the real rosparam evaluates, and nothing else."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.rosparam import RosParamException
from rosmini.core.rosparam.documents import degrees, radians


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("rad(2*pi)", 2 * math.pi),
        ("rad( -pi / 4 )", -math.pi / 4),
        ("pi", math.pi),
        ("1.5", 1.5),
        ("(1 + 2) * pi ** 2", 3 * math.pi**2),
        ("7 // 2 + 7 % 2", 4.0),
        ("math.sqrt(2) + math.atan2(1, 1)", math.sqrt(2) + math.pi / 4),
        ("+-1e-3", -0.001),
    ],
)
def test_radians_are_arithmetic(text: str, value: float) -> None:
    assert radians(text) == value
    assert type(radians(text)) is float


@given(st.floats(-720, 720))
def test_degrees_are_numbers(angle: float) -> None:
    assert degrees(f"deg({angle!r})") == angle * math.pi / 180.0 == degrees(f" {angle!r}")


@given(st.floats(-10, 10), st.floats(0.01, 10), st.sampled_from("+-*/"))
def test_arithmetic_is_pythons(left: float, right: float, sign: str) -> None:
    text = f"{left!r} {sign} ({right!r})"
    assert radians(f"rad({text})") == eval(text)


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')", "open('/etc/passwd')", "math.__class__", "().__class__", "'a' * 9", "True",
        "lambda: 0", "math.sqrt(x=2)", "tau", "pi()", "1j", "", "rad(", "2 pi", "1/0", "math.sqrt(-1)", "(-8) ** 0.5",
        "9.0 ** 9 ** 9", "1" + "+1" * 200, "-" * 150, "math.sqrt(1, 2)", "1\x00",
    ],
)  # fmt: skip
def test_what_is_no_arithmetic_is_refused(text: str) -> None:
    with pytest.raises(RosParamException):
        radians(text)


@pytest.mark.parametrize("text", ["deg(ninety)", "deg()", "2*45", "deg(90"])
def test_what_is_no_number_of_degrees_is_refused(text: str) -> None:
    with pytest.raises(RosParamException, match=r"such as deg\(90\)"):
        degrees(text)
