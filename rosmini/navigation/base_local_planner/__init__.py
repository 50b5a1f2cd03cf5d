"""Local planners that simulate trajectories and score them (http://wiki.ros.org/base_local_planner).

The algorithms, which `dwa_local_planner` also uses, work on arrays; `plugin` connects them to the graph.
"""
