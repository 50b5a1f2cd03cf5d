"""carrot_planner: moves as close to the goal as a straight line allows (http://wiki.ros.org/carrot_planner)."""
