"""Packages as pictures: their folders, and what they need."""

import os

import pytest

from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex
from rosmini.viz.package_pictures import package_graph, package_tree, workspace_tree

MANIFEST = """<package format="2"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="ada@example.org">a</maintainer><license>MIT</license>{rest}</package>"""


@pytest.fixture
def index(tmp_path):
    """Two packages and a metapackage."""

    def package(name, rest):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "package.xml").write_text(MANIFEST.format(name=name, rest=rest), encoding="utf-8")
        return folder

    eyes = package("eyes", "<depend>wheels</depend><exec_depend>nowhere</exec_depend>")
    (eyes / "msg").mkdir()
    for number in range(12):
        (eyes / "msg" / f"M{number:02}.msg").touch()
    (eyes / ".hidden").touch()
    package("wheels", "")
    package("robot", "<exec_depend>eyes</exec_depend><export><metapackage/></export>")
    return PackageIndex([tmp_path])


def test_a_folder_is_shown_with_what_its_parts_are_for(index):
    text = package_tree("eyes", index=index, title="Figure 1").text
    assert text.splitlines()[:5] == [
        "Figure 1:",
        "eyes  (a package)",
        "  package.xml  (the manifest)",
        "  msg/  (definitions of messages)",
        "    M00.msg",
    ]
    assert text.endswith("    M07.msg\n    ...  (4 more)")
    assert "hidden" not in text
    assert package_tree("robot", index=index).text.startswith("robot  (a metapackage)")


def test_a_graph_follows_the_manifests_as_far_as_asked(index):
    text = package_graph("robot", index=index).text.splitlines()
    assert text[0].endswith("2 packages") and text[1:] == ["robot -> eyes", "metapackages: robot"]
    deep = package_graph("robot", depth=3, index=index, title="Figure 2")
    assert deep.text.splitlines() == [
        "Figure 2: 4 packages",
        "eyes -> nowhere, wheels",
        "robot -> eyes",
        "metapackages: robot",
    ]
    assert deep.alt.startswith("Graph of 4 packages. eyes needs nowhere, wheels")
    for name in ("robot", "eyes", "wheels", "nowhere"):
        assert name in deep.svg


def test_what_is_not_there_is_an_error(index):
    for draw in (package_tree, package_graph):
        with pytest.raises(RosminiError, match="eyes"):
            draw("eye", index=index)
    with pytest.raises(RosminiError, match="name of a package"):
        package_graph()


def test_a_workspace_is_shown_with_its_spaces(tmp_path, index, monkeypatch):
    base = tmp_path / "robot_ws"
    for each in ("src", "build", "devel/lib/python3"):
        (base / each).mkdir(parents=True)
    (base / "devel" / ".catkin").touch()
    (base / "devel" / "setup.bash").touch()
    (tmp_path / "eyes").rename(base / "src" / "eyes")
    text = workspace_tree(devel=base / "devel", title="Figure 1").text
    assert [line.partition("  (")[0] for line in text.splitlines()] == [
        "Figure 1:", "robot_ws/", "  build/", "  devel/", "    setup.bash", "    lib/", "  src/", "    eyes/",
    ]  # fmt: skip
    monkeypatch.setenv("CMAKE_PREFIX_PATH", f"{tmp_path}{os.pathsep}{base / 'devel'}")
    lines = workspace_tree("src").text.splitlines()
    assert [line.split()[0] for line in lines[:4]] == ["robot_ws/src/", "eyes/", "package.xml", "msg/"]
    with pytest.raises(RosminiError, match="no folder 'install'"):
        workspace_tree("install")
    monkeypatch.setenv("CMAKE_PREFIX_PATH", "")
    with pytest.raises(RosminiError, match="no workspace is in use"):
        workspace_tree()
