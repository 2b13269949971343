"""What all driving checks say of themselves."""

HOW = (
    "The seed draws kind and roughness of the road (Sayers' spectra of Table 2.2, a measured "
    "profile, ISO 8608) and every sensor's errors, which are those of section 4.3 and Table 6.1. "
    "The profile is compared with the road along the laser's path, high-pass filtered alike "
    "(-3 dB at 91.44 m), at lags of up to 1 m, over 160.9 m that lie 106 m or more from both "
    "ends of the run; the car of the IRI has been running since 120 m before. "
)
"""How drives are made and compared."""
EVENTS = (
    "The 160.9 m begin 96 m ahead of the event, where brakes are released and vehicles stand, as "
    "in the runs of section 5.2. "
)
BUMP_FLOOR = (
    "A bump of 20 mm, a raised cosine 3 m long, lies {where}, and the profile has to show it: "
    "height, level, slope and displacement of the bump are fitted to the result less the truth "
    "over 9 m, and the height may be wrong by 10, 5 and 2 % of the bump in the three classes. "
    "{slow}A rough road stays rough, too: its IRI is limited from below as from above, and all "
    "zeros are off by 100 %. "
)
EVERYWHERE = BUMP_FLOOR.format(where="where the speed is still constant", slow="")
FLAGS = "At each end 106 m may be flagged (reference: 53 m), a cut-off wavelength, or half of it. "
"""How much may be flagged at the ends."""
EVENT_FLAGS = FLAGS + (
    "Around each event, beyond what is travelled below 16 km/h, 125 m may be flagged in class "
    "nominal, since up to 47 m before a stop and 76 m behind it were found contaminated (3.3.7), "
    "10 m in adequate and 5 m in reference. "
)
NO_EVENT_FLAGS = FLAGS + (
    "Elsewhere nothing happens that would call for a flag: 10 m are left (reference: 5 m), what "
    "an event is allowed where no filter spreads it. "
)
