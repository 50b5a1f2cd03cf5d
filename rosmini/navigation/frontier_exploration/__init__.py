"""Frontier exploration inside a polygon (http://wiki.ros.org/frontier_exploration).

Yamauchi, A frontier-based approach for autonomous exploration (CIRA 1997). `search` finds frontiers on a cost grid, and
`polygon` is the polygon that a user clicks; a costmap layer (`plugin`), a server (`node`) and a client (`client_node`)
connect them to the graph.
"""
