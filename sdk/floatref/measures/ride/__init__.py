"""Measures of ride that contracts pay by, beside the IRI of one wheel path."""
