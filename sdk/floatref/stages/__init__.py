"""Stages: each does one operation on blocks, under one protocol with laws."""
