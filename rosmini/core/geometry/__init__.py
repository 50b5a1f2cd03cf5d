"""Plane geometry on arrays, without nodes or clocks. Metres, radians, angles counter-clockwise (REP 103)."""
