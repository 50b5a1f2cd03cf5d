"""The reader of CMakeLists.txt: what it understands, what it refuses, and that nothing from outside harms it."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.ros.catkin.cmake import Block, CMakeError, Command, parse
from rosmini.ros.catkin.evaluation import MOST, Evaluation


def statements(text: str, folder: Path = Path("/nowhere"), **variables: str) -> list[tuple[str, list[str]]]:
    """Each command that is reached, with its arguments."""
    evaluation = Evaluation(folder, variables, folder / "CMakeLists.txt")
    return [(each.name, [word.text for word in each.words]) for each in evaluation.statements(parse(text))]


def said(text: str, **variables: str) -> list[str]:
    """The arguments of each message() that is reached."""
    return [" ".join(words) for name, words in statements(text, **variables) if name == "message"]


def test_comments_quotes_brackets_and_lines() -> None:
    text = (
        '# a comment with ( and "\n'
        "#[[ one over\n several lines ]]\n"
        "Find_Package(catkin REQUIRED # inside\n  COMPONENTS rospy)\n"
        'message("a;b ${x}\\"" [==[raw ${x} ]] \\n]==] plain\\;text -D"q r")\n'
    )
    found = parse(text)
    assert [(each.name, each.line) for each in found if isinstance(each, Command)] == [
        ("find_package", 4),
        ("message", 6),
    ]
    assert statements(text, x="1")[1] == ("message", ['a;b 1"', "raw ${x} ]] \\n", "plain;text", '-D"q r"'])
    words = [each.text for each in found[1].arguments]
    assert words == ['a;b ${x}\\"', "raw ${x} ]] \\n", "plain\\;text", '-D"q r"']
    assert [each.line for each in found[0].arguments] == [4, 4, 5, 5]


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_line_ends_of_both_kinds_and_a_byte_order_mark(end: str) -> None:
    found = parse(f"\ufeffproject(a){end}message(b){end}")
    assert [(each.name, each.line) for each in found if isinstance(each, Command)] == [
        ("project", 1),
        ("message", 2),
    ]


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
        ("if(A)\n" * 60, 51, "more than 50 blocks"),
    ],
)
def test_what_is_broken_is_told_with_its_line(text: str, line: int, says: str) -> None:
    with pytest.raises(CMakeError, match=says) as caught:
        parse(text)
    assert caught.value.line == line


def test_variables_lists_and_files(tmp_path: Path) -> None:
    (tmp_path / "msg").mkdir()
    for name in ("B.msg", "A.msg", "c.txt"):
        (tmp_path / "msg" / name).touch()
    text = """
    project(demo)
    set(x ${PROJECT_NAME}_y)
    set(demo_y 5)
    list(APPEND files one two)
    list(APPEND files three)
    list(REMOVE_ITEM files two)
    file(GLOB found RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/msg msg/*.msg)
    file(GLOB outside ../*)
    message(${x} ${${x}} ${files} "${files}" ${found} "${outside}" "${nothing}" ${nothing} "$ENV{HOME}")
    """
    found = statements(text, tmp_path, CMAKE_CURRENT_SOURCE_DIR=str(tmp_path))
    assert found[-1] == (
        "message",
        ["demo_y", "5", "one", "three", "one;three", "A.msg", "B.msg", "", "", ""],
    )


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("TRUE", True), ("OFF", False), ("YES", True), ("x-NOTFOUND", False), ("on", True), ("off", False),
        ("empty", False), ("one", True), ("NOT one", False), ("NOT NOT one", True), ("", False),
        ("one AND off", False), ("one OR off", True), ("(off OR one) AND NOT (off)", True),
        ("DEFINED one", True), ("DEFINED two", False), ('"${word}" STREQUAL "abc"', True), ("word STREQUAL abc", True),
        ("3 LESS 4", True), ("3 GREATER 4", False), ("x EQUAL 3", False), ("1.10 VERSION_GREATER 1.9", True),
        ("TARGET one", False), ('abc MATCHES "(a+)+$"', False), ("b IN_LIST list", True), ("EXISTS /etc", False),
    ],
)  # fmt: skip
def test_conditions(condition: str, holds: bool) -> None:
    text = f"if({condition})\nmessage(yes)\nelseif(FALSE)\nmessage(never)\nelse()\nmessage(no)\nendif()"
    given = {"one": "1", "empty": "", "word": "abc", "list": "a;b", "off": "OFF"}
    assert said(text, **given) == ["yes" if holds else "no"]


def test_loops_and_what_is_passed_over() -> None:
    assert said("foreach(a x y)\nmessage(${a})\nendforeach()") == ["x", "y"]
    assert said("foreach(a IN LISTS l ITEMS z)\nmessage(${a})\nendforeach()", l="x;y") == ["x", "y", "z"]
    assert said("foreach(a RANGE 2)\nmessage(${a})\nendforeach()") == ["0", "1", "2"]
    assert said("foreach(a RANGE 5 1 2)\nmessage(${a})\nendforeach()") == ["5", "3", "1"]
    text = "macro(Mine a)\nmessage(never)\nendmacro()\nwhile(1)\nmessage(never)\nendwhile()\nmine(1)\n"
    text += "message(b)\nreturn()\nmessage(c)"
    evaluation = Evaluation(Path("/nowhere"), {}, Path("CMakeLists.txt"))
    assert [each.words[0].text for each in evaluation.statements(parse(text))] == ["b"]
    assert [(note.line, note.text.partition(" ")[0]) for note in evaluation.passed_over] == [
        (4, "while()"),
        (7, "mine()"),
    ]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("set(a xxxxxxxxxx)\n" + "set(a ${a}${a}${a}${a}${a}${a}${a}${a})\n" * 20, "a value of more than"),
        ("foreach(a RANGE 9999999)\nendforeach()", "a loop of more than"),
        (
            "foreach(a RANGE 999)\nforeach(b RANGE 999)\nmessage(x)\nendforeach()\nendforeach()",
            f"more than {MOST} commands",
        ),
        ("foreach(a RANGE x)\nendforeach()", "needs whole numbers"),
        ("foreach(a RANGE 1 9 0)\nendforeach()", "needs whole numbers"),
        ("foreach()\nendforeach()", "needs a variable"),
        ("if(" + "( " * 60 + ")" * 60 + ")\nendif()", "nested too deeply"),
        ("if(a b)\nendif()", "does not understand 'b'"),
        ('if("(" a)\nendif()', "is not closed"),
    ],
)
def test_what_would_not_end_is_refused(text: str, says: str) -> None:
    with pytest.raises(CMakeError, match=says):
        statements(text)


def test_a_variable_that_names_itself_comes_to_an_end() -> None:
    assert said('message("${a}")', a="${a}") == ["${a}"]


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


@given(
    st.lists(
        st.lists(st.text(max_size=8).filter(lambda text: "]===]" not in text + "]"), max_size=4), max_size=5
    )
)
def test_what_is_written_in_brackets_is_read_back(commands: list[list[str]]) -> None:
    def bracket(word: str) -> str:
        return f"[===[\n{word}]===]"

    lines = [f"m{number}({' '.join(map(bracket, words))})" for number, words in enumerate(commands)]
    text = "\n".join(lines)
    assert statements(text) == [(f"m{number}", words) for number, words in enumerate(commands)]


@given(
    st.lists(
        st.text(st.characters(exclude_characters='"\\$', exclude_categories=["Cs"]), max_size=12), max_size=6
    )
)
def test_what_is_quoted_is_read_back(words: list[str]) -> None:
    assert statements("m(" + " ".join(f'"{word}"' for word in words) + ")") == [("m", words)]


def test_blocks_keep_their_parts() -> None:
    (block,) = parse("if(A)\na()\nelseif(B)\nelse()\nb()\nc()\nendif()")
    assert isinstance(block, Block)
    assert [(opening.name, len(body)) for opening, body in block.parts] == [
        ("if", 1),
        ("elseif", 0),
        ("else", 2),
    ]
