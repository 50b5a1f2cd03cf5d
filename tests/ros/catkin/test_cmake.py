"""The reader of CMakeLists.txt: what it understands, what it refuses, and that nothing from outside harms it."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.ros.catkin.cmake import CMakeError, Variables, parse


def statements(text: str, **values: str) -> list[tuple[str, list[str]]]:
    """Each command outside of blocks, with its arguments."""
    variables = Variables(Path("CMakeLists.txt"), values)
    commands = [each for each in parse(text) if each.block is None]
    return [(each.name, [word.text for word in variables.words(each)]) for each in commands]


def test_comments_quotes_brackets_and_lines() -> None:
    text = (
        '# a comment with ( and "\n'
        "#[[ one over\n several lines ]]\n"
        "Find_Package(catkin REQUIRED # inside\n  COMPONENTS rospy)\n"
        'message("a;b ${x}\\"" [==[raw ${x} ]] \\n]==] plain\\;text -D"q r")\n'
    )
    found = list(parse(text))
    assert [(each.name, each.line) for each in found] == [("find_package", 4), ("message", 6)]
    assert statements(text, x="1")[1] == ("message", ['a;b 1"', "raw ${x} ]] \\n", "plain;text", '-D"q r"'])
    words = [each.text for each in found[1].arguments]
    assert words == ['a;b ${x}\\"', "raw ${x} ]] \\n", "plain\\;text", '-D"q r"']
    assert [each.line for each in found[0].arguments] == [4, 4, 5, 5]


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_line_ends_of_both_kinds_and_a_byte_order_mark(end: str) -> None:
    found = parse(f"\ufeffproject(a){end}message(b){end}")
    assert [(each.name, each.line) for each in found] == [("project", 1), ("message", 2)]


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("project(a\n", 1, r"project\( is never closed"),
        ('\nmessage("a\n', 2, "a quotation mark that is never closed"),
        ("message([[a)", 1, "is never closed; add ]]"),
        ("\n)", 2, "a command is expected here"),
        ("project a", 1, "is followed by 'a', not by"),
        ("if(A)\nmessage(a)", 1, r"if\(\) is never closed; add endif"),
        ("if(A)\nendforeach()", 2, r"closes nothing that is open; if\(\) of line 1 is still open"),
        ("else()", 1, "without an if"),
        ("foreach(a b)\nelse()\nendforeach()", 2, "without an if"),
        ("9a()", 1, "a command is expected here"),
    ],
)
def test_what_is_broken_is_told_with_its_line(text: str, line: int, says: str) -> None:
    with pytest.raises(CMakeError, match=says) as caught:
        list(parse(text))
    assert caught.value.line == line


def test_variables_and_lists() -> None:
    text = """
    project(demo)
    set(x ${PROJECT_NAME}_y)
    set(demo_y 5 CACHE STRING "five")
    list(APPEND files one two)
    list(APPEND files three)
    message(${x} ${${x}} ${files} "${files}" "${nothing}" ${nothing} "$ENV{HOME}")
    """
    words = ["demo_y", "5", "one", "two", "three", "one;two;three", "", ""]
    assert statements(text)[-1] == ("message", words)


def test_commands_in_blocks_name_the_outermost_block() -> None:
    text = "a()\nif(A)\nb()\nforeach(x 1 2)\nc()\nendforeach()\nelse()\nd()\nendif()\nmacro(m)\ne()\nendmacro()\nf()"
    found = [(each.name, each.block and (each.block.name, each.block.line)) for each in parse(text)]
    block = ("if", 2)
    assert found == [("a", None), ("b", block), ("c", block), ("d", block), ("e", ("macro", 10)), ("f", None)]


def test_variables_that_double_are_refused() -> None:
    text = "set(a xxxxxxxxxx)\n" + "set(a ${a}${a}${a}${a}${a}${a}${a}${a})\n" * 20
    with pytest.raises(CMakeError, match="variables have more than"):
        statements(text)


def test_a_variable_that_names_itself_comes_to_an_end() -> None:
    assert statements('message("${a}")', a="${a}") == [("message", ["${a}"])]


PIECES = st.sampled_from(
    ["set", "if", "endif", "foreach", "endforeach", "else", "message", "file", "list", "project", "(", ")", "(", ")",
     " ", "\n", '"', "[[", "]]", "[=[", "#", "#[[", "${", "}", "a", "GLOB", "RANGE", "9", "AND", "NOT", "\\", ";", "**",
     "*", "..", "é", "\0"]
)  # fmt: skip


@given(st.lists(PIECES, max_size=60).map("".join))
def test_any_text_is_read_or_refused(text: str) -> None:
    line: int | None = 1
    try:
        statements(text)
    except CMakeError as error:
        line = error.line
    assert line is not None
    assert 1 <= line <= text.count("\n") + 1
