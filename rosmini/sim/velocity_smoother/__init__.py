"""`yocs_velocity_smoother`: limits commands to velocities that a robot can follow."""
