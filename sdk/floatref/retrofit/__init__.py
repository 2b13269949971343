"""Every algorithm of chapter 5 alone, for other engines: plain arrays in and out.

One object per wheel path and run. It takes chunks of any length from one sample up, stores its
state between them, and gives the numbers of the pipelines' stages, bit for bit, for any division
into chunks. Arrays are float64 of shape (N,), the result is a new array of the same length, and the
arguments are not changed. `copy.deepcopy` saves the state.

A missing sample is NaN, or masked. It is replaced by the sample before it, so the result has no
NaN; ``bridged`` counts such samples, and `numpy.isnan` of the chunk marks them. An infinite sample,
signals of different length in one call, or a speed without a possible cut-off raise InputError, and
a refused chunk does not change the state. A set of calls that belongs together (acceleration,
velocity and height) is counted, and an incomplete one raises StageError.

The algorithms are linear in the vertical signals, so these may be in any unit, the same for
all of them; m/s², m/s and m are meant below. Speeds are in m/s, time in s, distance in m.
"""

from floatref.retrofit.adaptive import AdaptiveHighPass as AdaptiveHighPass
from floatref.retrofit.high_pass import HighPass as HighPass
from floatref.retrofit.high_pass import SpatialHighPass as SpatialHighPass
from floatref.retrofit.low_speed import HeightReflection as HeightReflection
from floatref.retrofit.low_speed import LocalSuppression as LocalSuppression
from floatref.retrofit.low_speed import TimerDistortion as TimerDistortion
from floatref.retrofit.matched import MatchedHighPass as MatchedHighPass
from floatref.retrofit.travel import TravelSpeed as TravelSpeed
from floatref.stages.filters.schedule import AdaptiveCutOff as AdaptiveCutOff
