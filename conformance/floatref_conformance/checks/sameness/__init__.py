"""The checks of equal results: between two passes, and after an irrelevant change."""
