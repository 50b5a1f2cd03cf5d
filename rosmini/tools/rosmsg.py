"""`rosmini rosmsg` and `rosmini rossrv`: definitions of types, as ROS's tools show them (http://wiki.ros.org/rosmsg).

They read packages; they need no Master. In Python they return data:
``TOOL.run("show", "geometry_msgs/Pose").definitions``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from rosmini.core.errors import DefinitionError, IllegalName, UnknownPackage, UnknownType
from rosmini.core.verbs import NOT_A_VERB, Call, Lines, Overview, Parser, Result, Tool, VerbError
from rosmini.ros.introspection.types import MESSAGE, Kind

if TYPE_CHECKING:
    from optparse import Values


UNREADABLE = (DefinitionError, IllegalName, UnknownPackage, UnknownType)


@dataclass(frozen=True, kw_only=True)
class Definitions(Result):
    """Definitions by type name; ``with_names`` if the name of the type was not given in full."""

    definitions: dict[str, str]
    with_names: bool = False
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        heads = (f"[{name}]:\n" if self.with_names else "" for name in self.definitions)
        return "\n".join(head + text for head, text in zip(heads, self.definitions.values(), strict=True))


@dataclass(frozen=True, kw_only=True)
class Sums(Result):
    """Md5 sums by type name; ``with_names`` if the name of the type was not given in full."""

    sums: dict[str, str]
    with_names: bool = False

    def __str__(self) -> str:
        return "\n".join(f"[{name}]: {md5}" if self.with_names else md5 for name, md5 in self.sums.items())


@dataclass(frozen=True, kw_only=True)
class Names(Result):
    """Names of types or of packages, sorted."""

    names: tuple[str, ...]
    separator: str = "\n"
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        return self.separator.join(self.names)


@dataclass(frozen=True)
class _Verbs:
    """The verbs of one of the two tools."""

    kind: Kind

    @property
    def tool(self) -> str:
        return f"ros{self.kind.ending}"

    def parser(self, usage: str, description: str, example: str) -> Parser:
        """Return the parser of a verb."""
        return Parser(self.tool, f"%prog {usage}", description, example=f"  rosmini {self.tool} {example}")

    def the_word(self, given: Values, call: Call, parser: Parser, what: str) -> str:
        """Return the only word of a command line, or the text on standard input. Raises ``UsageError``."""
        if len(given.words) > 1:
            parser.error(f"you may only specify one {what}")
        if given.words:
            word: str = given.words[0]
            return word
        while call.read_line is not None and (line := call.read_line()):
            if line.strip():
                return line.strip()
        return parser.error(f"please specify a {what}")

    # -- show --------------------------------------------------------------------------------------------------------

    def show_parser(self, verb: str) -> Parser:
        """Return the parser of ``show`` and ``info``."""
        text = f"Show the definition of a {self.kind.name} type; of a name without a package, all of that name."
        example = "nav_msgs/GetPlan" if self.kind is not MESSAGE else "geometry_msgs/Pose"
        parser = self.parser(f"{verb} [options] <{self.kind.name} type>", text, f"{verb} {example}")
        parser.flag("-r", "--raw", dest="raw", help="as in its file, with comments")
        return parser

    def show(self, given: Values, call: Call) -> Definitions:
        """Show definitions."""
        usage = self.show_parser("show")
        name = self.the_word(given, call, usage, f"{self.kind.name} type").removesuffix(f".{self.kind.ending}")
        written = "Please refer to msg/srv types as 'package_name/Type'."
        if "::" in name:
            usage.error(f"{self.tool} does not understand C++-style namespaces (i.e. '::').\n{written}")
        if "." in name:
            usage.error(f"invalid message type '{name}'.\n{written}")
        if "/" in name:
            return Definitions(definitions={name: self._text(name, raw=given.raw)})
        found = self.kind.search(name)
        if not found:
            raise VerbError(f"Could not find msg '{name}'\n{self.kind.what_next(name)}")
        return Definitions(definitions={one: self._text(one, raw=given.raw) for one in found}, with_names=True)

    def _text(self, name: str, *, raw: bool) -> str:
        try:
            return self.kind.text(name, raw=raw)
        except UNREADABLE as error:
            what = "Unable to load msg" if self.kind is MESSAGE else "Unknown srv type"
            raise VerbError(f"{what} [{name}]: {error}") from error

    # -- md5 ---------------------------------------------------------------------------------------------------------

    def md5_parser(self) -> Parser:
        """Return the parser of ``md5``."""
        example = "std_srvs/SetBool" if self.kind is not MESSAGE else "std_msgs/String"
        return self.parser(
            f"md5 <{self.kind.name} type>", "Print the md5 sum of a type: what two nodes compare.", f"md5 {example}"
        )

    def md5(self, given: Values, call: Call) -> Sums:
        """Return md5 sums."""
        name = self.the_word(given, call, self.md5_parser(), f"{self.kind.name} type")
        if "/" in name:
            try:
                return Sums(sums={name: self.kind.md5(name)})
            except UNREADABLE as error:
                return Sums(sums={}, complaints=(f"Cannot locate [{name}]", str(error)))
        found = self.kind.search(name)
        if not found:
            said = (f"No messages matching the name [{name}]", self.kind.what_next(name))
            return Sums(sums={}, complaints=said)
        return Sums(sums={one: self.kind.md5(one) for one in found}, with_names=True)

    # -- names -------------------------------------------------------------------------------------------------------

    def list_parser(self) -> Parser:
        """Return the parser of ``list``."""
        return self.parser("list", f"List all {self.kind.name} types.", "list")

    def list(self, _given: Values, _call: Call) -> Lines:
        """List all types."""
        return Lines(lines=tuple(self.kind.all()))

    def package_parser(self) -> Parser:
        """Return the parser of ``package``."""
        text = f"List the {self.kind.name} types of a package."
        parser = self.parser("package <package>", text, f"package std_{self.kind.ending}s")
        parser.flag("-s", dest="single_line", help="all in one line")
        return parser

    def package(self, given: Values, call: Call) -> Names:
        """List the types of a package."""
        name = self.the_word(given, call, self.package_parser(), f"{self.kind.name} type")
        try:
            names = self.kind.of_package(name)
        except UnknownPackage as error:
            raise VerbError(f"Invalid package: {name}\n{error}", status=NOT_A_VERB) from error
        return Names(names=tuple(names), separator=" " if given.single_line else "\n")

    def packages_parser(self) -> Parser:
        """Return the parser of ``packages``."""
        parser = self.parser("packages", f"List the packages that define {self.kind.name} types.", "packages -s")
        parser.flag("-s", dest="single_line", help="all in one line")
        return parser

    def packages(self, given: Values, _call: Call) -> Names:
        """List the packages that define types."""
        return Names(names=tuple(self.kind.packages()), separator=" " if given.single_line else "\n")


def tool_of(kind: Kind, summary: str) -> Tool:
    """Return the tool that shows types of a kind."""
    verbs, title = _Verbs(kind), kind.name.capitalize()
    made = Tool(
        verbs.tool,
        summary,
        example="show",
        purpose=f"displaying information about ROS {title} types",
        overview=Overview(closing="Type {tool} <command> -h for more detailed usage", status=0),
        needs_graph=False,
    )
    for name, said in (("show", f"Show {kind.name} description"), ("info", f"Alias for {verbs.tool} show")):
        made.verb(said, name=name, parser=partial(verbs.show_parser, name), takes=kind.ending)(verbs.show)
    made.verb(f"List all {kind.name}s", parser=verbs.list_parser)(verbs.list)
    made.verb(f"Display {kind.name} md5sum", parser=verbs.md5_parser, takes=kind.ending)(verbs.md5)
    made.verb(f"List {kind.name}s in a package", parser=verbs.package_parser, takes="package")(verbs.package)
    made.verb(f"List packages that contain {kind.name}s", parser=verbs.packages_parser)(verbs.packages)
    return made


TOOL = tool_of(MESSAGE, "message types: list them, and show their definitions")
