"""Dependencies between packages, as rospack and rosstack report them (http://wiki.ros.org/rospack).

Only run-time dependencies count, and only those that are packages: the others are system libraries.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rosmini.core.errors import DefinitionError, UnknownPackage, nearest
from rosmini.core.packages import BUILT_IN, Package, PackageIndex


@dataclass(frozen=True)
class Dependencies:
    """The dependency graph of the packages, or, if ``stacks`` is true, of the stacks of an index.

    rospack does not count metapackages as packages. rosstack counts every package as a stack.
    """

    index: PackageIndex
    stacks: bool = False

    @property
    def noun(self) -> str:
        """The word for one of them."""
        return "stack" if self.stacks else "package"

    def names(self) -> list[str]:
        """Return the names, sorted."""
        return sorted({*self.index.names()} - (set() if self.stacks else {*self.index.metapackages()}))

    def find(self, name: str) -> Package:
        """Return one of them. Raises `UnknownPackage`, with similar names, and `DefinitionError` for a bad manifest."""
        if name not in self.names():
            raise UnknownPackage(BUILT_IN.get(name) or nearest(name, self.names()))
        return self.index.find(name)

    def path(self, name: str) -> Path:
        """Return the folder of one. Raises as `find` does, but does not read the manifest."""
        if name not in self.names():
            raise UnknownPackage(BUILT_IN.get(name) or nearest(name, self.names()))
        return self.index.path(name)

    def manifest(self, name: str) -> Path:
        """Return the path of a manifest. Raises as `find` does."""
        return self.find(name).manifest

    def direct(self, name: str) -> list[str]:
        """Return the direct dependencies of ``name``, in rospack's order. Raises as `find` does."""
        known = {*self.names()}
        return [each for each in self.find(name).exec_depends if each in known]

    def all_of(self, name: str) -> list[str]:
        """Return all dependencies of ``name``, each after its own dependencies. Raises as `direct` does."""
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
        """Return the direct or all dependents of ``name``, sorted, and the errors of unreadable manifests.

        ``name`` need not exist.
        """
        needed_by: dict[str, list[str]] = {}
        broken = []
        for each in self.names():
            try:
                package = self.find(each)
            except DefinitionError as error:
                broken.append(error)
                continue
            for need in package.exec_depends:
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
