"""Roads of the proving ground: random, measured, and of sine waves."""
