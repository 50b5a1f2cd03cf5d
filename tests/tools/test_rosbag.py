"""`rosmini rosbag`: output and exit status of each verb."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, ROSBagException
from rosmini.tools.main import main
from rosmini.tools.rosbag import TOOL

from ..processes import run as run_process

String = message_class("std_msgs/String")


@pytest.fixture
def bag(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TZ", "UTC")
    with Bag("t.bag", "w") as bag:
        for i in range(20):
            bag.write("/chatter", String(f"hello {i}"), Time(100 + i))
    return tmp_path


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(["rosbag", *words])
    out, err = capsys.readouterr()
    return status, out, err


def test_info(bag, capsys):
    status, out, _ = run(capsys, "info", "t.bag", "t.bag")
    assert status == 0
    assert out.count("path:        t.bag\nversion:     2.0\nduration:    19.0s\n") == 2
    assert "\n---\n" in out
    assert "topics:      /chatter   20 msgs    : std_msgs/String\n" in out
    assert "20 msgs @ 1.0 Hz : std_msgs" in run(capsys, "info", "--freq", "t.bag")[1]
    assert "duration: 19.000000\n" in run(capsys, "info", "-y", "t.bag")[1]
    assert run(capsys, "info", "-f", "t.bag")[::2] == (
        2,
        "Usage: rosbag info [options] BAGFILE1 [BAGFILE2 BAGFILE3 ...]\n\nrosbag: error: no such option: -f\n",
    )
    nope = "ERROR reading nope.bag: [Errno 2] No such file or directory: 'nope.bag'\n"
    assert run(capsys, "info", "nope.bag") == (1, "", nope)


def test_the_tools_that_write(bag, capsys):
    assert run(capsys, "check", "t.bag") == (0, "Bag file does not need any migrations.\n", "")
    assert run(capsys, "filter", "t.bag", "f.bag", "t.secs < 105") == (0, "f.bag: 5 of 20 messages\n", "")
    out = run(capsys, "filter", "-p", "m.data", "t.bag", "f.bag", "t.secs < 101")[1]
    assert out.splitlines()[:2] == ["MATCH hello 0", "NO MATCH hello 1"]
    assert run(capsys, "filter", "t.bag", "t.bag", "True")[0] == 3
    assert run(capsys, "filter", "nope.bag", "f.bag", "True")[0] == 2
    assert "not allowed" in run(capsys, "filter", "t.bag", "f.bag", "open('x')")[2]
    assert run(capsys, "compress", "--lz4", "t.bag")[0] == 0
    assert Bag("t.bag").get_compression_info().compression == "lz4"
    assert "Backup path t.orig.bag already exists" in run(capsys, "decompress", "t.bag")[2]
    assert run(capsys, "decompress", "-f", "-q", "t.bag") == (0, "", "")
    assert Bag("t.bag").get_compression_info().compression == "none"


def test_reindex(bag, capsys):
    data = Path("t.bag").read_bytes()
    Path("t.bag").write_bytes(data[:-30])
    assert run(capsys, "info", "t.bag") == (1, "", "ERROR bag unindexed: t.bag.  Run rosbag reindex.\n")
    status, out, _ = run(capsys, "reindex", "t.bag")
    assert (status, out.splitlines()[0]) == (0, "t.bag: 20 messages")
    assert Path("t.orig.bag").read_bytes() == data[:-30]
    assert "messages: 20\n" in run(capsys, "info", "-y", "t.bag")[1]


def test_what_it_does_not_have(bag, capsys):
    assert run(capsys)[0] == 0
    assert "Unknown command: 'frob'" in run(capsys, "frob")[2]
    assert "a command of the original tool" in run(capsys, "encrypt", "t.bag")[2]
    assert run(capsys, "play")[0] == 2
    assert "--repeat-latched" in run(capsys, "record", "-h")[1]
    assert run(capsys, "record", "-O", "x")[2].endswith("You must specify a topic name or else use the '-a' option.\n")


SCRIPT = """
import rosbag, rospy
from std_msgs.msg import String
rospy.init_node("listener")
heard = []
rospy.Subscriber("chatter", String, lambda m: heard.append(m.data))
rospy.sleep(1.0)
with rosbag.Bag("out.bag", "w", compression=rosbag.Compression.BZ2) as bag:
    for text in heard:
        bag.write("/heard", String(text))
print("heard", len(heard), rosbag.Bag("out.bag").get_message_count(["/heard"]))
try:
    rosbag.Bag("listener.py")
except rosbag.ROSBagException as error:
    print(type(error).__name__)
"""


def test_playing_to_a_script_and_recording_it(bag):
    """The command itself: bag -> play -> script with rosbag of its own -> record."""
    Path("listener.py").write_text(SCRIPT, encoding="utf-8")
    words = [
        "record", "-q", "-O", "again", "/chatter", "+", "rosbag/play", "-q", "-r", "50", "t.bag", "+", "listener.py",
    ]  # fmt: skip
    done = run_process([sys.executable, "-m", "rosmini", "rosbag", *words],
        env={**os.environ, "PYTHONWARNINGS": "error"})  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == ["[listener] heard 20 20", "[listener] ROSBagFormatException"]
    assert [m.data for _, m, _ in Bag("again.bag")] == [f"hello {i}" for i in range(20)]


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("info",), 2, "You must specify at least 1 bag file."),
        (("check",), 2, "You must specify a bag file to check."),
        (("check", "none.bag"), 1, "ERROR reading none.bag: "),
        (("filter", "t.bag", "f.bag"), 2, "You must specify an expression."),
        (("filter", "t.bag", "f.bag", "True", "False"), 2, "Too many arguments."),
        (("filter", "-p", "m.", "t.bag", "f.bag", "True"), 1, "ERROR: "),
        (("filter", "listener.py", "f.bag", "True"), 1, "ERROR reading listener.py: "),
        (("filter", "t.bag", "nowhere/f.bag", "True"), 1, "ERROR writing nowhere/f.bag.part: No such file"),
        (("compress", "--output-dir", "out", "t.bag"), 1, "ERROR writing to out/t.bag: there is no folder out"),
        (("decrypt", "t.bag"), 2, "a bag that GnuPG has encrypted is read by a real ROS with its keys"),
        (("compress",), 2, "You must specify at least one bag file."),
    ],
)
def test_what_goes_wrong_is_said_and_leaves_nothing(bag, capsys, words, status, said):
    Path("listener.py").write_text(SCRIPT, encoding="utf-8")
    before = sorted(path.name for path in bag.iterdir())
    found, out, err = run(capsys, *words)
    assert (found, out) == (status, "")
    assert said in err
    assert sorted(path.name for path in bag.iterdir()) == before


def test_check_lists_types_that_differ(bag, capsys):
    data = Path("t.bag").read_bytes()
    Path("t.bag").write_bytes(data.replace(String._md5sum.encode(), b"0" * 32))
    status, out, _ = run(capsys, "check", "t.bag")
    first, *changes = out.splitlines()
    assert (status, first) == (0, "The following migrations need to occur:")
    assert [change.split("]")[0] for change in changes] == [f" * std_msgs/String [{'0' * 32}"]


def test_bags_are_written_to_another_folder(bag, capsys):
    (bag / "out").mkdir()
    assert run(capsys, "compress", "-q", "--output-dir", "out", "t.bag", "none.bag") == (
        1,
        "",
        "ERROR reading none.bag: [Errno 2] No such file or directory: 'none.bag'\n",
    )
    assert Bag("out/t.bag").get_compression_info().compression == "bz2"
    assert [path.name for path in bag.glob("*.bag")] == ["t.bag"]


def test_a_bag_that_is_not_there_is_an_error_of_ours(bag, capsys):
    """A notebook shows it without the frames of rosmini, and says which file may be meant."""
    with Graph() as graph:
        for words in (("play", "tt.bag"), ("record", "-O", "nowhere/x", "-a")):
            with pytest.raises(ROSBagException, match=r"Error opening file: .*: No such file") as caught:
                TOOL.run(*words, graph=graph)
            assert caught.value.__cause__ is None
            assert caught.value.__suppress_context__
            assert ("did you mean t.bag?" in str(caught.value)) == (words[0] == "play")


def test_a_recording_that_cannot_be_written_ends_with_one_line(bag, capsys):
    Path("listener.py").write_text(SCRIPT, encoding="utf-8")
    status, _, err = run(capsys, "record", "-O", "nowhere/x", "-a", "+", "listener.py")
    assert status == 1
    assert "Error opening file: nowhere/x.bag.active: No such file or directory" in err
    assert "Traceback" not in err
