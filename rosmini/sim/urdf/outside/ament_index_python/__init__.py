"""Where xacro looks for packages: PyPI's xacro resolves ``$(find NAME)`` through a ROS 2 module of this name.

With this one, the command ``xacro`` and ``import xacro`` find ROS 1 packages as `rosmini.core.packages` does. Where ROS
2 is set up, its own module comes first on the path.
"""
