"""The meshes in `assets/ros/turtlebot3_description/meshes`."""
