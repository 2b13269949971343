"""The road from the vehicle's response: models, and estimators of unknown inputs.

Arrays in, arrays out. A model has the coordinates q of its freedoms and M·q'' + C·q' + K·q = S·F,
where F holds the forces k·u + c·u' of the tyres in N over the road u in m. States are x = (q, q').
"""

from floatref.response.model import Freedom, Tyre, VehicleModel
from floatref.response.reading import Kind, Reading

__all__ = ["Freedom", "Kind", "Reading", "Tyre", "VehicleModel"]
