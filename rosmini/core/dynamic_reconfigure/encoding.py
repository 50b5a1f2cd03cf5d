"""Conversion to and from messages: http://docs.ros.org/en/api/dynamic_reconfigure/html/index-msg.html."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, cast

from rosmini.msgs import message_class

from .description import Description, DynamicReconfigureParameterException, ParameterGroup, ReconfigurableParameter

_LISTS = {"bool": "bools", "int": "ints", "str": "strs", "double": "doubles"}
_CLASSES = {"bool": "BoolParameter", "int": "IntParameter", "str": "StrParameter", "double": "DoubleParameter"}


class Config(dict[str, Any]):
    """A dictionary whose items are also attributes: ``config.gain`` is ``config["gain"]``."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(name) from error

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def copy(self) -> Config:
        """Return a shallow copy."""
        return Config(self)


def _message(name: str, *values: Any) -> Any:
    return message_class(f"dynamic_reconfigure/{name}")(*values)


def group_tree(group: ParameterGroup, states: Mapping[str, bool], values: Mapping[str, Any] | None = None) -> Config:
    """Return the item ``groups`` of a configuration: the states of groups, their parameters, and their subgroups.

    Each value appears in ``parameters`` and as an item of its group: ROS's server uses one form, its client the other.
    """
    held = {one.name: values[one.name] for one in group.parameters if values and one.name in values}
    return Config(
        held,
        id=group.id,
        parent=group.parent,
        name=group.name,
        type=group.type,
        state=states.get(group.name, group.state),
        groups=Config({inner.name: group_tree(inner, states, values) for inner in group.groups}),
        parameters=Config(held),
    )


def group_states(tree: Mapping[str, Any]) -> dict[str, bool]:
    """Return the states of the groups in a tree that :func:`group_tree` made, by name."""
    found = {str(tree["name"]): bool(tree["state"])}
    for inner in tree["groups"].values():
        found.update(group_states(inner))
    return found


def encode_values(description: Description, values: Mapping[str, Any], states: Mapping[str, bool] | None = None) -> Any:
    """Return a ``Config`` message with the given parameters and states of groups.

    Raises ``DynamicReconfigureParameterException`` for a name that the description does not contain.
    """
    message = _message("Config")
    for name, value in values.items():
        kind = description[name].type
        getattr(message, _LISTS[kind]).append(_message(_CLASSES[kind], name, value))
    for name, state in (states or {}).items():
        group = description.group(name)
        message.groups.append(_message("GroupState", name, state, group.id, group.parent))
    return message


def decode_values(message: Any) -> tuple[dict[str, Any], dict[str, bool]]:
    """Return the values of parameters and the states of groups in a ``Config`` message."""
    values = {one.name: one.value for field in _LISTS.values() for one in getattr(message, field)}
    return values, {group.name: bool(group.state) for group in message.groups}


def encode_description(description: Description) -> Any:
    """Return a ``ConfigDescription`` message."""
    message = _message("ConfigDescription")
    for group in description.groups:
        parameters = [
            _message("ParamDescription", one.name, one.type, one.level, one.description, one.edit_method)
            for one in group.parameters
        ]
        message.groups.append(_message("Group", group.name, group.type, parameters, group.parent, group.id))
    message.max, message.min, message.dflt = (
        encode_values(description, values) for values in (description.max, description.min, description.defaults)
    )
    return message


def decode_description(message: Any) -> Description:
    """Return the description in a ``ConfigDescription`` message.

    Raises ``DynamicReconfigureParameterException`` if group 0, or a parameter's default or range, is missing.
    """
    lows, highs, defaults = (decode_values(one)[0] for one in (message.min, message.max, message.dflt))

    def parameters(group: Any) -> Iterator[ReconfigurableParameter]:
        for one in group.parameters:
            default, low, high = defaults[one.name], lows[one.name], highs[one.name]
            yield ReconfigurableParameter(
                one.name, one.type, one.level, one.description, default, low, high, one.edit_method
            )

    def build(group: Any) -> ParameterGroup:
        inner = tuple(build(one) for one in message.groups if one.id != 0 and one.parent == group.id)
        return ParameterGroup(group.name, group.type, True, group.id, group.parent, tuple(parameters(group)), inner)

    roots = [group for group in message.groups if group.id == 0]
    if not roots:
        raise DynamicReconfigureParameterException("the server's description has no group 0, which contains all others")
    try:
        return Description(build(roots[0]))
    except KeyError as error:
        raise DynamicReconfigureParameterException(
            f"the server's description has no default or no range for the parameter {cast('str', error.args[0])}"
        ) from error
