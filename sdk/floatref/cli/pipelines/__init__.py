"""`floatref pipelines`: which pipeline for which sensors, and all of them."""
