"""Reading scripts: encodings, and what is said about files that are no Python."""

import pytest

from rosmini.core.errors import ScriptError
from rosmini.ros.scripts.source import compile_script, read_script


def put(folder, name, data):
    path = folder / name
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return path


@pytest.mark.parametrize(
    "data",
    [
        b"#!/usr/bin/env python\nx = 'a'\n",
        b"#!/usr/bin/env python2.7\n# -*- coding: latin-1 -*-\nx = '\xe4'\n",
        b"\xef\xbb\xbfx = '\xc3\xa4'\n",
        b"x = 'a'\r\nfor i in ():\r\n    pass\r\n",
        b"",
    ],
)
def test_python_is_read(tmp_path, data):
    names = {"__tick__": lambda: None}
    exec(read_script(put(tmp_path, "node", data)).code, names)
    assert names.get("x", "a") in ("a", "ä")


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("talker", b"\x7fELF\x02\x01\x01\x00", "compiled program"),
        ("run.sh", "#!/bin/bash\necho hi\n", "a script for bash"),
        ("run", "#!/usr/bin/env -S node --x\n", "a script for node"),
        ("talker.cpp", "#include <ros/ros.h>\nint main() {}\n", "C++ source"),
        ("talker", "#include <ros/ros.h>\nint main() {}\n", "C or C++ source"),
        ("demo.launch", "<launch>\n</launch>\n", "a launch file"),
        ("demo", "<launch>\n</launch>\n", "a launch file"),
        ("log.bag", b"#ROSBAG V2.0\n", "a bag"),
        ("data.py", b"x\0y", "a binary file"),
        ("Chatter.msg", "string data\n", "a message definition"),
        ("broken.py", "def f(:\n    pass\n", "line 1: this is not Python"),
        ("coding.py", "# -*- coding: klingon -*-\n", "cannot be read as Python"),
        ("latin.py", b"x = '\xe4'\n", "cannot be read as Python"),
    ],
)
def test_other_files_are_named(tmp_path, name, data, said):
    path = put(tmp_path, name, data)
    with pytest.raises(ScriptError) as caught:
        read_script(path)
    assert said in str(caught.value)
    assert name in str(caught.value)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ('print "hello"', "print(...)"), ("print x, y", "print(...)"), ("exec 'x = 1'", "exec(...)"),
        ("raise ValueError, 'no'", "raise Error(message)"), ("if a <> b: pass", "!="), ("x = 0777", "0o"),
        ("x = 10L", "L"), ("x = `y`", "repr"), ("x = ur'a'", "r''"), ("def f(a, (b, c)): pass", "tuple"),
    ],
)  # fmt: skip
def test_python_2_is_recognised(line, said):
    with pytest.raises(ScriptError) as caught:
        compile_script(f"import os\n{line}\n".encode(), "/x/old.py")
    assert "/x/old.py, line 2: this is Python 2" in str(caught.value)
    assert said in str(caught.value)
    assert line in str(caught.value)


def test_mixed_tabs_are_named():
    with pytest.raises(ScriptError, match="tabs and spaces"):
        compile_script(b"if 1:\n        x = 1\n\ty = 2\n", "/x/old.py")


def test_caret_under_the_place():
    with pytest.raises(ScriptError) as caught:
        compile_script(b"if True:\n    x = (1, 2\n", "/x/a.py")
    shown, caret = str(caught.value).splitlines()[1:]
    assert shown[caret.index("^")] == "("


def test_a_missing_script_suggests_the_nearest(tmp_path):
    put(tmp_path, "talker.py", "")
    put(tmp_path, "listener.py", "")
    with pytest.raises(ScriptError, match=r"did you mean talker\.py\?"):
        read_script(tmp_path / "talkr.py")
    with pytest.raises(ScriptError, match=r"the scripts there are listener\.py, talker\.py"):
        read_script(tmp_path / "zzz.py")
    with pytest.raises(ScriptError, match="there is no folder"):
        read_script(tmp_path / "nowhere" / "talker.py")


def test_a_folder_lists_its_scripts(tmp_path):
    put(tmp_path, "talker.py", "")
    with pytest.raises(ScriptError, match=r"a folder, not a script; it holds talker\.py"):
        read_script(tmp_path)
