"""Faults of the encoder, whose distance all wheel paths share."""

from floatref_conformance.faults import count_faults as c
from floatref_conformance.faults import sample_faults as f
from floatref_conformance.faults.listed import ListedFault, clocked, part, whole
from floatref_conformance.faults.of_accelerometers import FOOT_M
from floatref_conformance.faults.placing import DISTANCE, clock_fast, late, state_rate

COUNT_M = 0.002
"""Distance of one count in m, with which a counter of 16 bits wraps within the run."""

ENCODER_FAULTS: tuple[ListedFault, ...] = (
    whole("encoder-in-feet", DISTANCE, "in feet", f.scale(1 / FOOT_M)),
    whole("encoder-in-km", DISTANCE, "in km", f.scale(0.001)),
    *(whole(f"encoder-scale-{k:g}", DISTANCE, f"scale {k:g}", f.scale(k))
      for k in (0.5, 0.8, 0.95, 1.05, 1.25, 2.0)),
    whole("encoder-backwards", DISTANCE, "counts backwards", c.descend),
    part("encoder-backwards-midway", DISTANCE, "counts backwards from one place on", c.descend,
         None),
    *(clocked(f"encoder-late-{s:g}-s", DISTANCE, f"{s:g} s late", late(s))
      for s in (0.05, 0.5, 1.0, 3.0)),
    clocked("encoder-early-1-s", DISTANCE, "1 s early", late(-1.0)),
    clocked("encoder-clock-1-percent-fast", DISTANCE, "clock 1 % fast", clock_fast(0.01)),
    clocked("encoder-clock-jump-1-s", DISTANCE, "1 s late from one place on", late(1.0, 250.0),
            run=False),
    clocked("encoder-rate-halved", DISTANCE, "stated rate half the true one", state_rate(0.5)),
    part("encoder-half-lost", DISTANCE, "half of the counts lost for 2 s", c.count(0.5, 2.0), None),
    part("encoder-half-lost-to-the-end", DISTANCE, "half of the counts lost from one place on",
         c.count(0.5), None),
    part("encoder-fifth-lost", DISTANCE, "a fifth of the counts lost for 3 s", c.count(0.8, 3.0),
         None),
    part("encoder-all-lost", DISTANCE, "no counts for 1 s", c.count(0.0, 1.0), None),
    part("encoder-doubled", DISTANCE, "every count doubled for 2 s", c.count(2.0, 2.0), None),
    part("encoder-stuck-to-the-end", DISTANCE, "stuck from one place on", f.hold, None),
    part("encoder-silent", DISTANCE, "silent for 0.5 s, then right again", c.silence(0.5), None),
    part("encoder-leap-10-m", DISTANCE, "10 m counted at once", c.leap(10.0), None),
    part("encoder-leap-1-m", DISTANCE, "1 m counted at once", c.leap(1.0), None),
    part("encoder-leap-back", DISTANCE, "20 m back at once", c.leap(-20.0), None),
    whole("encoder-wraps", DISTANCE, "a counter of 16 bits of 2 mm", c.wrap(COUNT_M)),
    whole("encoder-trembles", DISTANCE, "1 % of the samples 10 mm behind", c.tremble(0.01, 0.01)),
    whole("encoder-jitters", DISTANCE, "counts read 2 ms too early or late", c.jitter(0.002)),
    whole("encoder-hesitates", DISTANCE, "delivered in bursts of 0.1 s", c.hesitate(0.1, 0.099)),
    whole("encoder-quantised-0.5-m", DISTANCE, "steps of 0.5 m", f.quantise(0.5)),
    part("encoder-drop-out-0.3-s", DISTANCE, "no samples for 0.3 s", f.lose, 0.3),
    part("encoder-drop-out-3-s", DISTANCE, "no samples for 3 s", f.lose, 3.0),
    whole("encoder-mostly-lost", DISTANCE, "60 % of the samples lost", f.lose_randomly(0.6)),
    part("encoder-drop-out-as-0", DISTANCE, "0 for 0.1 s", f.constant(0.0), 0.1),
)  # fmt: skip
"""Faults of the channel ``distance``."""
