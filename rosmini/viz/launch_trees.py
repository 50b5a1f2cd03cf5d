"""The plan of a launch as a tree: files, their includes, and their nodes with remappings and parameters."""

from __future__ import annotations

import os
from collections.abc import Iterator

from rosmini.ros.launch import LaunchFile, NodePlan, Plan, Setting
from rosmini.viz.outline import HEAD, KIND, NAME, VALUE, Row, outline
from rosmini.viz.view import Picture
from rosmini.viz.words import plural

MAX_LENGTH = 44
"""Maximum number of characters of a value that are shown."""


def launch_tree(plan: Plan, *, parameters: bool = True, title: str | None = None) -> Picture:
    """Draw a plan of launch files as a tree.

    Args:
        plan: the plan, for instance from `rosmini.ros.launch.read`.
        parameters: False leaves out the parameters.
        title: a caption under the picture.

    """
    rows = [row for root in plan.roots for row in _file(root, plan, 0, -1, 0, parameters=parameters)]
    nodes, files = plural(len(plan.nodes), "node"), plural(len(plan.files()), "file")
    counted = f"{nodes}, {plural(len(plan.settings), 'parameter')} in {files}"
    listed = ", ".join(f"{node.full_name} ({node.executable})" for node in plan.nodes)
    alt = f"Tree of a launch: {counted}. {listed}".strip()
    return Picture(outline(rows, title or "Launch", alt), text=plan.text(), alt=alt, caption=title)


def _file(file: LaunchFile, plan: Plan, depth: int, parent: int, number: int, *, parameters: bool) -> Iterator[Row]:
    """Yield the row of a file, with index `number`, and the rows of its contents."""
    name = file.path.replace(os.sep, "/").rpartition("/")[2]
    space = ((KIND, f"in {file.namespace}"),) if file.namespace != "/" else ()
    yield Row(depth, parent, ((HEAD, name), *space))
    following = number + 1
    owned: set[str] = set()
    for node in file.nodes:
        for row in _node(node, plan, file, depth + 1, number, following, parameters=parameters):
            yield row
            following += 1
        owned |= {setting.name for setting in _of(node, file)}
    for setting in file.settings if parameters else ():
        if setting.name not in owned:
            yield Row(depth + 1, number, _setting(setting.name, setting, plan))
            following += 1
    for inner in file.includes:
        for row in _file(inner, plan, depth + 1, number, following, parameters=parameters):
            yield row
            following += 1


def _node(
    node: NodePlan, plan: Plan, file: LaunchFile, depth: int, parent: int, number: int, *, parameters: bool
) -> Iterator[Row]:
    how = [word for word in ("respawn", "required") if getattr(node, word)]
    yield Row(depth, parent, ((NAME, node.full_name), (KIND, " ".join([node.executable, *how]))))
    for source, target in node.remappings:
        yield Row(depth + 1, number, ((NAME, source), (VALUE, f"→ {target}")))
    for setting in _of(node, file) if parameters else ():
        yield Row(depth + 1, number, _setting(setting.name[len(node.full_name) :].replace("/", "~", 1), setting, plan))


def _of(node: NodePlan, file: LaunchFile) -> list[Setting]:
    """Return the private parameters of a node."""
    return [setting for setting in file.settings if setting.name.startswith(node.full_name + "/")]


def _setting(name: str, setting: Setting, plan: Plan) -> tuple[tuple[str, str], ...]:
    text = repr(setting.value)
    text = text if len(text) <= MAX_LENGTH else text[: MAX_LENGTH - 3] + "..."
    beaten = plan.settings[setting.name] is not setting
    return ((NAME, name), (VALUE, text), *(((KIND, "overridden"),) if beaten else ()))
