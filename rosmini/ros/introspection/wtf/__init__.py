"""What ``roswtf`` finds out: what is probably wrong with a graph, and what to do about it (http://wiki.ros.org/roswtf).

A survey asks the Master and every node once; the rules are functions of what it found, of what was heard on ``/tf``
and ``/rosout`` meanwhile, and of the environment, and each returns findings.
"""
