"""The type stubs are there after an installation, and mypy finds errors in programs with them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from assets.generate.stubs import write_stubs

RIGHT = """
from rosmini.msgs import std_msgs
from rosmini.msgs.geometry_msgs.msg import Twist, Vector3
from rosmini.msgs.std_srvs.srv import SetBoolResponse

twist = Twist(linear=Vector3(0.1, 0, 0))
twist.angular.z = 1.0
length: int = len(std_msgs.msg.String(data="x").data)
response = SetBoolResponse(True, "ok")
md5: str = Twist._md5sum
"""
WRONG = [
    ("from rosmini.msgs.geometry_msgs.msg import Twist\nTwist().linear.xx = 1.0\n", 'has no attribute "xx"'),
    ("from rosmini.msgs.std_msgs.msg import String\nString(dat='x')\n", "Unexpected keyword argument"),
    ("from rosmini.msgs.std_msgs.msg import String\nn: int = String().data\n", "Incompatible types"),
    ("from rosmini.msgs.std_msgs.msg import Stringe\n", 'has no attribute "Stringe"'),
    ("from rosmini.msgs.geometry_msgs.msg import Twist\nTwist(1, 2)\n", "No overload variant"),
]


def test_the_installation_has_written_the_stubs(root: Path, tmp_path: Path) -> None:
    write_stubs(tmp_path)
    assert write_stubs(tmp_path) == []
    written, installed = (
        {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in folder.glob("*/*.pyi")}
        for folder in (tmp_path, root / "rosmini" / "msgs")
    )
    assert written == installed, "run `uv sync --reinstall-package rosmini-ros`"


def test_stubs_of_packages_that_are_gone_are_removed(tmp_path: Path) -> None:
    (tmp_path / "old_msgs").mkdir()
    (tmp_path / "old_msgs" / "msg.pyi").write_text("", encoding="utf-8")
    assert tmp_path / "old_msgs" / "msg.pyi" in write_stubs(tmp_path)
    assert not (tmp_path / "old_msgs" / "msg.pyi").exists()


def test_mypy_accepts_the_right_program_and_refuses_each_wrong_one(
    root: Path, tmp_path: Path, mypy: Callable[[list[str]], tuple[str, str, int]]
) -> None:
    sources = {"right.py": RIGHT, **{f"wrong_{number}.py": text for number, (text, _) in enumerate(WRONG)}}
    for name, text in sources.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    arguments = ["--strict", "--config-file", str(root / "pyproject.toml"), "--cache-dir", str(root / ".mypy_cache")]
    output, _, _ = mypy([*arguments, *(str(tmp_path / name) for name in sources)])
    lines = [line for line in output.splitlines() if ": error:" in line]
    assert not [line for line in lines if "right.py" in line], output
    for number, (_, words) in enumerate(WRONG):
        assert [line for line in lines if f"wrong_{number}.py" in line and words in line], output
    assert all("wrong_" in line for line in lines), output
