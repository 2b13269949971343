"""Families: roads, vehicles and sensors as they are in streets, every pipeline against the truth.

`make_family_table` draws the drives of every condition, simulates them, has every pipeline process
each, and compares the profiles with the road along the laser's path, along the
true distance and along the encoder's.
"""

from floatref_conformance.table.families.conditions import CONDITIONS, FAMILIES, Condition
from floatref_conformance.table.families.family_making import make_family_table
from floatref_conformance.table.families.family_scores import FamilyScores, PathScores
from floatref_conformance.table.families.family_settings import FamilySettings
from floatref_conformance.table.families.family_table import FamilyTable

__all__ = [
    "CONDITIONS",
    "FAMILIES",
    "Condition",
    "FamilyScores",
    "FamilySettings",
    "FamilyTable",
    "PathScores",
    "make_family_table",
]
