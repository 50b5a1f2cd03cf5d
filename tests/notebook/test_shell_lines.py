"""Lines of a shell: their words, and what is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import UsageError
from rosmini.notebook.shell_lines import expand, parse, unquoted


def words(line, **variables):
    (parsed,) = parse(line)
    (command,) = parsed.pipelines[0].commands
    return [expand(word, lambda name: variables.get(name, "")) for word in command.words]


def test_quotation_marks_and_variables():
    line = r"""echo "int64  $num" '$num' a\ b ${num}x "\$num" it's' # a comment"""
    assert words(line.replace("it's'", "''"), num="7") == ["echo", "int64  7", "$num", "a b", "7x", "$num", ""]
    assert words("export NAME=\"two words\"'.'") == ["export", "NAME=two words."]
    assert words("echo a'b'#c;# d") == ["echo", "ab#c"]
    assert words("echo {a: 1} $unknown. 10%") == ["echo", "{a:", "1}", ".", "10%"]


def test_operators():
    (line,) = parse("cd ws && catkin_make | grep built > log; ls || pwd &")
    assert [(each.after, len(each.commands)) for each in line.pipelines] == [("", 1), ("&&", 2), (";", 1), ("||", 1)]
    to = line.pipelines[1].commands[1].to
    assert to is not None
    assert (to.file, to.appends) == ("log", False)


def test_lines_that_go_on_and_lines_that_say_nothing():
    lines = parse("# first\n\nls \\\n   src\npwd   # where")
    assert [(each.number, each.text) for each in lines] == [(3, "ls src"), (5, "pwd   # where")]


def test_a_heredoc_keeps_its_lines():
    first, second = parse("cat > a.py << 'EOF'\nprint('$x')\n\n  # EOF\nEOF\nls")
    command = first.pipelines[0].commands[0]
    assert (command.text, command.text_is_raw) == ("print('$x')\n\n  # EOF\n", True)
    assert second.number == 6
    (open_one,) = parse("cat << END > a\n$x\nEND")
    assert not open_one.pipelines[0].commands[0].text_is_raw


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("ls\necho 'a", r"line 2: the quotation mark in `'a` is not closed"),
        ("cd $(rospack find x)", r"`\(` needs a shell"),
        ('cd "$(rospack find x)"', "needs a shell"),
        ("echo `date`", "needs a shell"),
        ("cat < file", "`<` needs a shell"),
        ("rosrun a b 2> log", "`2>` needs a shell"),
        ("(ls)", r"`\(` needs a shell"),
        ("&& ls", "no command before `&&`"),
        ("ls |", "no command before `the end`"),
        ("ls >", "a word is missing"),
        ("cat > x << EOF\nls", "does not end: add a line that contains only EOF"),
    ],
)
def test_what_is_refused(text, what):
    with pytest.raises(UsageError, match=what):
        parse(text)


@given(st.text())
def test_any_text_is_read_or_refused(text):
    try:
        lines = parse(text)
    except UsageError:
        return
    for line in lines:
        for pipeline in line.pipelines:
            for command in pipeline.commands:
                assert command.words
                assert all(isinstance(unquoted(word), str) for word in command.words)
