"""Advice on pipelines: which one for which sensors, and what a named one cannot measure."""
