"""What manifests say: ``package.xml`` in its formats 1 to 3, ``manifest.xml`` and ``stack.xml`` of rosbuild."""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from rosmini.core import files
from rosmini.core.errors import DefinitionError
from rosmini.core.names import ROS_RELEASE

from .folders import MANIFEST, ROSBUILD_MANIFEST, STACK_MANIFEST

MOST_TAGS = 2000
"""How many tags a ``package.xml`` may have: catkin_pkg compares each dependency with all the others."""


@dataclass(frozen=True)
class Export:
    """A tag inside ``<export>``: what a package tells other tools, such as where its plugins are declared."""

    tag: str
    attributes: tuple[tuple[str, str], ...] = ()

    def get(self, name: str) -> str | None:
        """An attribute, or None."""
        return dict(self.attributes).get(name)


@dataclass(frozen=True)
class Package:
    """One ROS package, as its manifest describes it."""

    name: str
    path: Path
    version: str
    description: str
    depends: tuple[str, ...]
    """Packages needed to build or to run it, sorted; tools of the build are not among them."""
    exec_depends: tuple[str, ...]
    """Packages needed to run it, in the order in which ``rospack depends1`` prints them."""
    is_metapackage: bool
    exports: tuple[Export, ...] = ()
    is_rosbuild: bool = False
    """True for a package of the time before catkin, which has a ``manifest.xml``."""

    @property
    def manifest(self) -> Path:
        """The file that describes it."""
        return self.path / (ROSBUILD_MANIFEST if self.is_rosbuild else MANIFEST)


@dataclass(frozen=True)
class Stack:
    """A stack of the time before catkin: a folder of packages with a ``stack.xml``."""

    name: str
    path: Path
    version: str
    depends: tuple[str, ...]
    """The stacks that it needs, in the order of the file."""


def _read(manifest: Path) -> bytes:
    try:
        return files.read(manifest)
    except OSError as error:
        raise DefinitionError(f"cannot be read: {error.strerror}", manifest) from error


class Heading(NamedTuple):
    """What the index has to know of each package."""

    name: str
    is_metapackage: bool


def read_heading(manifest: Path) -> Heading:
    """What a ``package.xml`` gives as its name. Raises `DefinitionError` if it is not XML or has no name."""
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
        raise DefinitionError(
            "the package has no name; add <name>...</name>", manifest, _line_at_fault(text, "")
        )
    return Heading(name, root.find("export/metapackage") is not None)


def read_package(folder: Path) -> Package:
    """The package in ``folder``, by its ``package.xml`` or else its ``manifest.xml``. Raises `DefinitionError`."""
    manifest = folder / MANIFEST
    if not manifest.is_file() and (folder / ROSBUILD_MANIFEST).is_file():
        return _read_rosbuild(folder)
    from catkin_pkg.package import InvalidPackage, parse_package_string

    read_heading(manifest)  # that it is XML, and harmless
    data = _read(manifest)
    if data.count(b"<") > MOST_TAGS:
        raise DefinitionError(f"this has more than {MOST_TAGS} tags: no manifest has", manifest)
    try:
        parsed = parse_package_string(data, str(manifest), warnings=[])
        with warnings.catch_warnings():  # catkin_pkg calls pyparsing by names that pyparsing means to drop
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
        exec_depends=tuple(
            dict.fromkeys(each.name for each in parsed.exec_depends if each.evaluated_condition)
        ),
        is_metapackage=parsed.is_metapackage(),
        exports=tuple(
            Export(each.tagname, tuple((str(name), str(text)) for name, text in each.attributes.items()))
            for each in parsed.exports
        ),
    )


def _read_rosbuild(folder: Path) -> Package:
    """The package whose ``manifest.xml`` is in ``folder`` (http://wiki.ros.org/Manifest); it is named as its folder."""
    from rosmini.core.markup import parse_file

    root = parse_file(folder / ROSBUILD_MANIFEST)
    if root.tag != "package":
        raise root.error(f"a manifest begins with <package>, this one with <{root.tag}>")
    needed = tuple(dict.fromkeys(each.attribute("package") for each in root.all("depend")))
    exports = [each for block in root.all("export") for each in block]
    return Package(
        name=folder.name,
        path=folder,
        version=root.word("version"),
        description=" ".join(root.word("description").split()),
        depends=tuple(sorted(needed)),
        exec_depends=needed,
        is_metapackage=False,
        exports=tuple(Export(each.tag, tuple(each.attributes.items())) for each in exports),
        is_rosbuild=True,
    )


def read_stack(folder: Path) -> Stack:
    """The stack whose ``stack.xml`` is in ``folder``; it is named as its folder. Raises `DefinitionError`."""
    from rosmini.core.markup import parse_file

    root = parse_file(folder / STACK_MANIFEST)
    if root.tag != "stack":
        raise root.error(f"a stack's manifest begins with <stack>, this one with <{root.tag}>")
    needed = tuple(dict.fromkeys(each.attribute("stack") for each in root.all("depend")))
    return Stack(folder.name, folder, root.word("version"), needed)


def _reason(error: Exception) -> str:
    """What catkin_pkg says, in one line and without its headings (our own error begins with the path)."""
    lines = [line.strip() for line in str(error).splitlines()]
    return "; ".join(line.removeprefix("- ") for line in lines if line and not line.startswith("Error(s)"))


def _line_at_fault(data: bytes, reason: str) -> int:
    """The line of a manifest that ``reason`` speaks of: that of the first tag or text it quotes, else of the root."""
    text = data.decode(errors="replace")
    quoted = re.findall(r"""(?<!\w)(["'])(.+?)\1(?!\w)""", reason)
    for words in ([f"<{word}" for _, word in quoted], [word for _, word in quoted], ["<package"]):
        for word in words:
            match = re.search(re.escape(word) + r"(?!\w)", text)
            if match is not None:
                return text.count("\n", 0, match.start()) + 1
    return 1
