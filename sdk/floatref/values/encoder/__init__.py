"""Whether the distance of an encoder is plausible: range, direction, length, speed, counts."""
