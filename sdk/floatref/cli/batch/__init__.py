"""`floatref batch`: many recordings into profiles and one summary."""
