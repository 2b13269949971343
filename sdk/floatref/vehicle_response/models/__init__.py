"""Linear models of vehicles on their tyres, and what is measured of them."""
