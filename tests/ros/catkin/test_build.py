"""catkin_make: what is made, what is made again, and what each usual mistake is told as."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.ros.catkin import CatkinError, Workspace

from ...processes import run
from .conftest import Bench

PYTHON = "lib/python3/dist-packages"
posix_only = pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")


def test_what_is_made_can_be_imported(bench: Bench) -> None:
    folder = bench.package("talk")
    report = bench.make()
    assert (report.status, report.built, report.failed, report.findings) == (0, ["talk"], [], [])
    code = (
        "import talk.msg, talk.srv\n"
        "print(talk.msg.Num._md5sum, talk.srv.Add._request_class is talk.srv.AddRequest, talk.msg.Num(num=3).num)\n"
    )
    env = dict(os.environ, ROS_PACKAGE_PATH=str(bench.base / "src"), PYTHONPATH=str(bench.base / "devel" / PYTHON))
    done = run([sys.executable, "-c", code], env=env, check=True)
    assert done.stdout.split()[1:] == ["True", "3"]
    relayed = run([sys.executable, bench.base / "devel/lib/talk/talker.py"], check=True)
    assert relayed.stdout == f"{folder / 'scripts/talker.py'} __main__\n"


def test_only_what_changed_is_made_again(bench: Bench) -> None:
    for name in ("one", "two"):
        bench.package(name)
    assert bench.make().built == ["one", "two"]
    assert bench.make().fresh == ["one", "two"]
    bench.write("one", "msg/Num.msg", "int64 other\n")
    report = bench.make()
    assert (report.built, report.fresh) == (["one"], ["two"])
    assert "other" in (bench.base / "devel" / PYTHON / "one/msg/_Num.py").read_text(encoding="utf-8")
    (bench.base / "devel/lib/two/talker.py").unlink()
    assert bench.make().built == ["two"]


def test_a_package_is_made_again_when_the_messages_that_it_uses_change(bench: Bench) -> None:
    bench.package("lower")
    bench.package("upper", "lower")
    bench.change("upper", "CMakeLists.txt", "std_msgs message_generation", "std_msgs lower message_generation")
    bench.change("upper", "CMakeLists.txt", "DEPENDENCIES std_msgs", "DEPENDENCIES std_msgs lower")
    bench.write("upper", "msg/Num.msg", "lower/Num num\n")
    assert bench.make().order == ("lower", "upper")
    before = (bench.base / "devel" / PYTHON / "upper/msg/_Num.py").read_text(encoding="utf-8")
    bench.write("lower", "msg/Num.msg", "int8 small\n")
    assert bench.make().built == ["lower", "upper"]
    assert (bench.base / "devel" / PYTHON / "upper/msg/_Num.py").read_text(encoding="utf-8") != before


def test_what_is_no_more_is_removed(bench: Bench) -> None:
    bench.package("talk")
    bench.make()
    made = bench.base / "devel" / PYTHON / "talk"
    assert (made / "srv/_Add.py").is_file()
    bench.change("talk", "CMakeLists.txt", "add_service_files(FILES Add.srv)\n", "")
    (bench.base / "src/talk/srv/Add.srv").unlink()
    bench.make()
    assert not (made / "srv").exists()
    assert (made / "msg/_Num.py").is_file()
    (bench.base / "src/talk").rename(bench.base / "elsewhere")
    bench.make()
    assert not made.exists()


def test_some_packages_only(bench: Bench) -> None:
    for name, *needs in (("base",), ("middle", "base"), ("other",)):
        bench.package(name, *needs)
    assert bench.make("middle").order == ("middle",)
    assert bench.make("middle", with_dependencies=True).order == ("base", "middle")
    with pytest.raises(CatkinError, match=r"'midle' not found in the workspace; did you mean middle\?"):
        bench.make("midle")


def test_actions_python_modules_and_variables(bench: Bench) -> None:
    bench.package("acting", "actionlib_msgs")
    bench.write("acting", "action/Wash.action", "int8 dishes\n---\nint8 clean\n---\nfloat32 done\n")
    bench.write("acting", "src/acting/__init__.py", "from .helper import answer\n")
    bench.write("acting", "src/acting/helper.py", "answer = 42\n")
    bench.write("acting", "setup.py", "from catkin_pkg.python_setup import generate_distutils_setup\n"
                "from setuptools import setup\n"
                "setup(**generate_distutils_setup(packages=['acting'], package_dir={'': 'src'}))\n")  # fmt: skip
    bench.write("acting", "CMakeLists.txt", """
        project(acting)
        set(NEEDED std_msgs actionlib_msgs)
        find_package(catkin REQUIRED COMPONENTS rospy message_generation ${NEEDED})
        catkin_python_setup()
        set(found Num.msg)
        add_message_files(FILES ${found})
        add_service_files(FILES Add.srv)
        add_action_files(DIRECTORY action FILES Wash.action)
        generate_messages(DEPENDENCIES ${NEEDED})
        catkin_package()
        add_executable(${PROJECT_NAME}_node src/main.cpp)
        if(CATKIN_ENABLE_TESTING)
          find_package(rostest REQUIRED)
          add_rostest(test/my.test)
        endif()
    """)  # fmt: skip
    report = bench.make()
    assert [str(each) for each in report.findings if each.is_error] == []
    assert ["acting_node is C++" in each.message for each in report.findings] == [True]
    assert "-- acting: 1 messages, 1 services, 1 actions" in bench.said
    env = dict(os.environ, ROS_PACKAGE_PATH=str(bench.base / "src"), PYTHONPATH=str(bench.base / "devel" / PYTHON))
    code = "import acting\nfrom acting.msg import WashAction, WashGoal, Num\n"
    code += "print(acting.answer, WashGoal(dishes=2).dishes)"
    assert run([sys.executable, "-c", code], env=env, check=True).stdout == "42 2\n"


def test_declarations_that_cannot_be_followed_are_reported(bench: Bench) -> None:
    bench.package("acting")
    bench.write("acting", "CMakeLists.txt", """
        project(acting)
        find_package(catkin REQUIRED COMPONENTS rospy std_msgs message_generation)
        file(GLOB found msg/*.msg)
        add_message_files(FILES ${found})
        if(UNIX)
          add_service_files(FILES Add.srv)
          set(other 1)
        endif()
        catkin_package()
    """)  # fmt: skip
    found = {each.line: each.message for each in bench.make().findings if each.file.name == "CMakeLists.txt"}
    assert found[5].startswith("found has no value")
    assert found[7].startswith("add_service_files() is ignored")
    assert "if() of line 6" in found[7]


def test_a_setup_py_is_read_and_not_run(bench: Bench) -> None:
    bench.package("talk")
    bench.change("talk", "CMakeLists.txt", "add_message", "catkin_python_setup()\nadd_message")
    for text, says in (
        ("open('run', 'w')\nsetup(packages=find_packages())\n", "setup.py is not run"),
        ("setup(packages=['gone'])\n", "the Python package 'gone' is not there"),
        ("setup(packages=['..'], package_dir={'..': '../..'})\n", "is not there"),
        ("setup(\n", "cannot be read"),
        ("setup()\n", "no packages="),
    ):
        bench.write("talk", "setup.py", text)
        assert says in " ".join(each.message for each in bench.make().findings)
    assert not (bench.base / "src/talk/run").exists()


def remove(*path: str) -> Callable[[Bench], object]:
    return lambda bench: (bench.base / "src").joinpath(*path).unlink()


def change(path: str, old: str, new: str) -> Callable[[Bench], object]:
    return lambda bench: bench.change("talk", path, old, new)


def write(path: str, text: str) -> Callable[[Bench], object]:
    return lambda bench: bench.write("talk", path, text)


def move(old: str, new: str) -> Callable[[Bench], object]:
    def act(bench: Bench) -> None:
        target = bench.base / "src/talk" / new
        target.parent.mkdir(parents=True, exist_ok=True)
        (bench.base / "src/talk" / old).rename(target)

    return act


CMAKE, XML, TALKER = "CMakeLists.txt", "package.xml", "scripts/talker.py"
GENERATION = "<build_depend>message_generation</build_depend>"

ERRORS: list[tuple[Callable[[Bench], object], str]] = [
    (change(XML, "<license>TODO</license>", ""), r"package\.xml:2: error: .*license"),
    (change(XML, "<name>talk</name>", ""), r"package\.xml:2: error: the package has no name"),
    (change(XML, "</package>", ""), r"package\.xml:\d+: error: .*is not XML|still open"),
    (remove("talk", CMAKE), r"package\.xml: error: the package has no CMakeLists\.txt"),
    (
        change(CMAKE, "project(talk)", "project(walk)"),
        r"CMakeLists\.txt:2: error: this is project\(walk\), but the package",
    ),
    (change(CMAKE, "project(talk)", ""), r"error: project\(talk\) is missing"),
    (
        change(CMAKE, "catkin_package(CATKIN_DEPENDS std_msgs message_runtime)", ""),
        r"error: catkin_package\(\) is missing",
    ),
    (change(CMAKE, "find_package(catkin REQUIRED COMPONENTS rospy std_msgs message_generation)", ""), "find_package"),
    (change(CMAKE, " message_generation)", ")"), r"CMakeLists\.txt:3: error: message_generation is missing among"),
    (
        change(CMAKE, "COMPONENTS rospy std_msgs", "COMPONENTS rospy"),
        r"CMakeLists\.txt:6: error: .* depends on std_msgs",
    ),
    (change(CMAKE, "DEPENDENCIES std_msgs", ""), r"Num\.msg:1: error: std_msgs/Header is used here: add std_msgs"),
    (
        change(CMAKE, "generate_messages(DEPENDENCIES std_msgs)", ""),
        r"CMakeLists\.txt:4: error: generate_messages\(\) is miss",
    ),
    (
        change(CMAKE, "Num.msg", "Nmu.msg"),
        r"CMakeLists\.txt:4: error: there is no file msg/Nmu\.msg; did you mean Num\.msg",
    ),
    (
        change(CMAKE, "FILES Num.msg", "Num.msg"),
        r"CMakeLists\.txt:4: error: Num\.msg is ignored, because FILES is missing",
    ),
    (change(CMAKE, "project(talk)", "project(talk"), r"CMakeLists\.txt:\d+: error: "),
    (
        move("msg/Num.msg", "Num.msg"),
        r"CMakeLists\.txt:4: error: .*Num\.msg is in the wrong folder: move it to msg/Num\.msg",
    ),
    (
        write("msg/Num.msg", "int64 num\nin64 other\n"),
        r"Num\.msg:2: error: unknown type 'talk/in64'.*int64|Num\.msg:2: error",
    ),
    (write(TALKER, "#!/usr/bin/env python3\r\nprint(1)\r\n"), r"talker\.py:1: error: .*CRLF.*sed -i"),
    (write(TALKER, "#!/bin/bash\nprint(1)\n"), r"talker\.py:1: error: a Python script is run by '/bin/bash'"),
    (change(CMAKE, "scripts/talker.py", "scripts/taker.py"), r"CMakeLists\.txt:8: error: .*did you mean talker\.py"),
    (change(CMAKE, "scripts/talker.py", "../../../x.py"), r"CMakeLists\.txt:8: error: "),
    (
        change(CMAKE, "CATKIN_DEPENDS std_msgs", "CATKIN_DEPENDS tf"),
        r"CMakeLists\.txt:7: error: .*<exec_depend>tf</exec",
    ),
    (change(CMAKE, "${CATKIN_PACKAGE_BIN_DESTINATION}", ""), r"error: DESTINATION is missing|error"),
]
WARNINGS: list[tuple[Callable[[Bench], object], str]] = [
    (change(XML, GENERATION, ""), r"package\.xml:\d+: warning: .*<build_depend>message_generation<"),
    (change(XML, "<exec_depend>message_runtime</exec_depend>", "<exec_depend>tf</exec_depend>"
            "<build_export_depend>message_runtime</build_export_depend>"), r"package\.xml:\d+: warning: .*_runtime"),
    (change(XML, "<build_depend>rospy</build_depend>", ""), r"CMakeLists\.txt:3: warning: rospy is a component"),
    (change(CMAKE, "COMPONENTS rospy", "COMPONENTS rospi rospy"), r"CMakeLists\.txt:3: warning: there is no pack"),
    (change(XML, "<buildtool_depend>catkin</buildtool_depend>", ""), r"package\.xml:2: warning: <buildtool_depend>"),
    (write("msg/Other.msg", "int8 a\n"), r"Other\.msg: warning: not built: name it in add_message_files"),
    (write("Other.srv", "---\n"), r"Other\.srv: warning: not built: move it into the folder srv"),
    (write(TALKER, "print(1)\n"), r"talker\.py:1: warning: the first line does not say how to run it"),
    (write(TALKER, "#!/usr/bin/env python3\nprint 'x'\n"), r"talker\.py:2: warning: this is not Python 3"),
    (write(TALKER, "#!/usr/bin/python2\n"), r"talker\.py:1: warning: this asks for Python 2"),
    (write("inner/package.xml", "<package/>"), r"inner/package\.xml: warning: a package in the package talk"),
]  # fmt: skip


@pytest.mark.parametrize(("spoil", "says"), ERRORS)
def test_a_mistake_is_an_error_and_the_other_packages_are_built(
    bench: Bench, spoil: Callable[[Bench], object], says: str
) -> None:
    bench.package("talk")
    bench.package("sound")
    spoil(bench)
    report = bench.make()
    assert any(re.search(says, str(each)) for each in report.findings), [str(each) for each in report.findings]
    assert (report.status, report.failed, report.built) == (1, ["talk"], ["sound"])


@pytest.mark.parametrize(("spoil", "says"), WARNINGS)
def test_what_is_odd_is_a_warning_and_the_package_is_built(
    bench: Bench, spoil: Callable[[Bench], object], says: str
) -> None:
    bench.package("talk")
    spoil(bench)
    report = bench.make()
    assert any(re.search(says, str(each)) for each in report.findings), [str(each) for each in report.findings]
    assert (report.status, report.built) == (0, ["talk"])


@posix_only
def test_a_script_without_its_run_bit_is_named(bench: Bench) -> None:
    path = bench.package("talk") / TALKER
    path.chmod(0o644)
    assert [f"chmod +x {path}" in str(each) for each in bench.make().findings] == [True]


def test_capitals_in_a_name(bench: Bench) -> None:
    bench.package("Talk")
    (finding,) = bench.make().findings
    assert re.search(r"package\.xml:3: warning: the package name 'Talk' breaks the naming conventions", str(finding))


def test_what_keeps_a_whole_workspace_from_being_built(tmp_path: Path, benches: Callable[[str], Bench]) -> None:
    bench = benches("ws")
    bench.package("talk")
    for base, says in (
        (tmp_path / "empty", r'source space ".*src" does not exist\na workspace has a folder src'),
        (bench.base / "src", r"is a source space; run catkin_make in the folder above it: cd .*ws$"),
        (bench.base / "src" / "talk", r"is a package; catkin_make is run in the workspace: cd .*ws$"),
    ):
        base.mkdir(exist_ok=True)
        with pytest.raises(CatkinError, match=says):
            Workspace.at(base)
    (bench.base / "src/again").mkdir()
    (bench.base / "src/again/package.xml").write_text(
        (bench.base / "src/talk/package.xml").read_text(encoding="utf-8"), encoding="utf-8"
    )
    (bench.base / "src/again/CMakeLists.txt").write_text("project(talk)\n", encoding="utf-8")
    with pytest.raises(CatkinError, match="Multiple packages found with the same name 'talk'"):
        bench.make()
    circle = benches("circle")
    circle.package("one", "two")
    circle.package("two", "one")
    with pytest.raises(CatkinError, match=r"in a circle: (one -> two -> one|two -> one -> two)"):
        circle.make()
    other = benches("other")
    (other.base / "devel").mkdir()
    (other.base / "devel/.built_by").write_text("catkin build", encoding="utf-8")
    with pytest.raises(CatkinError, match="was made by 'catkin build'"):
        other.make()


def test_a_damaged_state_is_forgotten_and_harms_nothing(bench: Bench) -> None:
    bench.package("talk")
    bench.make()
    state = bench.base / "build/rosmini.json"
    victim = bench.base / "victim"
    victim.touch()
    good = state.read_text(encoding="utf-8")
    for text in ("", "[]", "{", '{"packages": {"talk": 1}, "underlays": []}', "[" * 100_000):
        state.write_text(text, encoding="utf-8")
        assert bench.make().built == ["talk"]
    state.write_text(good.replace("lib/talk/talker.py", "../victim"), encoding="utf-8")
    bench.make()
    bench.change("talk", CMAKE, "catkin_install_python", "#")
    bench.make()
    assert victim.exists()


def test_a_destination_outside_of_devel_is_refused(bench: Bench) -> None:
    bench.package("talk")
    bench.change("talk", CMAKE, "${CATKIN_PACKAGE_BIN_DESTINATION}", "../../stolen")
    with pytest.raises(CatkinError, match="would write outside the devel space"):
        bench.make()
    assert not (bench.base.parent / "stolen").exists()


@posix_only
@pytest.mark.parametrize("shell", ["sh", "bash", "zsh"])
def test_what_a_shell_sources_chains_workspaces_and_may_be_sourced_twice(
    benches: Callable[[str], Bench], shell: str, request: pytest.FixtureRequest
) -> None:
    if shell == "zsh":
        request.getfixturevalue("zsh")
    under, over = benches("it's under"), benches("over $HOME")
    under.package("one")
    over.package("two")
    under.make()
    over.make(environ={"CMAKE_PREFIX_PATH": str(under.base / "devel")})
    line = (
        '. "$1"; . "$1"; printf "%s\\n" "$ROS_PACKAGE_PATH" "$CMAKE_PREFIX_PATH" "$PYTHONPATH" "$ROS_DISTRO"; '
        "type _rosmini_first >/dev/null 2>&1 && echo left; true"
    )
    env = {"PATH": os.environ["PATH"], "ROS_PACKAGE_PATH": f"/a:{over.base}/src:/b", "PYTHONPATH": ""}
    setup = over.base / "devel" / f"setup.{shell}"
    done = run([shell, "-c", line, shell, setup], env=env, check=True)
    assert done.stdout.splitlines() == [
        f"{over.base}/src:{under.base}/src:/a:/b",
        f"{over.base}/devel:{under.base}/devel",
        f"{over.base}/devel/{PYTHON}:{under.base}/devel/{PYTHON}",
        "noetic",
    ]
    over.make()  # in a shell that sources nothing the chain stays
    again = run([shell, "-c", line, shell, setup], env=env, check=True)
    assert again.stdout == done.stdout
    ended = run([over.base / "devel/env.sh", "sh", "-c", "echo $ROS_VERSION; exit 7"], env=env)
    assert (ended.stdout, ended.returncode) == ("1\n", 7)


def test_what_is_not_rebuilt_is_told_where_it_is_imported(bench: Bench) -> None:
    bench.package("talk")
    bench.make()
    bench.write("talk", "msg/Num.msg", "int8 changed\n")
    bench.write("talk", "msg/New.msg", "int8 added\n")
    env = dict(os.environ, ROS_PACKAGE_PATH=str(bench.base / "src"), PYTHONPATH=str(bench.base / "devel" / PYTHON))
    stale = run([sys.executable, "-c", "from talk.msg import Num"], env=env, check=True)
    assert "talk/Num was changed and not rebuilt: run catkin_make" in stale.stderr
    missing = run([sys.executable, "-c", "import talk.msg; talk.msg.New"], env=env)
    assert missing.returncode == 1
    assert "talk/New is in" in missing.stderr
    assert "but was not built: name it in CMakeLists.txt" in missing.stderr
    unknown = run([sys.executable, "-c", "import talk.msg; talk.msg.Nowhere"], env=env)
    assert "the package 'talk' has no msg named 'Nowhere'" in unknown.stderr


DAMAGE = st.lists(
    st.tuples(
        st.sampled_from(
            ("package.xml", "CMakeLists.txt", "msg/Num.msg", "srv/Add.srv", "scripts/talker.py", "setup.py")
        ),
        st.floats(0, 1, exclude_max=True),
        st.integers(0, 12),
        st.one_of(
            st.binary(max_size=6), st.sampled_from((b"<", b">", b'"', b"${", b"(", b")", b"..", b"/", b"\0", b"\r\n"))
        ),
    ),
    min_size=1,
    max_size=4,
)


@given(DAMAGE)
def test_damaged_packages_are_built_or_told_and_nothing_is_written_elsewhere(
    damage: list[tuple[str, float, int, bytes]],
) -> None:
    with TemporaryDirectory() as folder:
        bench = Bench(Path(folder).resolve() / "ws")
        bench.package("talk")
        bench.write("talk", "setup.py", "setup(packages=['talk'], package_dir={'': 'src'})\n")
        for name, where, size, new in damage:
            path = bench.base / "src/talk" / name
            data = path.read_bytes()
            at = int(where * len(data))
            path.write_bytes(data[:at] + new + data[at + size :])
        before = {path for path in bench.base.parent.rglob("*") if bench.base / "src" in (path, *path.parents)}
        refused = ""
        try:
            report = bench.make()
        except CatkinError as error:
            refused = str(error)
        assert refused or report.status == (1 if report.failed else 0)
        after = {path for path in bench.base.parent.rglob("*") if bench.base / "src" in (path, *path.parents)}
        assert after == before
        assert {path.name for path in bench.base.parent.iterdir()} == {"ws"}
        assert {path.name for path in bench.base.iterdir()} <= {"src", "build", "devel"}
