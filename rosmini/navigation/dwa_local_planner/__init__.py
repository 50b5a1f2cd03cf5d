"""The Dynamic Window Approach: which velocity of those reached in one cycle is best (Fox, Burgard and Thrun, 1997).

http://wiki.ros.org/dwa_local_planner. `dwa_planner` is the algorithm, on arrays; `plugin` meets the graph.
"""
