"""Stages: what is done to a block, one thing each, under one protocol with laws."""
