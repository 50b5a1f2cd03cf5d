"""Manifests: ``package.xml`` in its formats 1 to 3."""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from rosmini.core import files
from rosmini.core.errors import DefinitionError
from rosmini.core.names import ROS_RELEASE

from .folders import MANIFEST

MAX_TAGS = 2000
"""Maximum number of tags in a ``package.xml``: catkin_pkg compares all pairs of dependencies."""


@dataclass(frozen=True)
class Export:
    """A tag inside ``<export>``: information for other tools, such as the file that declares plugins."""

    tag: str
    attributes: tuple[tuple[str, str], ...] = ()

    def get(self, name: str) -> str | None:
        """Return the value of an attribute, or None if it is missing."""
        return dict(self.attributes).get(name)


@dataclass(frozen=True)
class Package:
    """A ROS package, as described by its manifest."""

    name: str
    path: Path
    version: str
    description: str
    depends: tuple[str, ...]
    """Packages needed to build or to run it, sorted, without build tools."""
    exec_depends: tuple[str, ...]
    """Packages needed to run it, in the order in which ``rospack depends1`` prints them."""
    is_metapackage: bool
    exports: tuple[Export, ...] = ()

    @property
    def manifest(self) -> Path:
        """The path of its manifest."""
        return self.path / MANIFEST


def _read(manifest: Path) -> bytes:
    try:
        return files.read(manifest)
    except OSError as error:
        raise DefinitionError(f"cannot be read: {error.strerror}", manifest) from error


class Heading(NamedTuple):
    """The part of a manifest that the index needs."""

    name: str
    is_metapackage: bool


def read_heading(manifest: Path) -> Heading:
    """Return the name in a ``package.xml``, and whether it describes a metapackage.

    Raises `DefinitionError` if the file cannot be read, is not XML, defines entities, or contains no name.
    """
    from xml.etree.ElementTree import ParseError

    from defusedxml.common import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    text = _read(manifest)
    try:
        root = fromstring(text)
    except ParseError as error:
        line, column = error.position
        reason = str(error).partition(":")[0]
        raise DefinitionError(f"this is not XML: {reason} at column {column + 1}", manifest, line) from error
    except DefusedXmlException as error:
        line = _line_at_fault(text, "'!ENTITY'")
        raise DefinitionError("a manifest may not define entities", manifest, line) from error
    except (LookupError, ValueError) as error:
        raise DefinitionError(f"this is not XML: {error}", manifest, 1) from error
    if root.tag != "package":
        raise DefinitionError(f"a manifest begins with <package>, this one with <{root.tag}>", manifest, 1)
    name = (root.findtext("name") or "").strip()
    if not name:
        raise DefinitionError("the package has no name; add <name>...</name>", manifest, _line_at_fault(text, ""))
    return Heading(name, root.find("export/metapackage") is not None)


def read_package(folder: Path) -> Package:
    """Return the package in ``folder``, from its ``package.xml``. Raises `DefinitionError` if that is invalid."""
    from catkin_pkg.package import InvalidPackage, parse_package_string

    manifest = folder / MANIFEST
    read_heading(manifest)  # check that it is harmless XML
    data = _read(manifest)
    if data.count(b"<") > MAX_TAGS:
        raise DefinitionError(f"it has more than {MAX_TAGS} tags, more than any real manifest", manifest)
    try:
        parsed = parse_package_string(data, str(manifest), warnings=[])
        with warnings.catch_warnings():  # catkin_pkg uses deprecated names of pyparsing
            warnings.simplefilter("ignore", DeprecationWarning)
            parsed.evaluate_conditions(ROS_RELEASE)
    except (InvalidPackage, AssertionError, ValueError, RecursionError) as error:
        reason = _reason(error)
        raise DefinitionError(reason, manifest, _line_at_fault(data, reason)) from error
    needed = [*parsed.build_depends, *parsed.build_export_depends, *parsed.exec_depends]
    return Package(
        name=parsed.name,
        path=folder,
        version=parsed.version,
        description=" ".join(parsed.plaintext_description.split()),
        depends=tuple(sorted({each.name for each in needed if each.evaluated_condition})),
        exec_depends=tuple(dict.fromkeys(each.name for each in parsed.exec_depends if each.evaluated_condition)),
        is_metapackage=parsed.is_metapackage(),
        exports=tuple(
            Export(each.tagname, tuple((str(name), str(text)) for name, text in each.attributes.items()))
            for each in parsed.exports
        ),
    )


def _reason(error: Exception) -> str:
    """Return catkin_pkg's error in one line and without its headings (our own error begins with the path)."""
    lines = [line.strip() for line in str(error).splitlines()]
    return "; ".join(line.removeprefix("- ") for line in lines if line and not line.startswith("Error(s)"))


def _line_at_fault(data: bytes, reason: str) -> int:
    """Return the line to which ``reason`` refers: that of the first tag or text it quotes, or else the root's."""
    text = data.decode(errors="replace")
    quoted = re.findall(r"""(?<!\w)(["'])(.+?)\1(?!\w)""", reason)
    for words in ([f"<{word}" for _, word in quoted], [word for _, word in quoted], ["<package"]):
        for word in words:
            match = re.search(re.escape(word) + r"(?!\w)", text)
            if match is not None:
                return text.count("\n", 0, match.start()) + 1
    return 1
