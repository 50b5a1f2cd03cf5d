"""`rosmini rosparam`: the verbs of ROS's tool, with its options and output (http://wiki.ros.org/rosparam).

In a terminal they act on the Parameter Server at ``ROS_MASTER_URI``; in Python on that of a graph of this process,
where they return data: ``TOOL.run("get", "/gains", graph=graph).value``.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.errors import ParameterError, ParameterNotSet, nearest
from rosmini.core.verbs import Call, Overview, Parser, Result, Tool, VerbError, global_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from optparse import Values

    from rosmini.core.rosparam import ParamClient

TOOL = Tool(
    "rosparam",
    "parameters: get, set, load, dump, delete and list them",
    example="get",
    purpose="getting, setting, and deleting parameters from the ROS Parameter Server",
    overview=Overview(closing="", status=0, unknown_status=0),
)


class _Parser(Parser):
    """A parser for which -5 is a number, not an option, as in the real tool."""

    def parse(self, words: Sequence[str], /) -> Values:
        """Return the options, and the other words as ``words``. Raises ``UsageError``."""
        numbers = {f"\0{at}": word for at, word in enumerate(words) if word[:1] == "-" and word[1:2].isdigit()}
        hidden = [f"\0{at}" if f"\0{at}" in numbers else word for at, word in enumerate(words)]
        values = super().parse(hidden)
        values.words = [numbers.get(word, word) for word in values.words]
        values.argv = list(words)
        return values


def _parser(usage: str, description: str, example: str) -> Parser:
    parser = _Parser("rosparam", f"%prog {usage}", description, example=f"  rosmini rosparam {example}")
    parser.flag("-v", dest="verbose", help="say what is done")
    return parser


def _words(given: Values, usage: Parser, what: str, most: int, least: int = 1) -> list[str]:
    """Return the words of a command line, padded with empty words to ``most``."""
    words: list[str] = given.words
    if len(words) < least:
        usage.error(f"invalid arguments. Please specify {what}")
    if len(words) > most:
        usage.error("too many arguments")
    return [*words, *[""] * (most - len(words))]


def _client(call: Call) -> ParamClient:
    from rosmini.core.rosparam import ParamClient

    return ParamClient(call.peers)


def _unset(call: Call, what: str, name: str) -> VerbError:
    known = _client(call).list_params("/")
    within = sorted({"/".join(each.split("/")[:end]) for each in known for end in range(2, each.count("/") + 2)})
    hint = nearest(name, within) or "`rosparam list` lists the parameters that there are."
    return VerbError(f"ERROR: {what} [{name}] is not set\n{hint}")


def _refused(error: ParameterError) -> VerbError:
    return VerbError(f"ERROR: {error}")


def _lines(name: str, value: Any) -> Iterable[str]:
    """Yield a line ``name=value`` for each parameter in a value."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _lines(f"{name.rstrip('/')}/{key}", item)
    else:
        yield f"{name}={value}"


# -- set -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Changed(Result):
    """Parameters that were set or deleted; those that were set have values."""

    names: tuple[str, ...]
    values: tuple[Any, ...] = ()


def _set_parser() -> Parser:
    text = "Set a parameter to a value in YAML; a dictionary is merged into what is there."
    return _parser("set [options] parameter value", text, "set /gains '{p: 1.0, i: 0.1}'")


@TOOL.verb("set parameter", name="set", parser=_set_parser, only_asks=True, takes="parameter value")
def set_(given: Values, call: Call) -> Changed:
    """Set a parameter."""
    from rosmini.core.rosparam import assignments, parse

    usage = _set_parser()
    name, text = _words(given, usage, "a parameter name", 2)
    resolved = global_name(name)
    if len(given.words) < 2:
        usage.error("invalid arguments. Please specify a parameter value")
    try:
        value = parse(text) if text else ""
        settings = list(assignments(resolved, value))
        _client(call).upload(resolved, value)
    except ParameterError as error:
        raise _refused(error) from error
    for one, item in settings if given.verbose else ():
        call.say(f"set parameter [{one}] to [{item}]")
    return Changed(names=tuple(one for one, _ in settings), values=tuple(item for _, item in settings))


# -- get ---------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Parameter(Result):
    """A parameter's value, or a namespace as a dictionary."""

    name: str
    value: Any
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, kw_only=True)
class Empty(Parameter):
    """A value that is printed as an empty line."""

    always_printed: ClassVar[bool] = True


def _get_parser() -> Parser:
    parser = _parser("get [options] parameter", "Print a parameter, or a namespace, as YAML.", "get -p /gains")
    parser.flag("-p", dest="pretty", help="for reading; not always YAML")
    return parser


@TOOL.verb("get parameter", parser=_get_parser, only_asks=True, takes="parameter")
def get(given: Values, call: Call) -> Parameter:
    """Get a parameter."""
    from rosmini.core.rosparam import pretty, printed

    (word,) = _words(given, _get_parser(), "a parameter name", 1)
    name = global_name(word)
    if given.verbose:
        call.say(f"getting parameter [{name}]")
    value = _value(call, name)
    text = (pretty(value) if given.pretty else printed(value)).removesuffix("\n")
    return (Parameter if text else Empty)(name=name, value=value, text=text)


def _value(call: Call, name: str) -> Any:
    try:
        return _client(call).get(name)
    except ParameterNotSet as error:
        raise _unset(call, "Parameter", name) from error


# -- load ------------------------------------------------------------------------------------------------------------


def _load_parser() -> Parser:
    text = "Set parameters from a YAML file, or from standard input (-). Nothing is set if anything in it is wrong."
    return _parser("load [options] file [namespace]", text, "load robot.yaml /robot")


@TOOL.verb("load parameters from file", parser=_load_parser, only_asks=True, takes="file parameter")
def load(given: Values, call: Call) -> Changed:
    """Set parameters from a file."""
    from rosmini.core.rosparam import load_file, load_str

    usage = _load_parser()
    file, word = _words(given, usage, "a file name or - for stdin", 2)
    namespace = global_name(word)
    if given.verbose:
        call.say("reading parameters from stdin" if file == "-" else f"reading parameters from [{file}]")
    try:
        if file == "-":
            documents = load_str(_typed(call, usage), "standard input", namespace)
        else:
            documents = load_file(file, namespace)
        settings = [setting for document in documents for setting in document.assignments()]
        if given.verbose:
            for document in documents:
                if document.own_namespace:
                    call.say(f"reading parameters into namespace [{document.namespace}]")
            for line in chain.from_iterable(_lines(each.namespace, each.values) for each in documents):
                call.say(line)
        client = _client(call)
        for name, value in settings:
            client.upload(name, value)
    except ParameterError as error:
        raise _refused(error) from error
    return Changed(names=tuple(name for name, _ in settings), values=tuple(value for _, value in settings))


def _typed(call: Call, usage: Parser) -> str:
    """Return the text on standard input."""
    if call.read_line is None:
        usage.error("there is no standard input here: name a file")
    return "".join(iter(call.read_line, ""))


# -- dump --------------------------------------------------------------------------------------------------------------


def _dump_parser() -> Parser:
    text = "Write parameters to a YAML file; without a file, to standard output."
    return _parser("dump [options] file [namespace]", text, "dump robot.yaml /robot")


@TOOL.verb("dump parameters to file", parser=_dump_parser, only_asks=True, takes="file parameter")
def dump(given: Values, call: Call) -> Parameter:
    """Write parameters to a file."""
    from rosmini.core.rosparam import dumps

    file, namespace = _words(given, _dump_parser(), "a file", 2, least=0)
    name = global_name(namespace)
    if given.verbose:
        call.say(f"dumping namespace [{namespace}] to file [{file or None}]")
    value = _value(call, name)
    for line in _lines(name, value) if given.verbose else ():
        call.say(line)
    text = dumps(value)
    if not file:
        return Parameter(name=name, value=value, text=text.removesuffix("\n"))
    try:
        Path(file).write_text(text, encoding="utf-8")
    except OSError as error:
        raise VerbError(f"ERROR: {file} cannot be written: {error.strerror}") from error
    return Parameter(name=name, value=value, text="")


# -- delete, list ----------------------------------------------------------------------------------------------------


def _delete_parser() -> Parser:
    return _parser("delete [options] parameter", "Delete a parameter, or a namespace.", "delete /gains")


@TOOL.verb("delete parameter", parser=_delete_parser, only_asks=True, takes="parameter")
def delete(given: Values, call: Call) -> Changed:
    """Delete a parameter."""
    (word,) = _words(given, _delete_parser(), "a parameter name", 1)
    name = global_name(word)
    try:
        _client(call).delete(name)
    except ParameterNotSet as error:
        raise _unset(call, "parameter", name) from error
    if given.verbose:
        call.say("deleted ENTIRE parameter server" if name == "/" else f"deleted parameter [{name}]")
    return Changed(names=(name,))


@dataclass(frozen=True, kw_only=True)
class ParameterList(Result):
    """Names of parameters, sorted; with their values if requested."""

    names: tuple[str, ...]
    values: tuple[Any, ...] | None = None
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        if self.values is None:
            return "\n".join(self.names)
        return "\n".join(f"{name}={value}" for name, value in zip(self.names, self.values, strict=True))


def _list_parser() -> Parser:
    parser = Parser(
        "rosparam", "%prog list [namespace]", "List the names of parameters, of all or in a namespace.",
        example="  rosmini rosparam list /move_base",
    )  # fmt: skip
    parser.flag("-v", dest="verbose", help="with their values (not in ROS)")
    return parser


@TOOL.verb("list parameter names", name="list", parser=_list_parser, only_asks=True, takes="parameter")
def list_(given: Values, call: Call) -> ParameterList:
    """List parameters."""
    (word,) = _words(given, _list_parser(), "a namespace", 1, least=0)
    client = _client(call)
    names = tuple(client.list_params(global_name(word) if word else "/"))
    return ParameterList(names=names, values=tuple(map(client.get, names)) if given.verbose else None)
