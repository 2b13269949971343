"""Observers of models whose displacements are measured."""

from floatref.vehicle_response import Kind, Reading


def readings(model, *without):
    return [
        Reading(Kind.DISPLACEMENT, freedom.name, 1e-4)
        for freedom in model.freedoms
        if freedom.name not in without
    ]
