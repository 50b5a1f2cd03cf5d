"""Greedy frontier exploration on a map (http://wiki.ros.org/explore_lite).

`costs` ranks the frontiers; the node stores a map and sends goals to move_base. Frontiers are found by
`rosmini.navigation.frontier_exploration.search`; the original also shares its search with that package.
"""
