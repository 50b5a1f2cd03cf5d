"""Reads a launch file with real roslaunch, and prints the CPU time in ms that one reading takes, xacro included."""

from __future__ import annotations

import resource
import sys
from importlib import import_module
from typing import Any


def spent() -> float:
    """CPU time of this process and of those it started [s]."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def read(file: str) -> Any:
    """Read it once, looking for packages again."""
    import_module("roslaunch.substitution_args").__dict__["_rospack"] = None
    loader = import_module("roslaunch.xmlloader").XmlLoader()
    loader.ignore_unset_args = False
    config = import_module("roslaunch.config").ROSLaunchConfig()
    loader.load(file, config, argv=[], verbose=False)
    return config


def main() -> None:
    """Read the file named first as often as said second."""
    file, count = sys.argv[1], int(sys.argv[2])
    found = read(file)
    begin = spent()
    for _ in range(count):
        read(file)
    print((spent() - begin) * 1e3 / count, len(found.nodes), len(found.params))


if __name__ == "__main__":
    main()
