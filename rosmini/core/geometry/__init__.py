"""Plane geometry: arrays in, arrays out, no node and no clock. Metres, radians, angles counter-clockwise (REP 103)."""
