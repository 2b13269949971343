"""The slip of the encoder's wheel, from a second source of distance or from two passes."""
