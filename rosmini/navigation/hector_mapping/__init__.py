"""Mapping with a laser alone, by matching scans with maps on several scales (http://wiki.ros.org/hector_mapping).

Kohlbrecher, Meyer, von Stryk and Klingauf, A flexible and scalable SLAM system with full 3D motion estimation (SSRR
2011). `grid` is a map and its update, `matching` matches a scan with a map, `slam` combines the scales, `scans`
converts ranges to points; `node` is separate.
"""
