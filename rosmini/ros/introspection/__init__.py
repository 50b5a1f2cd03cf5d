"""Inspection of a graph through the Master and the nodes: the functions behind ``rosnode`` and ``rostopic``.

The code does not depend on whether the Master and the nodes are in this process or elsewhere: it uses
``Peers``, which a ``Graph`` implements. Import the modules individually:
a tool with one or two queries then starts without the rest of rosmini.
"""
