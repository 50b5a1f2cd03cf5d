"""``import roslaunch.xmlloader`` and ``roslaunch.config``: launch files as data, for use in scripts.

>>> config = ROSLaunchConfig()
>>> XmlLoader().load_string('<launch><node pkg="tf" type="tf_monitor" name="monitor"/></launch>', config, argv=[])
>>> [(node.package, node.type, node.namespace, node.name) for node in config.nodes]
[('tf', 'tf_monitor', '/', 'monitor')]
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.names import is_remapping

from .script_api import Node

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .errors import LaunchError as XmlParseException
    from .plan import Machine, NodePlan, Plan

__all__ = ["Param", "ROSLaunchConfig", "XmlLoader", "XmlParseException", "load_config_default"]


def __getattr__(name: str) -> Any:
    if name in ("XmlParseException", "RLException"):
        from .errors import LaunchError

        return LaunchError
    raise AttributeError(f"module 'roslaunch.xmlloader' has no attribute {name!r}")


class Param(NamedTuple):
    """A parameter: its global name and its value."""

    key: str
    value: Any


class ROSLaunchConfig:
    """Contents of launch files: ``nodes``, ``tests``, ``params`` and ``machines`` by name, ``roslaunch_files``."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.tests: list[Node] = []
        self.params: dict[str, Param] = {}
        self.clear_params: list[str] = []
        self.machines: dict[str, Machine] = {}
        self.roslaunch_files: list[str] = []
        self.config_errors: list[str] = []
        """Problems that do not prevent a launch."""
        self._plans: list[Plan] = []

    @property
    def resolved_node_names(self) -> list[str]:
        """Global names of the nodes."""
        return [node.plan.full_name for node in self.nodes]

    def summary(self, local: bool = False) -> str:  # noqa: ARG002 - roslaunch's signature
        """Return the summary that roslaunch prints before it starts."""
        return "\n".join(plan.summary() for plan in self._plans)

    def add(self, plan: Plan) -> None:
        """Add the contents of a plan; a later setting of a parameter wins."""
        self._plans.append(plan)
        self.nodes += [_node(each) for each in plan.nodes]
        self.tests += [_node(each) for each in plan.tests]
        self.params |= {name: Param(name, value) for name, value in plan.parameters.items()}
        self.clear_params += plan.cleared
        self.machines |= plan.machines
        self.roslaunch_files += plan.files()
        self.config_errors += plan.warnings


def _node(plan: NodePlan) -> Node:
    made = Node(
        plan.package,
        plan.type,
        plan.name,
        plan.namespace,
        plan.machine,
        plan.args,
        remap_args=plan.remappings,
        env_args=plan.environment,
        output=plan.output,
        cwd=plan.cwd,
        launch_prefix=plan.launch_prefix,
        filename=plan.place.file,
    )
    made.respawn, made.respawn_delay, made.required = plan.respawn, plan.respawn_delay, plan.required
    made.plan = plan
    return made


class XmlLoader:
    """Reads launch files into a :class:`ROSLaunchConfig`; names of ``$(anon ...)`` are always resolved."""

    def __init__(self, resolve_anon: bool = True, args_only: bool = False) -> None:
        self.resolve_anon, self.args_only = resolve_anon, args_only

    def load(
        self,
        filename: str,
        ros_config: ROSLaunchConfig,
        core: bool = False,  # noqa: ARG002 - roslaunch's signature
        argv: Sequence[str] | None = None,
        verbose: bool = True,  # noqa: ARG002
    ) -> None:
        """Read a file; ``argv`` has its arguments, by default the script's own. Raises ``XmlParseException``."""
        from .reader import read

        ros_config.add(read(filename, args=_arguments(argv)))

    def load_string(
        self,
        xml_text: str,
        ros_config: ROSLaunchConfig,
        core: bool = False,  # noqa: ARG002 - roslaunch's signature
        verbose: bool = True,  # noqa: ARG002
        argv: Sequence[str] | None = None,
    ) -> None:
        """Read a text. Raises ``XmlParseException``."""
        from .reader import read

        ros_config.add(read(text=xml_text, args=_arguments(argv)))


def _arguments(argv: Sequence[str] | None) -> dict[str, str]:
    words = sys.argv[1:] if argv is None else argv
    return {key: value for key, _, value in (word.partition(":=") for word in words if is_remapping(word))}


def load_config_default(
    roslaunch_files: Sequence[str | tuple[str, Sequence[str]]],
    port: int | None,  # noqa: ARG001 - roslaunch's signature
    roslaunch_strs: Sequence[str] | None = None,
    loader: XmlLoader | None = None,
    **others: Any,  # noqa: ARG001
) -> ROSLaunchConfig:
    """Return the combined contents of launch files and texts. Raises ``XmlParseException``."""
    loader, config = loader or XmlLoader(), ROSLaunchConfig()
    for each in roslaunch_files:
        file, words = (each, None) if isinstance(each, str) else each
        loader.load(file, config, argv=words)
    for text in roslaunch_strs or ():
        loader.load_string(text, config)
    return config
