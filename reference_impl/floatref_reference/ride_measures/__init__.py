"""Measures that contracts pay by, each from its public source.

- `areas`: stretches beyond a limit, and how much of them is valid.
- `localized`: localized roughness by continuous IRI, and bumps and dips against a moving average.
- `lane`: MRI, HRI and Ride Number of two wheel paths.
- `straightedge`: a straightedge that rolls.
- `profilograph`: the trace of a profilograph, its profile index, and what must be ground.
- `bands`: RMS elevation and RMS slope between two wavelengths.
- `sections`: sections of 0.1 mile and their ratings.
"""
