"""The editions of the judge: what each fixes, and where its limits come from."""

EDITIONS = ("2026.1", "2026.2")
"""The editions of the checks, the oldest first."""
EDITION = EDITIONS[-1]
"""The edition by default: it fixes the manoeuvres and the limits; the seed draws the rest."""
