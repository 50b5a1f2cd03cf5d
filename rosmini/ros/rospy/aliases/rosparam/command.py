"""The command line of rosparam for scripts: ``rosparam.yamlmain(["rosparam", "get", "/rate"])``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from rosmini.core.rosparam import RosParamException, pretty, printed
from rosmini.ros.rospy.aliases.rosgraph.masterapi import MasterException
from rosmini.ros.rospy.aliases.rosgraph.names import GLOBALNS, script_resolve_name

from . import api

NAME = "rosparam"
VERBS = {
    "set": "set a parameter to a YAML value",
    "get": "print a parameter, or a namespace",
    "load": "set parameters from a YAML file",
    "dump": "write parameters to a YAML file",
    "delete": "delete a parameter, or a namespace",
    "list": "list the names of parameters",
}


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.print_usage(sys.stderr)
        self.exit(2, f"\n{self.prog.partition(' ')[0]}: error: {message}\n")


def yamlmain(argv: Sequence[str] | None = None) -> None:
    """Run rosparam with these arguments (``sys.argv`` if None), the program's name first.

    Errors are printed to standard error. Raises ``SystemExit``: with 0 after printing the usage, 1 if an operation
    fails, 2 for wrong arguments.
    """
    given = list(sys.argv if argv is None else argv)[1:]
    if not given or given[0] not in VERBS:
        print(f"{NAME} reads and writes the Parameter Server.\n\nCommands:")
        print("".join(f"\t{NAME} {verb}\t{text}\n" for verb, text in VERBS.items()))
        sys.exit(0)
    try:
        _COMMANDS[given[0]](_parse(given[0], given[1:]))
    except (RosParamException, MasterException) as error:
        print(f"ERROR: {error}", file=sys.stderr)
        sys.exit(1)


def _parse(verb: str, arguments: list[str]) -> argparse.Namespace:
    parser = _Parser(prog=f"{NAME} {verb}", description=VERBS[verb])
    if verb != "list":
        parser.add_argument("-v", dest="verbose", action="store_true", help="say what is done")
    if verb == "get":
        parser.add_argument("-p", dest="pretty", action="store_true", help="for reading, not as YAML")
    if verb == "set":
        files = parser.add_mutually_exclusive_group()
        files.add_argument("-t", "--textfile", help="set the parameter to the text of a file")
        files.add_argument("-b", "--binfile", help="set the parameter to the bytes of a file")
    if verb in ("get", "set", "delete"):
        parser.add_argument("parameter")
    if verb == "set":
        parser.add_argument("value", nargs="?")
    if verb in ("load", "dump"):
        parser.add_argument("file", nargs="?" if verb == "dump" else None)
    if verb in ("load", "dump", "list"):
        parser.add_argument("namespace", nargs="?", default="")
    options = parser.parse_args(arguments)
    if verb == "set" and options.value is None and not (options.textfile or options.binfile):
        parser.error("invalid arguments. Please specify a parameter value")
    return options


def _resolved(name: str) -> str:
    return script_resolve_name(NAME, name)


def _set(options: argparse.Namespace) -> None:
    name = _resolved(options.parameter)
    if options.textfile:
        api.set_param_raw(name, _content(options.textfile).decode(), options.verbose)
    elif options.binfile:
        api.set_param_raw(name, _content(options.binfile), options.verbose)
    elif options.value:
        api.set_param(name, options.value, options.verbose)
    else:
        api.set_param_raw(name, "", options.verbose)  # an empty YAML text would have no value


def _content(name: str) -> bytes:
    try:
        return Path(name).read_bytes()
    except OSError as error:
        raise RosParamException(f"file [{name}] cannot be read: {error.strerror}") from error


def _get(options: argparse.Namespace) -> None:
    name = _resolved(options.parameter)
    if options.verbose:
        print(f"getting parameter [{name}]")
    value = api.get_param(name)
    sys.stdout.write(pretty(value) if options.pretty else printed(value))


def _load(options: argparse.Namespace) -> None:
    for values, namespace in api.load_file(options.file, _resolved(options.namespace), options.verbose):
        api.upload_params(namespace, values, options.verbose)


def _dump(options: argparse.Namespace) -> None:
    if options.verbose:
        print(f"dumping namespace [{options.namespace}] to file [{options.file}]")
    api.dump_params(options.file, _resolved(options.namespace), options.verbose)


def _delete(options: argparse.Namespace) -> None:
    api.delete_param(_resolved(options.parameter), options.verbose)


def _list(options: argparse.Namespace) -> None:
    print("\n".join(api.list_params(_resolved(options.namespace) if options.namespace else GLOBALNS)))


_COMMANDS = {"set": _set, "get": _get, "load": _load, "dump": _dump, "delete": _delete, "list": _list}
