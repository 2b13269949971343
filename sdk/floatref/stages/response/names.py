"""Names of the channels that the response architecture makes, per wheel path unless said."""

ELEVATION_UNDER, SIGMA_UNDER = "elevation_under_tyre", "sigma_under_tyre"


def elevation_under(number: int) -> str:
    """Return the channel of the road under tyre ``number`` of the model, in m."""
    return f"{ELEVATION_UNDER}_{number}"


def sigma_under(number: int) -> str:
    """Return the channel of its 1-σ, in m."""
    return f"{SIGMA_UNDER}_{number}"
