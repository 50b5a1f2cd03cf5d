"""catkin, ROS's build system, limited to packages of scripts and messages (http://wiki.ros.org/catkin).

A workspace has its packages in ``src``. `create_package` and `init_workspace` create the same files as catkin's
tools; `make` reads the ``CMakeLists.txt`` of each package, checks it against the ``package.xml``, generates Python
modules for messages, services and actions in ``devel``, and writes the setup files for shells. It compiles no C++.
"""

from .build import Report, make
from .creation import NewPackage, create_package, init_workspace
from .findings import CatkinError
from .workspace import Workspace

__all__ = ["CatkinError", "NewPackage", "Report", "Workspace", "create_package", "init_workspace", "make"]
