"""Local planners that roll trajectories out and score them (http://wiki.ros.org/base_local_planner).

The pieces, which `dwa_local_planner` uses too, are arrays in and arrays out; `plugin` meets the graph.
"""
