"""Layers of lines for a GIS: GeoJSON and GeoPackage."""
