"""`floatref allan`: the noise of sensors at rest."""
