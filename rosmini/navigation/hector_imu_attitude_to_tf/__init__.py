"""A transform with a robot's roll and pitch, from its IMU (http://wiki.ros.org/hector_imu_attitude_to_tf)."""
