"""Checks of the exercises: one module for each chapter, `chapter_NN`."""
