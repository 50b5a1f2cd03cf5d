"""What packages need, and what needs them, as rospack and rosstack count it (http://wiki.ros.org/rospack).

Only what is needed to run a package counts, and only what is a package: the rest are libraries of the system.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rosmini.core.errors import DefinitionError, RosminiError, UnknownPackage, nearest

from .index import BUILT_IN, PackageIndex
from .manifest import Package, Stack

LONGEST_ANSWER = 10_000
"""The largest number of lines of an answer that can grow exponentially with the number of packages."""


@dataclass(frozen=True)
class Dependencies:
    """The packages or, if ``stacks`` is true, the stacks of an index, as nodes of a graph.

    To rospack a metapackage is no package. To rosstack every package of catkin is a stack, and so is a folder with a
    ``stack.xml``; packages of rosbuild are none.
    """

    index: PackageIndex
    stacks: bool = False

    @property
    def noun(self) -> str:
        """What they are."""
        return "stack" if self.stacks else "package"

    def names(self) -> list[str]:
        """The names, sorted."""
        if not self.stacks:
            return sorted({*self.index.names()} - {*self.index.metapackages()})
        wet = (name for name in self.index.names() if (self.index.path(name) / "package.xml").is_file())
        return sorted({*wet, *self.index.stacks()})

    def find(self, name: str) -> Package | Stack:
        """One of them. Raises `UnknownPackage` with the nearest names, `DefinitionError` if its manifest is broken."""
        if name not in self.names():
            raise UnknownPackage(BUILT_IN.get(name) or nearest(name, self.names()))
        if self.stacks and name in self.index.stacks():
            return self.index.find_stack(name)
        return self.index.find(name)

    def path(self, name: str) -> Path:
        """The folder of one. Raises as `find` does, but does not read the manifest."""
        if name not in self.names():
            raise UnknownPackage(BUILT_IN.get(name) or nearest(name, self.names()))
        if self.stacks and name in self.index.stacks():
            return self.index.find_stack(name).path
        return self.index.path(name)

    def manifest(self, name: str) -> Path:
        """The manifest of one. Raises as `find` does."""
        found = self.find(name)
        return found.path / "stack.xml" if isinstance(found, Stack) else found.manifest

    def direct(self, name: str) -> list[str]:
        """What ``name`` needs, in the order of rospack.

        Raises as `find` does, and `RosminiError` if a package of rosbuild or a stack needs what is not there.
        """
        found, known = self.find(name), {*self.names()}
        if isinstance(found, Stack) or found.is_rosbuild:
            needed = found.depends if isinstance(found, Stack) else found.exec_depends
            for each in needed:
                if each not in known:
                    hint = nearest(each, known)
                    raise RosminiError(
                        f"{self.noun} '{name}' depends on non-existent package '{each}'; "
                        f"{hint or f'check the ROS_PACKAGE_PATH, or {self.manifest(name)}'}"
                    )
            return list(needed)
        return [each for each in found.exec_depends if each in known]

    def all_of(self, name: str) -> list[str]:
        """All that ``name`` needs, each after what it needs itself. Raises as `direct` does, of any of them."""
        order: dict[str, None] = {}
        entered = {name}
        waiting = [(name, iter(self.direct(name)))]
        while waiting:
            current, rest = waiting[-1]
            child = next(rest, None)
            if child is None:
                waiting.pop()
                order[current] = None
            elif child not in entered:
                entered.add(child)
                waiting.append((child, iter(self.direct(child))))
        del order[name]
        return list(order)

    def dependents(self, name: str, *, direct: bool) -> tuple[list[str], list[DefinitionError]]:
        """What needs ``name``, directly or at all, sorted, and the manifests that could not be read.

        ``name`` need not be there.
        """
        needed_by: dict[str, list[str]] = {}
        broken = []
        for each in self.names():
            try:
                package = self.find(each)
            except DefinitionError as error:
                broken.append(error)
                continue
            for need in package.depends if isinstance(package, Stack) else package.exec_depends:
                needed_by.setdefault(need, []).append(each)
        if direct:
            return sorted(needed_by.get(name, ())), broken
        found: set[str] = set()
        waiting = [name]
        while waiting:
            new = set(needed_by.get(waiting.pop(), ())) - found
            found |= new
            waiting += sorted(new)
        return sorted(found), broken

    def tree(self, name: str) -> list[str]:
        """What ``name`` needs, indented below what needs it; at most `LONGEST_ANSWER` lines."""
        lines: list[str] = []
        for way in self._ways(name):
            lines.append("  " * (len(way) - 2) + way[-1])
            if len(lines) >= LONGEST_ANSWER:
                break
        return lines

    def chains(self, name: str, target: str) -> list[list[str]]:
        """Every chain of needs from ``name`` to ``target``; at most `LONGEST_ANSWER`."""
        able = {target, *self.dependents(target, direct=False)[0]}
        found: list[list[str]] = []
        for way in self._ways(name, able):
            if way[-1] == target:
                found.append(way)
            if len(found) >= LONGEST_ANSWER:
                break
        return found

    def _ways(self, name: str, within: set[str] | None = None) -> Iterator[list[str]]:
        """Every way from ``name`` to what it needs, and so on, a package before what it needs itself."""
        way = [name]
        waiting = [iter(self.direct(name))]
        while waiting:
            child = next(waiting[-1], None)
            if child is None:
                waiting.pop()
                way.pop()
            elif child not in way and (within is None or child in within):
                way.append(child)
                yield list(way)
                waiting.append(iter(self.direct(child)))
