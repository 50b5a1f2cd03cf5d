"""The devices of simulated robots, shared by TurtleBot3's simulator, Stage and Gazebo."""
