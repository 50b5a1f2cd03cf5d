"""The command line of rosparam: errors. What it does is compared with the real one in ``tests/interop``."""

from __future__ import annotations

import re

import pytest

from rosmini.ros.rospy.aliases.rosparam import yamlmain


@pytest.mark.parametrize(
    ("line", "code", "text"),
    [
        ("get /nothing", 1, "ERROR: "),
        ("set /x", 2, "Please specify a parameter value"),
        ("set -t no_such_file /x", 1, r"ERROR: file \[no_such_file\] cannot be read: No such file"),
        ("set -t a -b b /x", 2, "not allowed with"),
        ("load no_such_file", 1, "no_such_file"),
        ("get a b", 2, "unrecognized arguments: b"),
    ],
)
def test_errors(line, code, text, capsys):
    with pytest.raises(SystemExit) as caught:
        yamlmain(["rosparam", *line.split()])
    assert caught.value.code == code
    assert re.search(text, capsys.readouterr().err)


def test_the_usage_is_printed(capsys):
    with pytest.raises(SystemExit) as caught:
        yamlmain(["rosparam"])
    assert caught.value.code == 0
    assert "rosparam get" in capsys.readouterr().out
