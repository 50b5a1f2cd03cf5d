"""Lines of cells: what is replaced in them, what is refused, and the table behind them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from rosmini import Graph, set_default_graph
from rosmini.core.errors import UsageError
from rosmini.core.verbs import VerbError
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools import magics
from rosmini.tools.main import COMMANDS


@pytest.fixture
def shell() -> Iterator[Any]:
    with Graph() as graph:
        before = set_default_graph(graph)
        yield SimpleNamespace(
            user_ns={"topic": "/chatter", "text": "two words", "n": 3}, execution_count=1, graph=graph
        )
        set_default_graph(before)


def split(line: str, **variables: object) -> list[str]:
    return magics.words(line, "rostopic", variables)


def test_words_are_split_as_a_shell_splits_them() -> None:
    assert split("pub -1 /x std_msgs/String 'data: two words'") == [
        "pub",
        "-1",
        "/x",
        "std_msgs/String",
        "data: two words",
    ]
    assert split("") == []
    assert split('echo "/a b"  /c') == ["echo", "/a b", "/c"]
    assert split("find a # b") == ["find", "a", "#", "b"]


def test_yaml_stays_what_it_is() -> None:
    assert split("pub /x a/B '{linear: {x: 0.2}, s: \"{topic}\"}'", topic=1)[-1] == '{linear: {x: 0.2}, s: "{topic}"}'


def test_variables_are_replaced_and_stay_one_word() -> None:
    line = "pub $topic a/B \"data: '$text'\" -r$n $$HOME"
    assert split(line, topic="/t", text="two words", n=3) == [
        "pub", "/t", "a/B", "data: 'two words'", "-r3", "$HOME",
    ]  # fmt: skip
    assert split("$values", values={"linear": {"x": 0.2}}) == ["{'linear': {'x': 0.2}}"]
    assert split("'$'") == ["$"]


@pytest.mark.parametrize(
    "line", ["list | head", "list > file", "list >> file", "list|head", "list; ls", "a && b", "list &"]
)
def test_what_is_a_shells_is_refused_by_name(line: str) -> None:
    operator = next(part for part in ("|", ">>", ">", ";", "&&", "&") if part in line)
    with pytest.raises(UsageError, match=r"%rostopic runs no shell") as error:
        split(line)
    assert f"`{operator}`" in str(error.value)


def test_an_operator_within_quotes_is_an_argument() -> None:
    assert split("echo /x --filter 'm.data > 3'")[-1] == "m.data > 3"


def test_lines_that_make_no_sense(shell: Any) -> None:
    with pytest.raises(UsageError, match="has no partner"):
        split("pub 'data: 1")
    with pytest.raises(UsageError, match="no variable topik; did you mean topic"):
        split("$topik", topic=1)
    with pytest.raises(UsageError, match="no variable x; write"):
        split("$x")
    with pytest.raises(UsageError, match="did you mean list"):
        magics.run(shell, "rosnode", "lsit")


def test_the_table_says_which_commands_have_a_tool() -> None:
    for name, entry in COMMANDS.items():
        if entry.folder is None:
            assert entry.tool() is not None or not entry.is_magic, name
    assert {"rosnode", "rostopic", "rosservice", "rosmsg", "rossrv", "rosparam", "rosbag"} <= {
        name for name, entry in COMMANDS.items() if entry.is_magic
    }


def test_a_command_for_terminals_is_not_a_magic(shell: Any) -> None:
    with pytest.raises(UsageError, match=r"rosmini world.* terminal"):
        magics.run(shell, "world", "list")


def test_a_result_is_printed_and_returned(shell: Any, capsys: pytest.CaptureFixture[str]) -> None:
    shell.graph.node("talker")
    found: Any = magics.run(shell, "rosnode", "list")
    assert found.names == ("/rosout", "/talker")
    assert capsys.readouterr().out == "/rosout\n/talker\n"
    display = vars(found)["_ipython_display_"]
    display()
    assert capsys.readouterr().out == ""
    shell.execution_count = 2
    display()
    assert capsys.readouterr().out == "/rosout\n/talker\n"
    assert "_ipython_display_" not in vars(found)


@pytest.mark.parametrize("line", ["echo $topic", "hz $topic", "bw $topic"])
def test_verbs_without_an_end_take_five_seconds_and_say_so(
    shell: Any, capsys: pytest.CaptureFixture[str], line: str
) -> None:
    publisher = shell.graph.node("talker").publisher("chatter", String)
    shell.graph.nodes["/talker"].timer(0.5, lambda _: publisher.publish("x"))
    before = shell.graph.scheduler.now_ns()
    magics.run(shell, "rostopic", line)
    assert shell.graph.scheduler.now_ns() - before == 5_000_000_000
    assert capsys.readouterr().out.startswith("(5 s of graph time; ")
    magics.run(shell, "rostopic", f"{line} --duration 1")
    magics.run(shell, "rostopic", "echo -n 2 /chatter")
    magics.run(shell, "rostopic", "pub -1 /other std_msgs/String x")  # it ends by itself, after three seconds
    assert "of graph time" not in capsys.readouterr().out


def test_a_workspace_is_made_in_cells(
    shell: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As in a terminal; what is printed has no folders in it that are another reader's."""
    (tmp_path / "ws" / "src").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "ws" / "src")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws" / "src"))
    made: Any = magics.run(shell, "catkin_create_pkg", "example_pkg std_msgs rospy")
    assert made.path == tmp_path / "ws" / "src" / "example_pkg"
    monkeypatch.chdir(tmp_path / "ws")
    report: Any = magics.run(shell, "catkin_make", "")
    assert report.report.built == ["example_pkg"]
    printed = capsys.readouterr().out
    assert "Created file example_pkg/package.xml" in printed
    assert "Base path: .\n" in printed
    assert "1 built, 0 up to date, 0 failed" in printed
    assert str(tmp_path) not in printed
    magics.run(shell, "rosversion", "example_pkg")
    magics.run(shell, "rosls", "example_pkg")
    assert capsys.readouterr().out == "0.0.0\nCMakeLists.txt\npackage.xml\nsrc\n"
    magics.run(shell, "roscd", "example_pkg")
    assert capsys.readouterr().out == ""
    assert Path.cwd() == made.path
    with pytest.raises(VerbError, match="File exists"):
        monkeypatch.chdir(tmp_path / "ws" / "src")
        magics.run(shell, "catkin_create_pkg", "example_pkg")
