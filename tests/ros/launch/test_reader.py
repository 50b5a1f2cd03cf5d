"""Launch files as plans: what they mean, and what is wrong with them, with file and line."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.packages import PackageIndex
from rosmini.ros.launch import LaunchError, Plan, find_file, read
from rosmini.ros.launch.nodes import MAX_RETRIES

SHAPES = Path(__file__).parent / "data" / "shapes"


def plan_of(inside: str, **options: Any) -> Plan:
    return read(text=f"<launch>\n{inside}\n</launch>", **options)


def refused(inside: str, **options: Any) -> LaunchError:
    with pytest.raises(LaunchError) as caught:
        plan_of(inside, **options)
    return caught.value


# ---- what a file means ----


def test_the_last_setting_wins() -> None:
    plan = plan_of('<param name="a" value="1"/>\n<param name="a" value="2"/>\n<param name="b" value="3"/>')
    setting = plan.settings["/a"]
    assert (setting.name, setting.value, setting.place.line) == ("/a", 2, 3)


def test_an_unknown_attribute_warns_and_goes_on() -> None:
    """The second listing of the report's chapter 9.5 has `arg=` on a node."""
    plan = plan_of('<node pkg="p" type="t" name="n" arg="--fast"/>')
    assert [node.name for node in plan.nodes] == ["n"]
    (warning,) = plan.warnings
    assert warning.startswith("<text>:2: ") and "'arg'" in warning and warning.endswith("did you mean args?")


def test_a_parameter_below_another_one_warns() -> None:
    plan = plan_of('<param name="a" value="1"/><param name="a/b" value="1"/>')
    assert plan.warnings == ["<text>:2: parameter [/a/b] conflicts with parent parameter [/a]"]


def test_arguments_are_described() -> None:
    plan = read(SHAPES / "navigation.launch", lenient=True)
    assert plan.ros_args().splitlines()[:3] == [
        "Optional Arguments:",
        f'  map_file (default "{SHAPES}/map.yaml"): undocumented',
        '  model (default "burger"): model type [burger, waffle, waffle_pi]',
    ]
    assert plan_of("").ros_args() == "No arguments."


def test_an_argument_that_no_file_has_is_told() -> None:
    plan = plan_of('<arg name="model" default="x"/>', args={"modle": "y"})
    (warning,) = plan.warnings
    assert "'modle'" in warning and warning.endswith("did you mean model?")


def test_everything_that_is_missing_is_named_in_one_list(tmp_path: Path) -> None:
    error = refused(
        """<arg name="a"/>
        <include file="$(find nowhere)/launch/x.launch"/>
        <include file="$(find nowhere)/launch/y.launch"/>
        <param name="b" value="$(arg a)"/>
        <param name="c" value="$(env NOBODY_HAS_THIS)"/>
        <param name="d" textfile="/no/such/file"/>
        <param name="e" command="make coffee"/>
        <rosparam file="/no/such.yaml"/>"""
    )
    assert [(each.kind, each.name, each.place.line) for each in error.missing] == [
        ("package", "nowhere", 3),
        ("arg", "a", 5),
        ("environment variable", "NOBODY_HAS_THIS", 6),
        ("file", "/no/such/file", 7),
        ("command's output", "make coffee", 8),
        ("file", "/no/such.yaml", 9),
    ]
    assert str(error).startswith("6 things are missing:")
    assert "nowhere  (<text>:3)" in str(error)


def test_one_missing_thing_is_named_at_its_place() -> None:
    error = refused('<arg name="model"/>\n<param name="b" value="$(arg model)"/>')
    assert str(error).startswith("<text>:3: requires the 'model' arg to be set") and "model:=" in str(error)


def test_an_arg_that_an_include_lacks_is_given_there(tmp_path: Path) -> None:
    inner = tmp_path / "inner.launch"
    text = '<launch><arg name="a"/><group><param name="b" value="$(arg a)"/></group></launch>'
    inner.write_text(text, encoding="utf-8")
    error = refused(f'<include file="{inner}"/>')
    way = 'give it in the <include> at <text>:2: <arg name="a" value="..."/>'
    assert str(error).startswith(f"{inner}:1: requires the 'a' arg to be set") and str(error).endswith(way)


def test_what_follows_from_what_is_missing_is_not_told_as_well() -> None:
    error = refused(
        """<arg name="a" default="$(env NOBODY_HAS_THIS)"/>
        <include file="/robots/$(arg a).launch"/>
        <group if="$(arg a)"><node pkg="p" type="t" name="n"/></group>
        <node pkg="p" type="t" name="n" respawn="$(arg a)"/>"""
    )
    assert [each.name for each in error.missing] == ["NOBODY_HAS_THIS"]
    assert "environment variable 'NOBODY_HAS_THIS' is not set" in str(error)


# ---- what is refused ----


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        ('<node pkg="rospy" typ="x" name="n"/>', "did you mean typ?"),
        ('<node pkg="p" type="t" name="robot/n"/>', 'give the namespace as ns="robot"'),
        ('<param name="a" value="1" type="integer"/>', "Unknown type 'integer'; the types are str"),
        ('<param name="a" value="4000000000"/>', "32 bits"),
        ('<node pkg="p" type="t" name="n" args="it\'s"/>', "cannot be split into words"),
        ('<param name="a" value="$(find x $(arg y))"/>', "cannot be inside of substitution args"),
        ('<param name="a" value="x $(eval 1)"/>', "must be the whole value"),
        ('<param name="a" value="$(eval __import__(\'os\'))"/>', "__import__"),
        ('<param name="a" value="$(eval 10 ** 10 ** 10)"/>', "$(eval"),
        ('<rosparam command="dump" file="/etc/passwd"/>', "is not written"),
        ('<include file="a.launch"><arg name="x"/></include>', "include args must have declared values"),
        ('<node pkg="p" type="t" name="n" machine="far"/>', "unknown machine [far]"),
        ('<machine name="m" address="a" ros-root="/"/>', "not supported since ROS Fuerte"),
        ("<rosparam>\na: 1\nb: [\n</rosparam>", "Error within YAML block"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(inside: str, said: str) -> None:
    error = refused("\n" + inside)
    assert said in str(error)
    assert error.file == "<text>"
    assert error.line is not None
    assert error.line >= 3


def test_a_yaml_block_has_its_own_lines() -> None:
    assert refused("<rosparam>\na: 1\nb: {\n</rosparam>").line == 5


def test_files_that_include_one_another_are_refused(tmp_path: Path) -> None:
    for name, other in (("a", "b"), ("b", "a")):
        text = f'<launch><include file="$(dirname)/{other}.launch"/></launch>'
        (tmp_path / f"{name}.launch").write_text(text, encoding="utf-8")
    with pytest.raises(LaunchError, match=r"a\.launch -> b\.launch -> a\.launch"):
        read(tmp_path / "a.launch")


def test_a_file_that_counts_without_end_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "grow.launch"
    file.write_text(
        '<launch><arg name="n" default="0"/><include file="$(dirname)/grow.launch">'
        '<arg name="n" value="$(eval n + 1)"/></include></launch>',
        encoding="utf-8",
    )
    with pytest.raises(LaunchError, match="deep"):
        read(file)


def test_a_file_that_doubles_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "grow.launch"
    include = '<include file="$(dirname)/grow.launch"><arg name="n" value="$(eval {})"/></include>'
    file.write_text(
        f'<launch><arg name="n" default="1"/><group if="$(eval n &lt; 100000)">'
        f"{include.format('n * 2')}{include.format('n * 2 + 1')}</group></launch>",
        encoding="utf-8",
    )
    with pytest.raises(LaunchError, match="files are included"):
        read(file)


@pytest.mark.parametrize(
    "inside",
    [
        '<param name="p" value="{many}"/>',
        '<param name="p" value="$(eval arg(\'a\'))"/>' * 200,
        '<param name="p" value="$(arg a)b"/>' * 200,
    ],
    ids=["in one text", "in many that are evaluated", "in many"],
)
def test_an_argument_that_is_put_in_many_times_does_not_fill_the_memory(inside: str) -> None:
    long = f'<arg name="a" value="{"x" * 900_000}"/>'
    assert re.search("characters|steps", str(refused(long + inside.format(many="$(arg a)" * 1000))))


def test_a_number_of_retries_of_any_length_is_read() -> None:
    plan = plan_of(f'<test pkg="p" type="t" test-name="n" retry="{"9" * 5000}"/>')
    assert plan.tests[0].retry == MAX_RETRIES


def test_entities_are_refused() -> None:
    bomb = '<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;">]><launch><param name="a" value="&b;"/></launch>'
    with pytest.raises(LaunchError, match="may not define or use entities"):
        read(text=bomb)


def test_a_pipe_or_a_folder_is_no_launch_file(tmp_path: Path) -> None:
    with pytest.raises(LaunchError, match="cannot be read: it is a folder"):
        read(tmp_path)


def test_what_was_included_wants_its_arguments_to_be_used(tmp_path: Path) -> None:
    (tmp_path / "inner.launch").write_text('<launch><arg name="model"/></launch>', encoding="utf-8")
    outer = tmp_path / "outer.launch"
    outer.write_text(
        '<launch>\n<include file="$(dirname)/inner.launch">\n<arg name="modle" value="x"/></include></launch>',
        encoding="utf-8",
    )
    with pytest.raises(LaunchError, match=r"outer.launch:2: unused args \[modle\].*did you mean model"):
        read(outer)


TAGS = [
    "node", "param", "rosparam", "arg", "remap", "group", "include", "env", "machine", "test", "launch", "x",
]  # fmt: skip
ATTRIBUTES = [
    "name", "value", "default", "from", "to", "ns", "if", "unless", "file", "pkg", "type", "command", "clear_params",
    "address", "test-name", "subst_value", "param", "args", "respawn", "pass_all_args",
]  # fmt: skip
VALUES = [
    "", "a", "/a", "~", "~a", "a//b", "1", "true", "$(arg a)", "$(anon a)", "$(eval a)", "$(find a)", "load",
    "$(eval [1] * 5)", "$(dirname)", "int", "yaml", "1e400", "[", "\n", "é", "a b", "../..", "/dev/zero",
]  # fmt: skip


@st.composite
def elements(draw: st.DrawFn, depth: int = 0) -> str:
    from xml.sax.saxutils import quoteattr

    tag = draw(st.sampled_from(TAGS))
    given = draw(st.dictionaries(st.sampled_from(ATTRIBUTES), st.sampled_from(VALUES), max_size=6))
    inside = "".join(draw(st.lists(elements(depth + 1), max_size=3))) if depth < 2 else ""
    written = "".join(f" {name}={quoteattr(value)}" for name, value in given.items())
    return f"<{tag}{written}>{inside}{draw(st.sampled_from(['', 'a: 1', '[', '1']))}</{tag}>\n"


@given(st.lists(elements(), max_size=6))
def test_any_tags_with_any_attributes_are_read_or_refused(parts: list[str]) -> None:
    text = f"<launch>\n{''.join(parts)}</launch>"
    try:
        plan = read(text=text, environ={}, packages=PackageIndex([]), lenient=True)
    except LaunchError as error:
        assert error.file and str(error)  # noqa: PT017
    else:
        assert plan.summary()
        assert all(name.startswith("/") for name in plan.settings)


# ---- finding files ----


def package(folder: Path, name: str) -> Path:
    made = folder / name
    for inside in ("launch", "scripts"):
        (made / inside).mkdir(parents=True)
    (made / "package.xml").write_text(
        f"<package format='2'><name>{name}</name><version>1.0.0</version><description>-</description>"
        "<maintainer email='a@b.c'>-</maintainer><license>BSD</license></package>",
        encoding="utf-8",
    )
    return made


def test_a_launch_file_is_found_in_its_package(tmp_path: Path) -> None:
    made = package(tmp_path, "speaking")
    (made / "launch" / "talk.launch").write_text("<launch/>", encoding="utf-8")
    (made / "scripts" / "talker.py").write_text("#!/usr/bin/env python3\n", encoding="utf-8")
    index = PackageIndex([tmp_path])
    file = str(made / "launch" / "talk.launch")
    assert find_file(["speaking", "talk.launch"], index) == [file]
    assert find_file([file], index) == [file]
    assert find_file(["speaking", "launch/talk.launch"], index) == [file]
    assert find_file(["-"], index) == ["-"]
    for words, said in [
        (["speaking", "talker.py"], "It is an executable: rosrun speaking talker.py"),
        (["speaking", "tlak.launch"], "did you mean talk.launch?"),
        (["speakin", "talk.launch"], "did you mean speaking?"),
        (["speaking", "../../etc/passwd"], "is neither a launch file"),
        (["nothing.launch"], "[nothing.launch] is not a launch file name"),
        ([file, "gone.launch"], "The following input files do not exist: gone.launch"),
    ]:
        with pytest.raises(LaunchError) as caught:
            find_file(words, index)
        assert said in str(caught.value)
    (made / "talk.launch").write_text("<launch/>", encoding="utf-8")
    with pytest.raises(LaunchError, match="multiple files named"):
        find_file(["speaking", "talk.launch"], index)
