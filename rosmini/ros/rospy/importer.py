"""Makes rosmini's modules importable under the names that scripts use: ``import rospy``.

Scripts run by rosmini get :func:`modules`, and ``sys.modules`` is not changed. :func:`install` is for all
other programs.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType

from rosmini import msgs

from .absent import absent_module

_HERE = __package__ or "rosmini.ros.rospy"
_ROSPY = "client core msg msproxy names numpy_msg rostime service timer topics"
_ALIASES = {
    "actionlib": "",
    "dynamic_reconfigure": "",
    "genpy": "dynamic message",
    "interactive_markers": "interactive_marker_server menu_handler",
    "message_filters": "",
    "rosbag": "",
    "rosgraph": "masterapi names rosenv",
    "roslib": "names packages scriptutil",
    "rosnode": "",
    "rosparam": "",
    "rosservice": "",
    "rostest": "",
    "rostopic": "",
    "rosunit": "",
    "tf": "",
    "tf2_geometry_msgs": "",
    "tf2_py": "",
    "tf2_ros": "buffer_interface",
    "tf2_sensor_msgs": "",
}
"""Packages of `rosmini.ros.rospy.aliases`, with those of their modules that are separate files."""
_THE_SAME = {
    "actionlib": "action_client action_server exceptions goal_id_generator handle_tracker_deleter server_goal_handle "
    "simple_action_client simple_action_server status_tracker",
    "dynamic_reconfigure": "client encoding server",
    "rosbag": "bag rosbag_main",
    "tf": "broadcaster listener",
    "tf2_geometry_msgs": "tf2_geometry_msgs",
    "tf2_ros": "buffer static_transform_broadcaster transform_broadcaster transform_listener",
    "tf2_sensor_msgs": "tf2_sensor_msgs",
}
"""Modules of ROS's packages that are the package itself here."""
_HOMES = {
    "rospy": _HERE,
    **{f"rospy.{name}": f"{_HERE}.{name}" for name in _ROSPY.split()},
    **{package: f"{_HERE}.aliases.{package}" for package in _ALIASES},
    **{
        f"{package}.{name}": f"{_HERE}.aliases.{package}.{name}"
        for package, names in _ALIASES.items()
        for name in names.split()
    },
    **{
        f"{package}.{name}": f"{_HERE}.aliases.{package}"
        for package, names in _THE_SAME.items()
        for name in names.split()
    },
    "actionlib.msg": "rosmini.msgs.actionlib.msg",
    "dynamic_reconfigure.msg": "rosmini.msgs.dynamic_reconfigure.msg",
    "dynamic_reconfigure.srv": "rosmini.msgs.dynamic_reconfigure.srv",
    "genpy.rostime": "rosmini.core.time",
    "roslib.message": f"{_HERE}.aliases.genpy.message",
    "rospy.exceptions": "rosmini.core.errors",
    "sensor_msgs.point_cloud2": f"{_HERE}.aliases.point_cloud2",
    "tf.msg": "rosmini.msgs.tf.msg",
    "tf.srv": "rosmini.msgs.tf.srv",
    "tf.transformations": "rosmini.core.tf.transformations",
}
"""Actual location of each module, by the name under which scripts import it."""


def homes() -> dict[str, str]:
    """Return the actual location of each module, by the name under which scripts import it."""
    return dict(_HOMES)


def modules() -> dict[str, ModuleType]:
    """Return ``rospy``, ``actionlib``, ``genpy`` ... and their submodules, by the names that scripts import."""
    return {name: import_module(home) for name, home in _HOMES.items()}


class _AliasLoader(Loader):
    """Loads the existing module, so that ``rospy.msg`` and ``rosmini.ros.rospy.msg`` are the same object."""

    def __init__(self, home: str) -> None:
        self._home = home
        self._spec: ModuleSpec | None = None

    def create_module(self, spec: ModuleSpec) -> ModuleType:  # noqa: ARG002 - the protocol's signature
        module = import_module(self._home)
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Undo what the import system wrote into the module, so that it keeps its own name."""
        module.__spec__ = self._spec


class _AliasFinder(MetaPathFinder):
    """Finds rosmini's modules under the names that scripts use."""

    def __init__(self, *, shadow: bool) -> None:
        self.shadow = shadow

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,  # noqa: ARG002 - the protocol's signature
        target: ModuleType | None = None,  # noqa: ARG002
    ) -> ModuleSpec | None:
        """Implement :meth:`importlib.abc.MetaPathFinder.find_spec`."""
        home = _HOMES.get(fullname)
        if home is None or not (self.shadow or not ros_is_installed()):
            return None
        return ModuleSpec(fullname, _AliasLoader(home), is_package=False)


class _AbsentFinder(MetaPathFinder):
    """Runs after all other finders: raises an error with an alternative for ROS modules that rosmini lacks."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,  # noqa: ARG002 - the protocol's signature
        target: ModuleType | None = None,  # noqa: ARG002
    ) -> ModuleSpec | None:
        """Implement :meth:`importlib.abc.MetaPathFinder.find_spec`. Raises ``AbsentModule``."""
        error = absent_module(fullname)
        if error is not None:
            raise error
        return None


def ros_is_installed() -> bool:
    """Return True if Python finds the real rospy without rosmini."""
    found = PathFinder.find_spec("rospy", sys.path)
    return found is not None and found.origin is not None


def install(*, shadow: bool = False) -> None:
    """Make rosmini's modules available to ``import rospy`` and ``from std_msgs.msg import String``.

    It covers ``rospy``, ``genpy``, ``roslib``, ``rosgraph``, ``rosparam`` and the messages of every ROS package that is
    found. An installed ROS takes precedence, unless ``shadow`` is true. A second call changes ``shadow``.
    """
    uninstall()
    msgs.install(shadow=shadow)
    sys.meta_path.insert(0, _AliasFinder(shadow=shadow))
    sys.meta_path.append(_AbsentFinder())


def uninstall() -> None:
    """Undo :func:`install`: remove the finders and the modules imported through them."""
    ours = (_AliasFinder, _AbsentFinder)
    sys.meta_path[:] = [finder for finder in sys.meta_path if not isinstance(finder, ours)]
    for name, home in _HOMES.items():
        if name in sys.modules and sys.modules[name] is sys.modules.get(home):
            del sys.modules[name]
    msgs.uninstall()


def installed() -> bool:
    """Return True between :func:`install` and :func:`uninstall`."""
    return any(isinstance(finder, _AliasFinder) for finder in sys.meta_path)


@contextmanager
def importable() -> Iterator[None]:
    """Make ROS's modules importable by their names within the block, if they are not already.

    Plugins of the Navigation Stack find this function through the entry point `rosmini.imports`.
    """
    is_mine = not installed()
    if is_mine:
        install()
    try:
        yield
    finally:
        if is_mine:
            uninstall()
