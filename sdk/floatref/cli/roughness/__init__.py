"""`floatref roughness`: what a road is paid by, beside its IRI."""
