"""Where xacro asks for packages: PyPI's xacro resolves ``$(find NAME)`` through a module of this name, which is a part of ROS 2.

With this one, the command ``xacro`` and ``import xacro`` find ROS 1 packages by themselves, as `rosmini.packages` does. Where ROS 2 is set up, its own
stands before it on the path.
"""
