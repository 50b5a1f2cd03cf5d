"""Checks of the exercises: one module for each chapter, with the chapter's name."""
