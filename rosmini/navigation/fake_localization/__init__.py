"""A localisation that knows the truth (http://wiki.ros.org/fake_localization)."""
