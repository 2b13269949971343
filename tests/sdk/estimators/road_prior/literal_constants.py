"""The constants of the road prior as its literal reference takes them."""

from floatref.estimators.road_prior import RoadPrior
from floatref_reference.road_prior.symbols import Constants


def literal_constants(c: RoadPrior, priors: tuple[float, ...]) -> Constants:
    """Return the reference's constants; ``priors`` are 1-σ of the inputs' coefficients."""
    return Constants(
        c.acceleration,
        c.acceleration_walk,
        c.walk_along,
        c.reading_m,
        c.road,
        c.long_waves,
        c.road_reach_m,
        sigma_b=c.acceleration_bias,
        sigma_kappa=priors,
    )
