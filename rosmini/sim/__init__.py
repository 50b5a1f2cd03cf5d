"""The simulator: engine, worlds, robots and sensors; Stage, Gazebo, turtlesim and Logo on top of it."""
