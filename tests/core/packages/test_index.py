"""The package index: what is found, in which order, and what is said when something is not found or broken."""

from __future__ import annotations

import json
import os
import stat
import warnings
from pathlib import Path

import pytest
import rospkg
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import DefinitionError, RosminiError, ScriptError, UnknownPackage
from rosmini.core.packages import BUILT_IN, PackageIndex, assets_dir, folders, search_paths
from rosmini.core.packages.executables import built_in_nodes, scripts

DATA = Path(__file__).parents[2] / "data"
MANIFEST = """<?xml version="1.0"?>
<package format="2">
  <name>{name}</name>
  <version>{version}</version>
  <description>
    A package,
    for tests.
  </description>
  <maintainer email="someone@example.org">Someone</maintainer>
  <license>Apache-2.0</license>
{more}</package>
"""

posix_only = pytest.mark.skipif(os.name == "nt", reason="Windows has no run bit, and links need a privilege there")


def make(folder: Path, name: str, version: str = "1.2.3", more: str = "") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(MANIFEST.format(name=name, version=version, more=more), encoding="utf-8")
    return folder


def write(path: Path, text: str = "#!/usr/bin/env python3\n", *, run_bit: bool = False) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    if run_bit:
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.fixture(scope="module")
def own() -> PackageIndex:
    return PackageIndex([assets_dir() / "ros"])


def md5_table() -> dict[str, str]:
    return {
        **json.loads((DATA / "ros_md5.json").read_text(encoding="utf-8")),
        **json.loads((DATA / "ros_md5_more.json").read_text(encoding="utf-8")),
    }


# ---- the packages that rosmini brings ----


@pytest.mark.parametrize("name", sorted({full.partition("/")[0] for full in md5_table()}))
def test_each_package_of_the_md5_tables_has_a_manifest_without_fault(own: PackageIndex, name: str) -> None:
    from catkin_pkg.package import parse_package

    found: list[str] = []
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        parsed = parse_package(str(own.path(name)), warnings=found)
        parsed.validate(warnings=found)
    assert found == []
    assert parsed.name == name == own.path(name).name
    assert "message_generation" in [each.name for each in parsed.build_depends]
    assert "message_runtime" in [each.name for each in parsed.exec_depends]


def test_each_type_of_the_md5_tables_comes_from_one_file(own: PackageIndex) -> None:
    parts = {
        "msg": [""],
        "srv": ["", "Request", "Response"],
        "action": ["Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback"],
    }
    made = [
        f"{package}/{path.stem}{part}"
        for package in own.names()
        for kind in parts
        for path in own.path(package).glob(f"{kind}/*.{kind}")
        for part in parts[kind]
    ]
    assert len(made) == len(set(made))
    assert set(md5_table()) <= set(made)


def test_manifests_name_the_packages_whose_types_they_use(own: PackageIndex) -> None:
    for name in own.names():
        package = own.find(name)
        files = [path for kind in ("msg", "srv", "action") for path in package.path.glob(f"{kind}/*.{kind}")]
        if not files:
            continue
        used = {"actionlib_msgs", "std_msgs"} if any(path.suffix == ".action" for path in files) else set()
        for path in files:
            words = [line.split("#")[0].split() for line in path.read_text(encoding="utf-8").splitlines()]
            types = [line[0] for line in words if line]
            used |= {each.partition("/")[0] for each in types if "/" in each}
            used |= {"std_msgs"} if "Header" in types else set()
        needed = used - {name} | {"message_generation", "message_runtime"}
        assert needed <= set(package.depends), name
        has_plugins = "<nav_core " in (package.path / "package.xml").read_text(encoding="utf-8")
        if not built_in_nodes(name) and not scripts(package.path) and not has_plugins:  # these need more than types do
            assert set(package.depends) == needed, name


def test_every_manifest_of_the_core_can_be_read_and_names_what_is_known() -> None:
    index = PackageIndex([assets_dir() / "ros", assets_dir() / "core"])
    for name in sorted(each.name for each in (assets_dir() / "core").iterdir()):
        package = index.find(name)
        assert package.name == name
        assert [each for each in package.exec_depends if each not in index and each not in BUILT_IN] == []
    assert {each for each in BUILT_IN if each in index} == set()


def test_rospkg_finds_the_same_packages(own: PackageIndex) -> None:
    theirs = rospkg.RosPack([str(assets_dir() / "ros")])
    assert own.names() == sorted(theirs.list())
    assert {name: str(own.path(name)) for name in own.names()} == {n: theirs.get_path(n) for n in theirs.list()}


def test_assets_come_last_and_a_workspace_overlays_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    overlay = make(tmp_path / "ws" / "src" / "turtlesim", "turtlesim", version="9.9.9")
    monkeypatch.setenv("ROS_PACKAGE_PATH", os.pathsep.join([str(tmp_path / "gone"), str(tmp_path / "ws")]))
    assert search_paths() == (tmp_path / "gone", tmp_path / "ws", assets_dir() / "ros", assets_dir() / "core")
    index = PackageIndex()
    assert index.find("turtlesim").path == overlay
    assert index.find("turtlesim").version == "9.9.9"
    assert index.find("std_msgs").path == assets_dir() / "ros" / "std_msgs"


def test_without_ros_package_path_there_are_the_assets(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    assert "geometry_msgs" in PackageIndex()
    assert search_paths({"ROS_PACKAGE_PATH": ""}) == (assets_dir() / "ros", assets_dir() / "core")


def test_assets_are_found_in_a_checkout_and_in_an_installed_wheel(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, root: Path
) -> None:
    assert assets_dir() == root / "assets"
    monkeypatch.setattr(folders, "__file__", str(tmp_path / "site" / "rosmini" / "core" / "packages" / "folders.py"))
    with pytest.raises(RosminiError, match="install rosmini again"):
        assets_dir()
    (tmp_path / "site" / "rosmini" / "_assets").mkdir(parents=True)
    assert assets_dir() == tmp_path / "site" / "rosmini" / "_assets"


# ---- the search ----


def test_the_name_is_that_of_the_manifest_not_of_the_folder(tmp_path: Path) -> None:
    folder = make(tmp_path / "some-checkout", "my_robot", more="  <depend>std_msgs</depend>\n")
    package = PackageIndex([tmp_path]).find("my_robot")
    assert (package.name, package.path, package.version) == ("my_robot", folder, "1.2.3")
    assert package.description == "A package, for tests."
    assert package.depends == ("std_msgs",)
    assert not package.is_metapackage


def test_ignored_and_nested_and_hidden_folders_are_not_entered(tmp_path: Path) -> None:
    make(tmp_path / "a", "a")
    make(tmp_path / "a" / "inner", "inner")
    make(tmp_path / "b", "b")
    write(tmp_path / "b" / "CATKIN_IGNORE")
    make(tmp_path / "c" / "deep", "deep")
    write(tmp_path / "c" / "CATKIN_IGNORE")
    make(tmp_path / "d" / "deeper", "deeper")
    write(tmp_path / "d" / "rospack_nosubdirs")
    make(tmp_path / ".hidden", "hidden")
    make(tmp_path / "e" / "f" / "g", "g")
    assert PackageIndex([tmp_path]).names() == ["a", "g"]
    assert sorted(rospkg.RosPack([str(tmp_path)]).list()) == ["a", "g"]


@posix_only
def test_links_are_followed_and_may_run_in_a_circle(tmp_path: Path) -> None:
    make(tmp_path / "elsewhere" / "pkg", "linked")
    ws = tmp_path / "ws"
    ws.mkdir()
    (ws / "there").symlink_to(tmp_path / "elsewhere")
    (ws / "round").symlink_to(ws)
    assert PackageIndex([ws]).names() == ["linked"]


@given(order=st.permutations(["a", "b", "c", "d"]))
def test_of_two_packages_of_one_name_the_first_wins_however_the_disk_lists_them(
    order: list[str], tmp_path_factory: pytest.TempPathFactory
) -> None:
    base = tmp_path_factory.mktemp("dup")
    for name in order:
        make(base / name, "same")
    assert PackageIndex([base]).path("same") == base / "a"
    assert PackageIndex([base / "c", base / "b"]).path("same") == base / "c"


def test_what_a_manifest_says(tmp_path: Path) -> None:
    """Conditions are those of ROS 1; the folder of the path may itself be the package; a refresh reads it again."""
    condition = '<depend condition="$ROS_VERSION == {}">{}</depend>\n'
    more = condition.format(1, "rospy") + condition.format(2, "rclpy")
    index = PackageIndex([str(tmp_path / "one")])
    assert index.names() == []
    make(tmp_path / "one", "one", more=more)
    manifest = tmp_path / "one" / "package.xml"
    manifest.write_text(manifest.read_text(encoding="utf-8").replace('format="2"', 'format="3"'), encoding="utf-8")
    package = index.find("one")
    assert (package.path, package.depends, package.is_metapackage) == (tmp_path / "one", ("rospy",), False)
    make(tmp_path / "one", "one", more="  <exec_depend>x</exec_depend>\n  <export><metapackage/></export>\n")
    index.refresh()
    package = index.find("one")
    assert (package.depends, package.is_metapackage) == (("x",), True)


def test_an_unknown_package_names_the_folders_and_the_nearest(tmp_path: Path) -> None:
    make(tmp_path / "ws" / "turtle_talk", "turtle_talk")
    index = PackageIndex([tmp_path / "ws", tmp_path / "gone"])
    with pytest.raises(UnknownPackage) as caught:
        index.find("turtle_tlak")
    text = str(caught.value)
    assert "did you mean turtle_talk?" in text
    assert str(tmp_path / "ws") in text
    assert f"{tmp_path / 'gone'}  (there is no such folder)" in text


def test_what_it_needs_to_run_comes_in_the_order_of_rospack(own: PackageIndex) -> None:
    # $ rospack depends1 gazebo_msgs, of real ROS on this manifest
    assert own.find("gazebo_msgs").exec_depends == ("message_runtime", "geometry_msgs", "std_msgs", "trajectory_msgs")


# ---- broken manifests ----


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("<package>\n  <name>p</name>\n  <version>1\n</package>\n", 4, "mismatched tag"),
        ("", 1, "no element found"),
        ("<stack/>", 1, "<stack>"),
        ('<?xml version="1.0"?>\n<package format="2">\n  <version>1.0.0</version>\n</package>', 2, "no name"),
        ('<!DOCTYPE x [\n<!ENTITY a "aaaa">\n]>\n<package><name>&a;</name></package>', 2, "entities"),
        ('<?xml version="1.0" encoding="nonsense-8"?>\n<package/>', 1, "XML"),
    ],
)
def test_a_manifest_that_cannot_be_read_names_file_and_line(tmp_path: Path, text: str, line: int, says: str) -> None:
    manifest = write(tmp_path / "p" / "package.xml", text)
    index = PackageIndex([tmp_path])
    with pytest.raises(DefinitionError, match=says) as caught:
        index.find("p")
    assert (caught.value.file, caught.value.line) == (str(manifest), line)
    assert str(caught.value).startswith(f"{manifest}:{line}: ")


def test_a_broken_manifest_hides_no_other_package(tmp_path: Path) -> None:
    bad = write(tmp_path / "bad" / "package.xml", "<package>")
    make(tmp_path / "good", "good")
    index = PackageIndex([tmp_path])
    assert index.names() == ["good"]
    assert [problem.file for problem in index.problems()] == [str(bad)]
    with pytest.raises(UnknownPackage, match=r"could not be read: .*package\.xml:1"):
        index.find("other")


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        ("<version>1.0.0", "<version>one", 4, "version"),
        ("<license>Apache-2.0</license>", "", 2, "license"),
        ("someone@example.org", "nobody", 9, "nobody"),
        ('<maintainer email="someone@example.org">', "<maintainer>", 9, "email"),
        ("<license>", '<license colour="red">', 10, "colour"),
        ('format="2"', 'format="x"', 2, "x"),
        ("<name>p</name>", "<name>p q</name>", 3, "naming conventions"),
        ("</package>", '  <depend condition="$A ==">a</depend>\n</package>', 11, "condition"),
    ],
)
def test_a_manifest_against_the_rules_names_what_is_at_fault(
    tmp_path: Path, old: str, new: str, line: int, says: str
) -> None:
    text = MANIFEST.format(name="p", version="1.0.0", more="").replace(old, new).replace('format="2"', 'format="3"')
    manifest = write(tmp_path / "p" / "package.xml", text)
    index = PackageIndex([tmp_path])
    with pytest.raises(DefinitionError, match=says) as caught:
        index.find(index.names()[0])
    assert (caught.value.file, caught.value.line) == (str(manifest), line)
    assert "Error(s)" not in str(caught.value)
    assert "\n" not in str(caught.value)


# ---- files ----


def test_resolve_gives_the_file_of_an_address(own: PackageIndex) -> None:
    assert own.resolve("package://turtlesim/msg/Pose.msg") == own.path("turtlesim") / "msg" / "Pose.msg"
    assert own.resolve("package://turtlesim") == own.path("turtlesim")


def test_resolve_says_what_is_wrong(own: PackageIndex) -> None:
    with pytest.raises(RosminiError, match=r"did you mean Pose\.msg\?"):
        own.resolve("package://turtlesim/msg/Posse.msg")
    with pytest.raises(RosminiError, match="did you mean msg"):
        own.resolve("package://turtlesim/msgs/Pose.msg")
    with pytest.raises(UnknownPackage, match="did you mean turtlesim"):
        own.resolve("package://turtelsim/msg/Pose.msg")
    for wrong in ("/etc/passwd", "file:///x", "package:/turtlesim/x", "package://"):
        with pytest.raises(RosminiError, match="package://NAME/PATH"):
            own.resolve(wrong)


# ---- executables ----


@pytest.fixture
def ws(tmp_path: Path) -> Path:
    folder = make(tmp_path / "ws" / "talk", "talk")
    write(folder / "scripts" / "talker.py", run_bit=True)
    write(folder / "nodes" / "listener.py")
    write(folder / "src" / "talk" / "__init__.py", "")
    write(folder / "src" / "talk" / "helper.py", "")
    write(folder / "launch" / "start.launch", "<launch/>")
    return folder


@posix_only
def test_executables_are_scripts_and_programs_with_the_run_bit(ws: Path) -> None:
    write(ws / "tools" / "go", run_bit=True)
    write(ws / "src" / "talker.py", run_bit=True)
    index = PackageIndex([ws.parent])
    assert index.executables("talk") == ["go", "listener.py", "talker.py"]
    for name, path, has_run_bit in (
        ("talker.py", "scripts/talker.py", True),  # not the one in src/
        ("listener.py", "nodes/listener.py", False),
        ("go", "tools/go", True),
    ):
        found = index.find_executable("talk", name)
        assert (found.path, found.has_run_bit) == (ws / path, has_run_bit)


@pytest.mark.parametrize(
    ("package", "name", "error", "says"),
    [
        ("talk", "talker", ScriptError, r"ws.talk.*did you mean talker\.py\?|did you mean talker\.py\?.*ws.talk"),
        ("talk", "zzz", ScriptError, r"the package has: listener\.py, talker\.py"),
        ("talk", "start.launch", ScriptError, r"not executable.*chmod \+x .*start\.launch"),
        ("std_msgs", "talker.py", ScriptError, "has no executables"),
        ("std_msg", "talker.py", UnknownPackage, "did you mean std_msgs"),
    ],
)
def test_an_executable_that_is_not_found_names_the_nearest(
    ws: Path, package: str, name: str, error: type[Exception], says: str
) -> None:
    with pytest.raises(error, match=f"(?s){says}"):
        PackageIndex([ws.parent, assets_dir() / "ros"]).find_executable(package, name)


def test_built_in_nodes_come_from_entry_points(
    ws: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, own: PackageIndex
) -> None:
    info = tmp_path / "site" / "plugin-1.0.dist-info"
    write(info / "METADATA", "Metadata-Version: 2.1\nName: plugin\nVersion: 1.0\n")
    lines = ["[rosmini.nodes]", "talk/built_in = json:dumps", "talk/talker.py = json:loads"]
    lines += ["only_pip/node = json:dumps", "only_pip/gone = json:nothing_of_the_kind"]
    write(info / "entry_points.txt", "\n".join(lines) + "\n")
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    index = PackageIndex([ws.parent])
    assert index.executables("talk") == ["built_in", "listener.py", "talker.py"]
    assert index.find_executable("talk", "built_in").load() is json.dumps
    assert index.find_executable("talk", "talker.py").path is not None, "a script of the package comes first"
    assert own.executables("only_pip") == ["gone", "node"]
    assert own.find_executable("only_pip", "node").load() is json.dumps
    with pytest.raises(ScriptError, match="json:nothing_of_the_kind"):
        own.find_executable("only_pip", "gone").load()
    with pytest.raises(ScriptError, match="did you mean node"):
        own.find_executable("only_pip", "nodes")
    with pytest.raises(ScriptError, match="is a file"):
        index.find_executable("talk", "talker.py").load()
