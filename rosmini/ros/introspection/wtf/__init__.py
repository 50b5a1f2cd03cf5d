"""The checks of ``roswtf``: probable faults of a graph, and how to fix them (http://wiki.ros.org/roswtf).

A survey queries the Master and every node once; the rules are functions of the survey, of messages received on ``/tf``
and ``/rosout`` meanwhile, and of the environment, and each returns findings.
"""
