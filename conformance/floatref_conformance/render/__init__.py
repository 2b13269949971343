"""Renderers: each turns the one stream of events into its own form of output."""
