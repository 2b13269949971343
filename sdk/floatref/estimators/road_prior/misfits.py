"""The normalized innovations of the road-prior filter of a wheel path."""

from dataclasses import dataclass, field

import numpy as np

from floatref.estimators.road_prior.leaps import are_let_go
from floatref.estimators.smoothing.nodes import Nodes
from floatref.values.arrays import Records
from floatref.values.innovations import Innovations

MOVING, STANDING = "height", "height_at_standstill"


@dataclass(eq=False)
class Misfits:
    """What the readings of the height sensor were off by, over what the filter expected.

    While the vehicle moves, most of that is new road; at a standstill it is noise of the sensor.

    Attributes:
        origin_s: time of sample 0, in s.
        step: between two samples, in s.
        edge: square of how many deviations a reading at a standstill is off at an edge.
        kinds: `MOVING` and `STANDING`.
        begun: whether there was a reading, from which the height begins; it does not count.
    """

    origin_s: float
    step: float
    edge: float
    kinds: dict[str, Innovations] = field(
        default_factory=lambda: {MOVING: Innovations(), STANDING: Innovations()}
    )
    begun: bool = False

    def add(self, nodes: Nodes, ends: Records) -> None:
        """Take the readings of ``nodes``; for ``ends`` see `road_prior_values`.

        ν/√S is the update's ν/S over the root of its 1/S. Where the road was let go S holds ν²
        itself, and the reading counts as left out.
        """
        seen = ~np.isnan(ends["seen"])
        updates = nodes.updates
        z = updates["innovation"] / np.sqrt(updates["information"])
        standing = ends["travel"][seen] <= 0.0
        gone = standing & are_let_go(nodes, self.edge)
        counts = ~gone
        if not self.begun and z.size:
            counts[0], self.begun = False, True
        times_s = self.origin_s + self.step * nodes.at[seen]
        self.kinds[STANDING].left_out += int(np.count_nonzero(gone))
        for name, chosen in ((MOVING, ~standing & counts), (STANDING, standing & counts)):
            self.kinds[name].add(times_s[chosen], z[chosen])

    def finish(self) -> dict[str, Innovations]:
        """Return the kinds that there were."""
        return {name: each for name, each in self.kinds.items() if each.count or each.left_out}
