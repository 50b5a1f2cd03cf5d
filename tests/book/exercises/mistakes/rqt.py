"""Wrong answers to the exercises of the chapter rqt."""

from __future__ import annotations

MISTAKES = {
    "options": [
        dict,
        lambda: {"mode": "all", "hide": "none"},
        lambda: {"mode": "all", "hide": "debug"},
        lambda: {"mode": "all", "nodes": "/eyes,/pilot,/spare"},
        lambda: {"mode": "active", "hide": "debug", "nodes": "/eyes,/pilot,/spare"},
        lambda: {"mode": "most"},
        lambda: {"mode": "all", "hide": "debugs"},
        lambda: {"mode": "all", "colour": "red"},
        lambda: "--mode all --hide debug",
    ],
    "field": [
        lambda: "/cmd_vel/angular/z",
        lambda: "/odom/twist/twist/linear/x",
        lambda: "/base_pose_ground_truth/twist/twist/angular/z",
        lambda: "/odom/twist/angular/z",
        lambda: "/scan/ranges",
        lambda: 0.8,
    ],
    "wave": [
        lambda: {"linear/x": "0.15"},
        lambda: {"angular/z": "0.8 * cos(i / 10)"},
        lambda: {"linear/x": "0.15", "angular/z": "0.8 * sin(i / 10)"},
        lambda: {"linear/x": "0.15", "angular/z": "0.5"},
        lambda: {"linear/x": "0.15", "angular/x": "0.8 * cos(i / 10"},
        lambda: {"linear": "0.15"},
        lambda: "0.8 * cos(i / 10)",
    ],
}
