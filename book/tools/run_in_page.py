"""The button *Run in this page*: the pages that have it, and the packages that they load.

`book/static/run.js` is the button. `book/static/run-worker.js` starts Pyodide, which runs the cells in the shell of
`rosmini.notebook.page`.
"""

from __future__ import annotations

import re
from importlib.metadata import distribution
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from . import wasm

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sphinx.application import Sphinx

PLOTS = ("numpy", "pillow", "matplotlib")

PAGES = {
    "notebooks/1_start/10_first_steps": ("numpy", "pillow"),
    "notebooks/2_graph/10_nodes_and_master": ("numpy",),
    "notebooks/2_graph/20_topics_and_messages": PLOTS,
    "notebooks/2_graph/30_services": ("numpy",),
    "notebooks/2_graph/40_actionlib": ("numpy",),
    "notebooks/2_graph/50_parameter_server": ("numpy",),
    "notebooks/2_graph/60_names": ("numpy",),
    "notebooks/2_graph/65_threads_and_spin": PLOTS,
    "notebooks/2_graph/70_bags": PLOTS,
    "notebooks/2_graph/80_frames": PLOTS,
    "notebooks/3_robot/10_turtlebot3": PLOTS,
    "notebooks/3_robot/20_teleoperation": PLOTS,
    "notebooks/3_robot/30_odometry": PLOTS,
    "notebooks/3_robot/40_family_and_description": ("numpy", "pillow"),
    "notebooks/4_files/10_environment": ("numpy",),
    "notebooks/4_files/20_command_line": ("numpy",),
    "notebooks/4_files/30_file_system": ("numpy",),
    "notebooks/4_files/40_from_scratch": (),
    "notebooks/4_files/50_catkin": (),
    "notebooks/4_files/60_logging": ("numpy",),
    "notebooks/4_files/70_dynamic_reconfigure": PLOTS,
    "notebooks/4_files/80_launch_files": ("numpy",),
    "notebooks/5_turtlesim/10_turtlesim_nodes": ("numpy",),
    "notebooks/5_turtlesim/20_turtlesim_topics": ("numpy",),
    "notebooks/5_turtlesim/30_motion_node": ("numpy",),
    "notebooks/5_turtlesim/40_many_machines": ("numpy",),
    "notebooks/5_turtlesim/50_logo": ("numpy",),
    "notebooks/6_simulators/10_simulation_and_stage": PLOTS,
    "notebooks/6_simulators/20_gazebo": ("numpy", "pillow"),
    "notebooks/6_simulators/30_rviz": ("numpy", "pillow"),
    "notebooks/6_simulators/40_rqt": PLOTS,
    "notebooks/7_navigation/10_navigation_stack": ("numpy", "pillow"),
    "notebooks/7_navigation/20_maps": PLOTS,
    "notebooks/7_navigation/30_costmaps": PLOTS,
    "notebooks/7_navigation/40_global_planners": PLOTS,
    "notebooks/7_navigation/50_local_planners": PLOTS,
    "notebooks/7_navigation/60_amcl": PLOTS,
    "notebooks/7_navigation/70_gmapping": PLOTS,
    "notebooks/7_navigation/80_hector_mapping": PLOTS,
    "notebooks/7_navigation/90_move_base": PLOTS,
    "notebooks/7_navigation/95_tune_and_fix": ("numpy", "pillow"),
    "notebooks/8_use_cases/10_navigation_goal": PLOTS,
    "notebooks/8_use_cases/20_frontier_exploration": PLOTS,
    "notebooks/8_use_cases/30_explore_lite": ("numpy", "pillow"),
    "notebooks/8_use_cases/40_many_turtlebots": PLOTS,
    "notebooks/8_use_cases/50_beyond": ("numpy", "pillow"),
    "notebooks/8_use_cases/60_project": ("numpy", "pillow"),
    "notebooks/9_deeper/20_publish_subscribe": ("numpy",),
    "notebooks/9_deeper/30_when_things_go_wrong": ("numpy", "pillow"),
    "notebooks/9_deeper/40_how_it_works": PLOTS,
}
"""The pages whose cells run in the browser, and the packages of Pyodide that they import."""

CORE_MB = 5.5
"""Size of Pyodide's own files, as they are sent [MB]."""

PACKAGE_MB = {"numpy": 3.6, "pillow": 1.3, "matplotlib": 10.4}
"""Sizes of Pyodide's packages [MB]; matplotlib's with the packages that only it needs."""

PURE = [
    "asttokens",
    "catkin-pkg",
    "comm",
    "defusedxml",
    "docutils",
    "executing",
    "h11",
    "ipython",
    "ipython-pygments-lexers",
    "ipywidgets",
    "matplotlib-inline",
    "meshcat",
    "packaging",
    "platformdirs",
    "prompt-toolkit",
    "pure-eval",
    "pygments",
    "pyparsing",
    "python-dateutil",
    "PyYAML",
    "stack-data",
    "traitlets",
    "u-msgpack-python",
    "wcwidth",
    "xacro",
]
"""The packages in Python alone that a page's shell and rosmini import."""

CHECKOUT = Path(__file__).resolve().parents[2]


def files() -> Iterator[tuple[str, Path]]:
    """Yield name and path of each file that a page unpacks: rosmini, and the pure packages with their licences."""
    folders = {CHECKOUT / "rosmini": "rosmini"}
    folders |= {CHECKOUT / "assets" / name: f"rosmini/_assets/{name}" for name in ("core", "ros")}
    for folder, name in folders.items():
        for path in sorted(folder.rglob("*")):
            if path.is_file() and path.suffix != ".pyi" and path.parent.name != "__pycache__":
                yield f"{name}/{path.relative_to(folder).as_posix()}", path
    if loops := wasm.library():
        yield "rosmini/core/geometry/kernels.wasm", loops
    for name in PURE:
        for file in sorted(distribution(name).files or []):
            is_wanted = file.suffix in {".py", ".json"} or re.search("licen[cs]e|copying", file.name, re.IGNORECASE)
            if is_wanted and ".." not in file.parts:
                yield file.as_posix(), Path(str(file.locate()))
    for file in distribution("rosmini-ros").files or []:
        if file.name in {"METADATA", "entry_points.txt", "LICENSE"}:
            yield file.as_posix(), Path(str(file.locate()))


def write_packages(archive: Path) -> None:
    """Write the ZIP file of all of them; the same files give the same bytes."""
    archive.parent.mkdir(parents=True, exist_ok=True)
    with ZipFile(archive, "w", ZIP_DEFLATED) as written:
        for name, path in files():
            entry = ZipInfo(name)
            entry.external_attr = (path.stat().st_mode & 0o777) << 16
            written.writestr(entry, path.read_bytes(), ZIP_DEFLATED)


def add_packages(app: Sphinx) -> None:
    """Put the packages beside the scripts."""
    if app.builder.name == "html":
        write_packages(Path(app.outdir, "_static", "packages.zip"))


def add_button(app: Sphinx, pagename: str, *_: Any) -> None:
    """Add the script of the button to the pages that have it."""
    if pagename in PAGES and app.builder.name == "html":
        archive = Path(app.outdir, "_static", "packages.zip")
        more = sum(size for name, size in PACKAGE_MB.items() if name not in PAGES[pagename])
        size = CORE_MB + archive.stat().st_size / 1e6 + sum(PACKAGE_MB.values()) - more
        attributes: dict[str, Any] = {
            "data-megabytes": f"{size:.0f}",
            "data-more": f"A plot loads {more:.0f} MB more." if more else "",
        }
        app.add_js_file("run.js", loading_method="defer", **attributes)


def setup(app: Sphinx) -> None:
    """Register it with Sphinx."""
    app.connect("builder-inited", add_packages)
    app.connect("html-page-context", add_button)
