"""catkin, ROS's build system, for packages of scripts and messages (http://wiki.ros.org/catkin).

A workspace has its packages in ``src``. `create_package` and `init_workspace` make the files that catkin's own tools
make; `make` reads the ``CMakeLists.txt`` of each package, checks it against the ``package.xml``, makes Python modules
of messages, services and actions in ``devel``, and what a shell sources to find it all. It compiles no C++.
"""

from .build import Report, make
from .creation import NewPackage, create_package, init_workspace
from .findings import CatkinError, Finding
from .workspace import Workspace

__all__ = [
    "CatkinError",
    "Finding",
    "NewPackage",
    "Report",
    "Workspace",
    "create_package",
    "init_workspace",
    "make",
]
