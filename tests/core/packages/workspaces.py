"""Packages to ask about."""

from __future__ import annotations

from pathlib import Path

TAGS = {
    "alpha": "<depend>beta</depend><exec_depend>gamma</exec_depend><test_depend>nowhere</test_depend><export><beta "
    'plugin="${prefix}/plug.xml"/><cpp cflags="-I${prefix}/include"/></export>',
    "beta": "<build_depend>gamma</build_depend>",
    "gamma": "",
    "mixed": "<depend>gamma</depend><exec_depend>beta</exec_depend><depend>alpha</depend>"
    "<exec_depend>libboost</exec_depend>",
    "gathering": "<exec_depend>alpha</exec_depend><exec_depend>beta</exec_depend><export><metapackage/></export>",
}
PACKAGE = """<?xml version="1.0"?>
<package{format}><name>{name}</name><version>1.2.3</version><description>-</description>
<maintainer email="me@example.org">m</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>
{tags}</package>
"""


def a_workspace(folder: Path) -> Path:
    """Packages, a metapackage, and a package that is not named as its folder."""
    files = {
        f"{name}/package.xml": PACKAGE.format(name=name, format=' format="2"', tags=tags) for name, tags in TAGS.items()
    }
    tags = "<build_depend>gamma</build_depend><run_depend>alpha</run_depend>"
    files["other_folder/package.xml"] = PACKAGE.format(name="renamed", format="", tags=tags)
    files["alpha/sub/file"] = ""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder
