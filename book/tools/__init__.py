"""What those who write the book need: its build, the stored form of notebooks, and what pages may contain.

None of this is in the wheel.
"""
