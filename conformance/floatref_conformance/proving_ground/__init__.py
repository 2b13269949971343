"""Roads, drives, vehicles and sensors whose truth is known."""
