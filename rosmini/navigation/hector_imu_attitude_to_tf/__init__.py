"""How a robot leans, from its IMU, as a transform (http://wiki.ros.org/hector_imu_attitude_to_tf)."""
