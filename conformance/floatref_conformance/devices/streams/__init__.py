"""Devices that stream: samples go in while the vehicle drives, points of the profile come out."""
