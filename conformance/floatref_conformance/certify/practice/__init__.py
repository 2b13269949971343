"""Practices of certification: which quantity has which limit, by which clause, of which source."""
