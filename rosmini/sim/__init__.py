"""The simulator: worlds, robots and their sensors, and the node that puts them on a graph."""
