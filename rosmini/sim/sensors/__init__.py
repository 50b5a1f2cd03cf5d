"""Models of a robot's sensors and their errors: lasers, cameras, inertial units, bumpers, batteries.

Numbers in, numbers out.
"""
