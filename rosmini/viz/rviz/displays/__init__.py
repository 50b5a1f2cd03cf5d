"""The displays, one file each, found by their names (`rviz/LaserScan`) through the entry points `rosmini.plugins`."""
