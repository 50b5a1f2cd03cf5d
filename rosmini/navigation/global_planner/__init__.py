"""global_planner: several forms of Dijkstra's algorithm and A* (http://wiki.ros.org/global_planner)."""
