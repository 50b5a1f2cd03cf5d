"""Checks of the exercises in the chapter catkin: how packages are built."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosmini.book.checks import Wrong, call_bounded, exercise, expect, expect_type
from rosmini.ros.catkin import CatkinError, Report, Workspace, make

# ---- build_order: in which order ----

WORKSPACES: tuple[dict[str, list[str]], ...] = (
    {"alarm": ["rospy", "bumper_msgs"], "bumper_msgs": ["std_msgs"]},
    {"zoo": [], "ape": ["zoo", "rospy"], "bear": ["ape"], "cat": ["bear", "zoo"], "dog": []},
    {"robot": ["arm", "base"], "arm": ["motor"], "base": ["motor", "tf"], "motor": ["robot_msgs"], "robot_msgs": []},
    {},
)

CIRCLES: tuple[dict[str, list[str]], ...] = (
    {"chicken": ["egg"], "egg": ["chicken"]},
    {"base": ["rospy"], "a": ["b"], "b": ["c", "base"], "c": ["a"]},
)


@exercise("build_order", praise="catkin_make starts with the same computation.")
def build_order(answer: Any) -> None:
    """An order in which each package comes after its dependencies; ValueError for a cycle."""
    for needs in WORKSPACES:
        found = call_bounded(answer, {name: list(each) for name, each in needs.items()})
        expect_type(found, list, "It returned", "a list", "return the names in a list")
        twice = [name for name in found if found.count(name) > 1]
        expect(not twice, f"{twice[0] if twice else ''} is built twice.")
        extra = [name for name in found if name not in needs]
        expect(not extra, f"{', '.join(map(str, extra))} is not in the workspace {sorted(needs)}.")
        missing = [name for name in needs if name not in found]
        expect(not missing, f"{', '.join(missing)} is not built.", "every key of needs is a package to build")
        for name, others in needs.items():
            for other in others:
                expect(
                    other not in needs or found.index(other) < found.index(name),
                    f"{name} needs {other}, but comes before it in {found}.",
                )
    for needs in CIRCLES:
        try:
            found = call_bounded(answer, {name: list(each) for name, each in needs.items()})
        except ValueError:
            continue
        except RecursionError as error:
            raise Wrong(
                f"{needs} contains a cycle, and your function follows it for ever.",
                "detect it, and raise ValueError(...)",
            ) from error
        raise Wrong(
            f"{needs} contains a cycle, but your function returned {found!r}.", "detect it, and raise ValueError(...)"
        )


# ---- rain_and_wind: rain and wind ----

FILES = {
    "msg/Rain.msg": "float32 amount\n",
    "msg/Wind.msg": "geometry_msgs/Vector3 velocity\n",
    "srv/Forecast.srv": "duration ahead\n---\nbool rain\n",
    "package.xml": """<?xml version="1.0"?>
<package format="2">
  <name>weather</name>
  <version>0.1.0</version>
  <description>Messages about the weather.</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <depend>geometry_msgs</depend>
  <exec_depend>message_runtime</exec_depend>
</package>
""",
}

MADE = ("msg/_Rain.py", "msg/_Wind.py", "srv/_Forecast.py")


@exercise("rain_and_wind", praise="Packages that depend on weather can import all three classes.")
def cmake(answer: object) -> None:
    """The CMakeLists.txt of a package with two messages and a service."""
    expect_type(answer, str, "cmake is", "a text")
    with TemporaryDirectory() as folder:
        workspace = Workspace(*(Path(folder, each) for each in ("", "src", "build", "devel")))
        package = workspace.source / "weather"
        for name, text in (FILES | {"CMakeLists.txt": str(answer)}).items():
            (package / name).parent.mkdir(parents=True, exist_ok=True)
            (package / name).write_text(text, encoding="utf-8")
        report = _built(workspace)
        said = [str(each).replace(f"{package}/", "") for each in report.findings]
        expect(
            not said,
            f"catkin_make says: {said[0] if said else ''}",
            "the manifest is correct; the mistake is in CMakeLists.txt",
        )
        made = workspace.devel / "lib" / "python3" / "dist-packages" / "weather"
        missing = [name for name in MADE if not (made / name).is_file()]
        expect(
            not missing,
            f"catkin_make did not generate {', '.join(missing)}.",
            "call add_message_files, add_service_files and generate_messages",
        )
    exported = str(answer).partition("catkin_package")[2].partition(")")[0].split()
    for name in ("message_runtime", "geometry_msgs"):
        expect(
            name in exported,
            f"catkin_package() does not declare that users of weather need {name}.",
            "list it after CATKIN_DEPENDS",
        )


def _built(workspace: Workspace) -> Report:
    try:
        return make(workspace, say=len)
    except CatkinError as error:
        said = str(error).replace(f"{workspace.source}/", "")
        raise Wrong(f"catkin_make refuses it: {said}") from error


# ---- which_one: which one is it ----

NOETIC, BASE, TRY = "/opt/ros/noetic", "~/base_ws", "~/try_ws"

FOUND = {
    "bob": {"move_base": NOETIC, "amcl": BASE, "alarm": BASE},
    "ada": {"move_base": TRY, "amcl": BASE, "alarm": TRY},
}


@exercise("which_one", praise="On the same computer, each person finds a different version.")
def found(answer: Any) -> None:
    """The workspaces in which Bob and Ada find three packages."""
    expect(
        isinstance(answer, tuple | list) and len(answer) == len(FOUND),
        "The answer must be two dictionaries: one for Bob and one for Ada.",
        "call check(number, (bob, ada))",
    )
    for (who, right), given in zip(FOUND.items(), answer, strict=True):
        expect_type(given, dict, f"{who} is", "a dictionary", 'write {"amcl": "~/base_ws", ...}')
        for name, workspace in right.items():
            expect(name in given, f"{who} has no entry for {name}.")
            hint = (
                "sourcing base_ws hides the workspaces on top of it"
                if given[name] == TRY
                else "the search goes from top to bottom and ends at the first package of that name"
            )
            expect(given[name] == workspace, f"{who} does not find {name} in {given[name]}.", hint)
