"""The Dynamic Window Approach: chooses among the velocities within reach of one cycle (Fox, Burgard and Thrun, 1997).

http://wiki.ros.org/dwa_local_planner. `dwa_planner` is the algorithm, on arrays; `plugin` connects it to the graph.
"""
