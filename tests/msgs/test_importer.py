"""``import`` for message packages, with and without ``install()``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import rosmini.msgs
from rosmini.core.errors import DefinitionError, UnknownPackage, UnknownType
from rosmini.msgs import install, installed, message_class, uninstall

from ..processes import run as run_process

Workspace = Callable[[dict[str, str]], Path]


@pytest.fixture
def hook() -> Iterator[None]:
    install()
    yield
    uninstall()


def run(code: str) -> None:
    exec(code, {})


def test_our_own_path_works_without_install() -> None:
    import rosmini.msgs.geometry_msgs.msg
    from rosmini.msgs import std_msgs
    from rosmini.msgs.std_msgs.msg import String
    from rosmini.msgs.std_srvs.srv import SetBool, SetBoolResponse

    assert std_msgs.msg.String is String is message_class("std_msgs/String")
    assert SetBool._response_class is SetBoolResponse
    assert rosmini.msgs.geometry_msgs.msg.Twist._type == "geometry_msgs/Twist"


def test_ross_path_works_after_install_only(hook: None) -> None:
    from std_msgs.msg import String

    assert installed()
    assert String is message_class("std_msgs/String")
    uninstall()
    with pytest.raises(ModuleNotFoundError):
        run("import std_msgs.msg")


def test_star_imports_and_completion(hook: None) -> None:
    names: dict[str, object] = {}
    exec("from geometry_msgs.msg import *", names)
    assert names["Twist"] is message_class("geometry_msgs/Twist")
    assert "__all__" not in names
    import actionlib.msg
    import std_srvs.srv

    assert {"SetBool", "SetBoolRequest", "Trigger"} <= set(dir(std_srvs.srv))
    assert "TwoIntsActionGoal" in dir(actionlib.msg)
    assert "std_msgs" in dir(rosmini.msgs)


@pytest.mark.parametrize(
    ("code", "error", "words"),
    [
        ("from std_msgs.msg import Stringe", UnknownType, "did you mean String"),
        ("from std_srvs.srv import SetBol", UnknownType, "did you mean SetBool"),
        ("from std_msg.msg import String", UnknownPackage, "did you mean std_msgs"),
        ("from rosmini.msgs import std_msg", UnknownPackage, "did you mean std_msgs"),
        ("import rosmini.msgs.std_msg.msg", UnknownPackage, "did you mean std_msgs"),
    ],
)
def test_a_mistyped_import_names_the_nearest(hook: None, code: str, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words) as caught:
        run(code)
    assert isinstance(caught.value, ImportError)


def test_other_imports_fail_as_ever(hook: None) -> None:
    with pytest.raises(ModuleNotFoundError, match="No module named 'no_such_module'"):
        run("import no_such_module")
    with pytest.raises(ModuleNotFoundError):
        run("import std_msgs.srv")
    import std_msgs.msg

    assert not hasattr(std_msgs.msg, "_repr_html_")
    assert not hasattr(std_msgs.msg, "lower_case")


def test_a_workspace_on_the_package_path(hook: None, workspace: Workspace, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = workspace(
        {"own_msgs/msg/Pair.msg": "int32 a\nstd_msgs/String b\n", "own_msgs/msg/Bad.msg": "int32 a\nint32 1\n"}
    )
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder))
    # the package's folder in the working directory must not pass for a Python package without __init__.py
    monkeypatch.syspath_prepend(str(folder))
    from own_msgs.msg import Pair

    assert Pair(a=3).b.data == ""
    with pytest.raises(DefinitionError, match=r"Bad\.msg:2.*not a field name"):
        run("from own_msgs.msg import Bad")


def test_an_installed_module_is_not_shadowed_unless_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "std_msgs"
    package.mkdir()
    (package / "__init__.py").write_text("", encoding="utf-8")
    (package / "msg.py").write_text("String = 'the installed one'\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    try:
        for shadow, expected in ((False, "the installed one"), (True, message_class("std_msgs/String"))):
            install(shadow=shadow)
            names: dict[str, object] = {}
            exec("from std_msgs.msg import String", names)
            assert names["String"] == expected
            for name in ("std_msgs", "std_msgs.msg"):
                sys.modules.pop(name, None)
    finally:
        uninstall()


def test_a_python_package_of_the_same_name_keeps_its_own_modules(
    hook: None, workspace: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = workspace({"both_things/msg/Pair.msg": "int32 a\n", "both_things/src/both_things/__init__.py": "X = 1\n"})
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder))
    monkeypatch.syspath_prepend(str(folder / "both_things" / "src"))
    import both_things
    from both_things.msg import Pair

    assert (both_things.X, Pair().a) == (1, 0)
    for name in ("both_things", "both_things.msg"):
        sys.modules.pop(name, None)


def test_importing_the_package_is_light() -> None:
    code = (
        "import sys, rosmini.msgs; print([m for m in ('numpy', 'rosbags', 'yaml', 'catkin_pkg') if m in sys.modules])"
    )
    done = run_process([sys.executable, "-c", code], check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("statement", "words"),
    [
        ("from rosmini.msgs.std_msgs import String", r"write `from std_msgs.msg import String`"),
        ("import rosmini.msgs.std_msgs; rosmini.msgs.std_msgs.String", r"write `from std_msgs.msg import String`"),
        ("import rosmini.msgs.std_msgs.String", r"write `from std_msgs.msg import String`"),
        ("from rosmini.msgs.turtlesim import Spawn", r"write `from turtlesim.srv import Spawn`"),
        ("from rosmini.msgs.std_msgs import Strin", r"did you mean String"),
        ("from rosmini.msgs.geometry_msgs.msgs import Twist", r"no module 'msgs': it has geometry_msgs.msg"),
        ("from rosmini.msgs.std_msgs.srv import String", r"no module 'srv': it has std_msgs.msg"),
    ],
)
def test_an_import_without_its_module_says_what_to_write(statement: str, words: str) -> None:
    with pytest.raises(ImportError, match=words):
        exec(statement)
