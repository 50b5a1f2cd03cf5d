"""``import rosmsg``, as public scripts use it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rosmini.ros.rospy.aliases import rosmsg
from rosmini.ros.scripts import ScriptSpec, run_scripts

SCRIPT = """
import rosmsg
print(rosmsg.get_srv_text("std_srvs/SetBool").split())
print(rosmsg.rosmsg_md5(rosmsg.MODE_MSG, "std_msgs/String"))
"""


def test_a_script_imports_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "shower.py"
    path.write_text(SCRIPT, encoding="utf-8")
    assert run_scripts([ScriptSpec(str(path))], simulated=True, duration=5.0).status == 0
    printed = [line.removeprefix("[shower] ") for line in capsys.readouterr().out.splitlines()]
    assert printed == [
        "['bool', 'data', '---', 'bool', 'success', 'string', 'message']", "992ce8a1687cec8c8bd883ec73ca41d1",
    ]  # fmt: skip


def test_types_of_packages() -> None:
    assert "std_msgs/String" in rosmsg.list_msgs("std_msgs")
    assert "std_srvs/Empty" in rosmsg.list_srvs("std_srvs")
    assert list(rosmsg.rosmsg_search(None, rosmsg.MODE_SRV, "SetBool")) == ["std_srvs/SetBool"]
    folders = dict(rosmsg.iterate_packages(None, rosmsg.MODE_SRV))
    assert Path(folders["std_srvs"], "Empty.srv").is_file()
    assert rosmsg.get_msg_text("std_msgs/String", raw=True).startswith("string data")


def test_what_is_not_there() -> None:
    with pytest.raises(rosmsg.ROSMsgException, match=r"Unable to load msg \[a/B\]"):
        rosmsg.get_msg_text("a/B")
    with pytest.raises(rosmsg.ROSMsgException, match="Unknown srv type"):
        rosmsg.get_srv_text("std_msgs/String")
    with pytest.raises(OSError, match="cannot load"):
        rosmsg.rosmsg_md5(rosmsg.MODE_MSG, "a/B")
    with pytest.raises(ValueError, match="Unknown mode"):
        rosmsg.list_types("std_msgs", ".action")
