"""What a robot measures: lasers, cameras, inertial units, bumpers, batteries and their errors.

Numbers in, numbers out.
"""
