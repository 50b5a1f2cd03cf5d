"""The report's walk (3.6) from an empty folder to a node of one's own, typed into a shell."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from rosmini.tools.main import main

from ..conftest import nightly
from ..processes import run

pytestmark = pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")

TOOLS = "catkin_make catkin_create_pkg catkin_init_workspace rosrun rospack roscd rosls rosversion"
FUNCTIONS = 'rosmini() { "$PYTHON" -m rosmini "$@"; }\n'
BARE = "".join(f'{name}() {{ rosmini {name} "$@"; }}\n' for name in TOOLS.split() if name != "roscd")
BARE += 'roscd() { cd "$(rosmini roscd "$@")"; }\n'

WALK = """
set -e
mkdir -p example_ws/src
cd example_ws/
{catkin_make}
. devel/setup.{shell}
cd src
{catkin_create_pkg} example_pkg std_msgs rospy roscpp
cd example_pkg
mkdir msg
echo "int64 num" > msg/Num.msg
"$PYTHON" ../../../edit.py
cd ../..
{catkin_make}
. devel/setup.{shell}
"$PYTHON" -c 'import rosmini.msgs; print("the message:", rosmini.msgs.message_class("example_pkg/Num")._full_text)'
mkdir src/example_pkg/scripts
cp ../talker.py src/example_pkg/scripts
{catkin_make}
chmod +x src/example_pkg/scripts/talker.py
"$PYTHON" ../edit.py script
{catkin_make}
. ./devel/setup.{shell}
{rospack} find example_pkg
{rospack} depends1 example_pkg
{rosls} example_pkg
rosmini run src/example_pkg/scripts/talker.py
"$PYTHON" devel/lib/example_pkg/talker.py imported
{catkin_make}
"""
EDIT = """
import os
import sys
from pathlib import Path
folder = Path("src/example_pkg") if len(sys.argv) > 1 else Path()
def change(name, *pairs):
    text = (folder / name).read_text()
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new, 1)
    (folder / name).write_text(text)
if len(sys.argv) > 1:
    block = "# catkin_install_python(PROGRAMS\\n#   scripts/my_script.py\\n"
    block += "#   DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}\\n# )"
    change("CMakeLists.txt", (block, block.replace("# ", "").replace("#", "").replace("my_script", "talker")))
else:
    change("package.xml", ("  <exec_depend>", "  <build_depend>message_generation</build_depend>\\n"
           "  <exec_depend>message_runtime</exec_depend>\\n  <exec_depend>"))
    messages = "# add_message_files(\\n#   FILES\\n#   Message1.msg\\n#   Message2.msg\\n# )"
    generate = "# generate_messages(\\n#   DEPENDENCIES\\n#   std_msgs\\n# )"
    change("CMakeLists.txt", ("  std_msgs\\n)", "  std_msgs\\n  message_generation\\n)"),
           (messages, "add_message_files(\\n  FILES\\n  Num.msg\\n)"), (generate, generate.replace("#", "")))
"""
TALKER = """#!/usr/bin/env python
import os
import sys
from example_pkg.msg import Num
if "imported" in sys.argv:
    print("imported", Num(num=3).num)
else:
    import rospy
    rospy.init_node("talker")
    rospy.loginfo("a number: %s", Num(num=42).num)
"""


@pytest.mark.processes
@pytest.mark.parametrize(("shell", "bare"), [("sh", False), *nightly(("bash", True))])
def test_the_walk_of_the_report_works_command_for_command(tmp_path: Path, shell: str, bare: bool) -> None:
    names = {name: name if bare else f"rosmini {name}" for name in TOOLS.split()}
    (tmp_path / "edit.py").write_text(EDIT, encoding="utf-8")
    (tmp_path / "talker.py").write_text(TALKER, encoding="utf-8")
    env = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "CMAKE_"))}
    env |= {"PYTHON": sys.executable, "ROS_HOME": str(tmp_path / ".ros")}
    text = FUNCTIONS + (BARE if bare else "") + WALK.format(shell=shell, **names)
    done = run([shell, "-c", text], env=env, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    folder = tmp_path / "example_ws/src/example_pkg"
    for line in (
        "0 built, 0 up to date, 0 failed",
        f"Successfully created files in {folder}. Please adjust the values in package.xml.",
        "Generating Python from MSG example_pkg/Num",
        "the message: int64 num",
        f"{folder}",
        "imported 3",
        "0 built, 1 up to date, 0 failed",
    ):
        assert line in done.stdout.splitlines(), done.stdout + done.stderr
    assert "a number: 42" in done.stdout + done.stderr
    warned = [line for line in done.stderr.splitlines() if "warning" in line]
    assert [f"chmod +x {folder / 'scripts/talker.py'}" in line for line in warned] == [True]


def command(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(list(words))
    said = capsys.readouterr()
    return status, said.out, said.err


def test_the_commands_themselves(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("CMAKE_PREFIX_PATH", raising=False)
    monkeypatch.chdir(tmp_path)
    status, out, err = command(capsys, "catkin_make")
    assert (status, out) == (1, f"Base path: {tmp_path}\n")
    assert err.startswith(f'The specified source space "{tmp_path / "src"}" does not exist\n')
    assert command(capsys, "catkin_init_workspace", "src")[0] == 2
    (tmp_path / "src").mkdir()
    assert command(capsys, "catkin_init_workspace", "src")[0] == 0
    status, _, err = command(capsys, "catkin_init_workspace", "src")
    assert (status, err) == (2, f'File "{tmp_path / "src" / "CMakeLists.txt"}" already exists\n')
    status, _, err = command(capsys, "catkin_create_pkg", "outside")
    assert status == 0
    assert "packages of a workspace are in its src" in err
    monkeypatch.chdir(tmp_path / "src")
    status, _, err = command(capsys, "catkin_create_pkg", "Talk", "rospy", "-d", "to <talk>", "-l", "MIT", "-l", "BSD",
                             "-a", "Ada", "-m", "Max", "-V", "1.2.3")  # fmt: skip
    assert status == 0
    assert err.startswith('WARNING: Package name "Talk" does not follow the naming conventions.')
    assert command(capsys, "catkin_create_pkg", "Talk")[::2] == (
        2, f"catkin_create_pkg: error: File exists: {tmp_path / 'src/Talk/package.xml'}\n"
    )  # fmt: skip
    assert command(capsys, "catkin_create_pkg", "../x")[0] == 2
    assert "write 1.2.3" in command(capsys, "catkin_create_pkg", "x", "-V", "1")[2]
    status, _, err = command(capsys, "catkin_make")
    assert status == 1
    assert f"run catkin_make in the folder above it: cd {tmp_path}" in err
    monkeypatch.chdir(tmp_path)
    status, out, _ = command(capsys, "catkin_make", "-j4", "-DCMAKE_BUILD_TYPE=Release", "--pkg", "Talk")
    assert status == 0
    assert "1 built, 0 up to date, 0 failed" in out
    assert "use pytest" in command(capsys, "catkin_make", "run_tests")[2]
    assert command(capsys, "catkin_make", "-C", "src/..", "nothing")[0] == 1
    assert command(capsys, "catkin_make", "clean")[1].endswith(f"Removed {tmp_path / 'devel'}\n")
    assert not (tmp_path / "build").exists()


def test_where_nothing_can_be_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src/CMakeLists.txt").touch()
    (tmp_path / "devel").touch()  # a file in the place of the folder, which stops root too
    monkeypatch.chdir(tmp_path)
    status, _, err = command(capsys, "catkin_make")
    assert status == 1
    assert f"cannot write {tmp_path / 'devel'}" in err


def test_a_command_to_copy_does_what_it_says_in_a_folder_of_any_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "my $(touch mark) ws"
    (folder / "src").mkdir(parents=True)
    monkeypatch.chdir(folder / "src")
    assert command(capsys, "catkin_create_pkg", "robot", "rospy")[0] == 0
    script = folder / "src/robot/scripts/it.py"
    script.parent.mkdir(exist_ok=True)
    script.write_text("#!/usr/bin/env python3\n", encoding="utf-8")
    script.chmod(0o644)
    monkeypatch.chdir(folder)
    _, out, err = command(capsys, "catkin_make")
    assert f"In each shell that uses it: . '{folder / 'devel/setup.sh'}'" in out + err
    if os.name != "nt":
        assert f"chmod +x '{script}'" in err
