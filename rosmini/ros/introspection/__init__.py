"""What is in a graph, asked of the Master and of the nodes: what ``rosnode`` and ``rostopic`` find out.

Nothing here knows whether the Master and the nodes are in this process or elsewhere: it asks
``Peers``, which a ``Graph`` is. The modules are imported one by one:
a tool that asks a question or two starts without the rest of rosmini.
"""
