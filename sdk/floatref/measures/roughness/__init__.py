"""IRI, where the roughness lies, and the agreement of two profiles."""
