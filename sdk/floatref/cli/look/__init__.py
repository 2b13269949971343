"""`floatref view` and `floatref plot`: what a profile or a recording looks like."""
