"""`floatref tune`: noise settings of a Kalman pipeline."""
