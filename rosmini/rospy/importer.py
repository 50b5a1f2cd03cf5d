"""``import rospy``: our modules under the names that scripts use.

Scripts run by rosmini are given :func:`modules`, and ``sys.modules`` is left alone. :func:`install` is for everything else.
"""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from typing import TYPE_CHECKING

from rosmini import msgs

from .absent import absent_module

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

__all__ = ["install", "installed", "modules", "uninstall"]

_ROSPY = (
    "client",
    "core",
    "exceptions",
    "msg",
    "msproxy",
    "names",
    "numpy_msg",
    "rostime",
    "service",
    "timer",
    "topics",
)
_HERE = __package__ or "rosmini.rospy"
_HOMES = {
    "rospy": _HERE,
    **{f"rospy.{name}": f"{_HERE}.{name}" for name in _ROSPY},
    **{
        name: f"{_HERE}.aliases.{name}"
        for name in (
            "actionlib",
            "actionlib.action_client",
            "actionlib.action_server",
            "actionlib.exceptions",
            "actionlib.goal_id_generator",
            "actionlib.server_goal_handle",
            "actionlib.simple_action_client",
            "actionlib.simple_action_server",
            "actionlib.status_tracker",
            "dynamic_reconfigure",
            "dynamic_reconfigure.client",
            "dynamic_reconfigure.encoding",
            "dynamic_reconfigure.server",
            "genpy",
            "genpy.dynamic",
            "genpy.message",
            "genpy.rostime",
            "message_filters",
            "rosbag",
            "rosbag.bag",
            "rosgraph",
            "rosgraph.masterapi",
            "rosgraph.names",
            "rosgraph.rosenv",
            "rosgraph.roslogging",
            "roslib",
            "roslib.message",
            "roslib.names",
            "roslib.packages",
            "rosparam",
            "tf",
            "tf.broadcaster",
            "tf.listener",
            "tf2_geometry_msgs",
            "tf2_geometry_msgs.tf2_geometry_msgs",
            "tf2_py",
            "tf2_ros",
            "tf2_ros.buffer",
            "tf2_ros.buffer_client",
            "tf2_ros.buffer_interface",
            "tf2_ros.buffer_server",
            "tf2_ros.static_transform_broadcaster",
            "tf2_ros.transform_broadcaster",
            "tf2_ros.transform_listener",
            "tf2_sensor_msgs",
            "tf2_sensor_msgs.tf2_sensor_msgs",
        )
    },
    "actionlib.msg": "rosmini.msgs.actionlib.msg",
    "dynamic_reconfigure.msg": "rosmini.msgs.dynamic_reconfigure.msg",
    "dynamic_reconfigure.srv": "rosmini.msgs.dynamic_reconfigure.srv",
    "sensor_msgs.point_cloud2": f"{_HERE}.aliases.point_cloud2",
    "tf.msg": "rosmini.msgs.tf.msg",
    "tf.srv": "rosmini.msgs.tf.srv",
    "tf.transformations": "rosmini.tf.transformations",
}
"""Where each module really is, by the name under which scripts import it."""


def modules() -> dict[str, ModuleType]:
    """Return the modules ``rospy``, ``actionlib``, ``genpy``, ``roslib``, ``rosgraph``, ``rosparam`` and those in them, by the names that scripts import."""
    return {name: import_module(home) for name, home in _HOMES.items()}


class _AliasLoader(Loader):
    """Gives the one module that is there already, so that ``rospy.msg`` and ``rosmini.rospy.msg`` are the same object."""

    def __init__(self, home: str) -> None:
        self._home = home
        self._spec: ModuleSpec | None = None

    def create_module(self, spec: ModuleSpec) -> ModuleType:  # noqa: ARG002 - the protocol's signature
        module = import_module(self._home)
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Undo what the import system wrote into the module: it keeps its own name."""
        module.__spec__ = self._spec


class _AliasFinder(MetaPathFinder):
    """Finds our modules under the names that scripts use."""

    def __init__(self, *, shadow: bool) -> None:
        self.shadow = shadow

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,  # noqa: ARG002 - the protocol's signature
        target: ModuleType | None = None,  # noqa: ARG002
    ) -> ModuleSpec | None:
        """As :meth:`importlib.abc.MetaPathFinder.find_spec`."""
        home = _HOMES.get(fullname)
        if home is None or not (self.shadow or not ros_is_installed()):
            return None
        return ModuleSpec(fullname, _AliasLoader(home), is_package=False)


class _AbsentFinder(MetaPathFinder):
    """Comes when all others have failed: says what to do without a module of ROS that rosmini does not have."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,  # noqa: ARG002 - the protocol's signature
        target: ModuleType | None = None,  # noqa: ARG002
    ) -> ModuleSpec | None:
        """As :meth:`importlib.abc.MetaPathFinder.find_spec`. Raises ``AbsentModule``."""
        error = absent_module(fullname)
        if error is not None:
            raise error
        return None


def ros_is_installed() -> bool:
    """Tell whether Python finds the real rospy by itself."""
    found = PathFinder.find_spec("rospy", sys.path)
    return found is not None and found.origin is not None


def install(*, shadow: bool = False) -> None:
    """Let ``import rospy`` and ``from std_msgs.msg import String`` find what is in rosmini.

    ``rospy``, ``genpy``, ``roslib``, ``rosgraph``, ``rosparam`` and the messages of every ROS package that can be found. Where a real ROS is
    installed it wins, unless ``shadow`` is true. A second call changes ``shadow``.
    """
    uninstall()
    msgs.install(shadow=shadow)
    sys.meta_path.insert(0, _AliasFinder(shadow=shadow))
    sys.meta_path.append(_AbsentFinder())


def uninstall() -> None:
    """Undo :func:`install`: forget the finders and the modules that came through them."""
    ours = (_AliasFinder, _AbsentFinder)
    sys.meta_path[:] = [finder for finder in sys.meta_path if not isinstance(finder, ours)]
    for name, home in _HOMES.items():
        if name in sys.modules and sys.modules[name] is sys.modules.get(home):
            del sys.modules[name]
    msgs.uninstall()


def installed() -> bool:
    """True between :func:`install` and :func:`uninstall`."""
    return any(isinstance(finder, _AliasFinder) for finder in sys.meta_path)
