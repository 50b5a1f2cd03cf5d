"""`rosmini stubs`: what it writes. `tests/gates/test_script_cells.py` has a type checker read scripts with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rosmini.tools.main import main
from rosmini.tools.stubs import HEAD, aliases


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    package = tmp_path / "src" / "own_pkg"
    for name, text in {
        "package.xml": "<package><name>own_pkg</name><version>0.0.0</version></package>",
        "msg/Num.msg": "Header header\nint64 num\n",
        "srv/Add.srv": "Num a\n---\n",
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(package.parent))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_it_is_written_once(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["stubs", "here"])
    (workspace / "here" / "rospy" / "__init__.pyi").write_text(HEAD, encoding="utf-8")
    capsys.readouterr()
    assert main(["stubs", "here"]) == 0
    assert capsys.readouterr().out.startswith("1 files written")


def test_what_is_not_ours_is_left_alone(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    own = workspace / "typings" / "std_msgs" / "msg.pyi"
    own.parent.mkdir(parents=True)
    own.write_text("mine = 1\n", encoding="utf-8")
    assert main(["stubs"]) == 1
    assert "is not of rosmini's making" in capsys.readouterr().err
    assert list((workspace / "typings").rglob("*.pyi")) == [own]


def test_a_package_that_is_wrong_is_left_out_and_told(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (workspace / "src" / "own_pkg" / "msg" / "Bad.msg").write_text("int65 x\n", encoding="utf-8")
    assert main(["stubs"]) == 1
    assert "own_pkg is left out: " in capsys.readouterr().err
    assert not (workspace / "typings" / "own_pkg").exists()
    assert (workspace / "typings" / "rospy" / "__init__.pyi").is_file()


def test_modules_inside_modules() -> None:
    assert aliases({"a": "json", "a.b": "x.b", "a.decoder": "json", "a.loads": "x", "c.msg": "y.msg"}) == {
        "a/__init__.pyi": f"{HEAD}from json import *\nfrom . import b as b\nfrom . import decoder as decoder\n",
        "a/b.pyi": f"{HEAD}from x.b import *\n",
        "a/decoder.pyi": f"{HEAD}from json import *\n",
        "a/loads.pyi": f"{HEAD}from x import *\n",
        "c/__init__.pyi": f"{HEAD}from . import msg as msg\n",
        "c/msg.pyi": f"{HEAD}from y.msg import *\n",
    }
