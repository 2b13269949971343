"""Faults of the height sensor of the first wheel path, and of sides that are exchanged."""

from floatref_conformance.faults import sample_faults as f
from floatref_conformance.faults.listed import ListedFault, clocked, hidden, part, whole
from floatref_conformance.faults.of_accelerometers import (
    FOOT_M,
    FORCE,
    INCH_M,
    LAGS_S,
    SCALES,
)
from floatref_conformance.faults.placing import clock_fast, copy, exchange, late, state_rate

HEIGHT = "height"
STRIP = "strip"
"""The twin in which the laser reads a strip of the road beside the tyres' path."""

SIGNS_AND_UNITS = (
    whole("laser-sign", HEIGHT, "sign inverted", f.scale(-1.0)),
    whole("laser-sign-about-median", HEIGHT, "longer is closer", f.scale_about(-1.0)),
    whole("laser-in-mm", HEIGHT, "in mm", f.scale(1000.0)),
    whole("laser-in-cm", HEIGHT, "in cm", f.scale(100.0)),
    whole("laser-in-inches", HEIGHT, "in inches", f.scale(1 / INCH_M)),
    whole("laser-in-feet", HEIGHT, "in feet", f.scale(1 / FOOT_M)),
    *(whole(f"laser-scale-{k:g}", HEIGHT, f"scale {k:g}", f.scale(k)) for k in SCALES),
    part("laser-scale-halved-midway", HEIGHT, "scale 0.5 from one place on",
         f.scale_about(0.5), None),
)  # fmt: skip
CLOCKS = (
    *(clocked(f"laser-late-{1000 * s:g}-ms", HEIGHT, f"{1000 * s:g} ms late", late(s))
      for s in LAGS_S),
    clocked("laser-early-20-ms", HEIGHT, "20 ms early", late(-0.02)),
    clocked("laser-clock-1-percent-fast", HEIGHT, "clock 1 % fast", clock_fast(0.01)),
    clocked("laser-clock-1-percent-slow", HEIGHT, "clock 1 % slow", clock_fast(-0.01)),
    clocked("laser-clock-0.1-percent-fast", HEIGHT, "clock 0.1 % fast", clock_fast(0.001)),
    clocked("laser-clock-jump-50-ms", HEIGHT, "50 ms late from one place on", late(0.05, 250.0),
            run=False),
    clocked("laser-rate-halved", HEIGHT, "stated rate half the true one", state_rate(0.5)),
    clocked("laser-rate-1-percent-high", HEIGHT, "stated rate 1 % high", state_rate(1.01)),
)  # fmt: skip
SAMPLES = (
    part("laser-spike-0.1-m", HEIGHT, "one sample 0.1 m off", f.spikes(0.1, 1), 2.0),
    part("laser-spikes-0.1-m", HEIGHT, "20 samples 0.1 m off", f.spikes(0.1, 20), 3.0),
    part("laser-spikes-0.02-m", HEIGHT, "100 samples 0.02 m off", f.spikes(0.02, 100), 3.0),
    whole("laser-noise-only", HEIGHT, "noise of 5 mm", f.be_noise(0.005)),
    part("laser-noise-only-1-s", HEIGHT, "noise of 5 mm for 1 s", f.be_noise(0.005), 1.0),
    whole("laser-noise-added", HEIGHT, "noise of 3 mm added", f.add_noise(0.003)),
    whole("laser-hum", HEIGHT, "sine of 2 mm and 5 Hz added", f.add_hum(0.002, 5.0)),
    part("laser-ramp", HEIGHT, "ramp to 0.2 m within 3 s", f.ramp(0.2), 3.0),
    part("laser-step-0.2-m", HEIGHT, "0.2 m more from one place on", f.add(0.2), None),
    hidden(part("laser-step-20-mm", HEIGHT, "20 mm more from one place on", f.add(0.02), None),
           STRIP),
    hidden(part("laser-ramp-30-mm", HEIGHT, "ramp to 30 mm within 1 s", f.ramp(0.03), 1.0), STRIP),
    hidden(part("laser-swell-20-mm", HEIGHT, "half a sine of 20 mm within 0.3 s", f.swell(0.02),
                0.3), STRIP),
    whole("laser-stuck", HEIGHT, "stuck all the time", f.hold),
    part("laser-stuck-0.3-s", HEIGHT, "stuck for 0.3 s", f.hold, 0.3),
    part("laser-stuck-to-the-end", HEIGHT, "stuck from one place on", f.hold, None),
    part("laser-stuck-with-dither", HEIGHT, "stuck for 2 s but for the converter's noise",
         f.hold_with_dither(2e-5), 2.0),
    whole("laser-stuck-all-with-dither", HEIGHT, "stuck but for the converter's noise",
          f.hold_with_dither(2e-5)),
)  # fmt: skip
BANDS_AND_RANGES = (
    whole("laser-ac-coupled-0.5-hz", HEIGHT, "high-passed at 0.5 Hz", f.couple(0.5)),
    *(whole(f"laser-low-passed-{hz:g}-hz", HEIGHT, f"low-passed at {hz:g} Hz", f.smooth(hz))
      for hz in (2.0, 10.0)),
    whole("laser-range-5-mm", HEIGHT, "limited to 5 mm on either side", f.clip_about_median(0.005)),
    whole("laser-range-2-mm", HEIGHT, "limited to 2 mm on either side", f.clip_about_median(0.002)),
    part("laser-out-of-range", HEIGHT, "at 0.5 m for 0.2 s", f.constant(0.5), 0.2),
    whole("laser-quantised-1-mm", HEIGHT, "steps of 1 mm", f.quantise(0.001)),
    whole("laser-quantised-10-mm", HEIGHT, "steps of 10 mm", f.quantise(0.01)),
)  # fmt: skip
DROP_OUTS = (
    part("laser-drop-out-0.1-s", HEIGHT, "no samples for 0.1 s", f.lose, 0.1),
    part("laser-drop-out-2-s", HEIGHT, "no samples for 2 s", f.lose, 2.0),
    whole("laser-drop-outs-3-ms", HEIGHT, "no samples for 3 ms twice a second",
          f.lose_often(0.003, 0.5)),
    whole("laser-drop-outs-random", HEIGHT, "every 20th sample lost at random",
          f.lose_randomly(0.05)),
    whole("laser-mostly-lost", HEIGHT, "60 % of the samples lost", f.lose_randomly(0.6)),
    part("laser-drop-out-as-0", HEIGHT, "0 for 0.05 s", f.constant(0.0), 0.05),
    whole("laser-drop-outs-as-0", HEIGHT, "0 for 2 ms twice a second",
          f.lose_often(0.002, 0.5, 0.0)),
    whole("laser-drop-outs-held", HEIGHT, "held for 20 ms five times a second",
          f.lose_often(0.02, 0.2, None)),
)  # fmt: skip
SIDES = (
    ListedFault("sides-lasers-swapped", "left and right lasers exchanged", True,
                exchange(("left.height", "right.height"))),
    ListedFault("sides-accelerometers-swapped", "left and right accelerometers exchanged", True,
                exchange((f"left.{FORCE}", f"right.{FORCE}"))),
    ListedFault("sides-one-laser-twice", "the right laser recorded on both sides", True,
                copy("left.height", "right.height")),
    ListedFault("sides-one-accelerometer-twice", "the right accelerometer recorded on both sides",
                True, copy(f"left.{FORCE}", f"right.{FORCE}")),
)  # fmt: skip
LASER_FAULTS = (
    *SIGNS_AND_UNITS, *CLOCKS, *SAMPLES, *BANDS_AND_RANGES, *DROP_OUTS, *SIDES,
)  # fmt: skip
