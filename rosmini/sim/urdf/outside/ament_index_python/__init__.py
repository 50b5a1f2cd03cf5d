"""The module through which PyPI's xacro resolves ``$(find NAME)``; it is a module of ROS 2.

With this version, the command ``xacro`` and ``import xacro`` find ROS 1 packages as `rosmini.core.packages` does. If
ROS 2 is set up, its own module comes first on the path.
"""
