"""From a recording to blocks: one clock, damaged samples, the encoder's path, held values."""
