"""Geometry of worlds: what a laser sees, outlines of maps, sections of meshes, overlaps."""
