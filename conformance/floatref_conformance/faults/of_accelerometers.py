"""Faults of the vertical accelerometer, whose profile sensor nobody sees while it works."""

from math import radians

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.faults import sample_faults as f
from floatref_conformance.faults.listed import ListedFault, clocked, part, whole
from floatref_conformance.faults.placing import clock_fast, late, mix, state_rate

FORCE = "vertical_specific_force"
G = STANDARD_GRAVITY
FOOT_M, INCH_M = 0.3048, 0.0254
SCALES = (0.5, 0.7, 0.9, 1.1, 1.4, 2.0)
LAGS_S = (0.002, 0.005, 0.02, 0.05, 0.2)

SIGNS_AND_UNITS = (
    whole("accelerometer-sign", FORCE, "sign inverted", f.scale(-1.0)),
    whole("accelerometer-sign-about-rest", FORCE, "sign inverted, then levelled to 1 g at rest",
          f.scale_about(-1.0, G)),
    whole("accelerometer-in-g", FORCE, "in g", f.scale(1 / G)),
    whole("accelerometer-in-ft", FORCE, "in ft/s²", f.scale(1 / FOOT_M)),
    whole("accelerometer-in-inches", FORCE, "in in/s²", f.scale(1 / INCH_M)),
    whole("accelerometer-in-mm", FORCE, "in mm/s²", f.scale(1000.0)),
    whole("accelerometer-in-cm", FORCE, "in cm/s²", f.scale(100.0)),
    whole("accelerometer-without-1-g", FORCE, "1 g removed", f.add(-G)),
    whole("accelerometer-in-g-levelled", FORCE, "changes in g, levelled to 1 g at rest in m/s²",
          f.scale_about(1 / G, G)),
    *(whole(f"accelerometer-scale-{k:g}", FORCE, f"scale {k:g} about rest", f.scale_about(k, G))
      for k in SCALES),
    whole("accelerometer-scale-0.9-with-1-g", FORCE, "scale 0.9, 1 g included", f.scale(0.9)),
    whole("accelerometer-scale-1.1-with-1-g", FORCE, "scale 1.1, 1 g included", f.scale(1.1)),
    part("accelerometer-scale-halved-midway", FORCE, "scale 0.5 from one place on",
         f.scale_about(0.5, G), None),
)  # fmt: skip
CLOCKS = (
    *(clocked(f"accelerometer-late-{1000 * s:g}-ms", FORCE, f"{1000 * s:g} ms late", late(s))
      for s in LAGS_S),
    clocked("accelerometer-early-20-ms", FORCE, "20 ms early", late(-0.02)),
    clocked("accelerometer-clock-1-percent-fast", FORCE, "clock 1 % fast", clock_fast(0.01)),
    clocked("accelerometer-clock-0.1-percent-fast", FORCE, "clock 0.1 % fast", clock_fast(0.001)),
    clocked("accelerometer-clock-jump-50-ms", FORCE, "50 ms late from one place on",
            late(0.05, 250.0), run=False),
    clocked("accelerometer-rate-doubled", FORCE, "stated rate twice the true one",
            state_rate(2.0)),
    clocked("accelerometer-rate-1-percent-high", FORCE, "stated rate 1 % high", state_rate(1.01)),
)  # fmt: skip
SAMPLES = (
    part("accelerometer-spike-50-g", FORCE, "one sample 50 g off", f.spikes(50 * G, 1), 2.0),
    part("accelerometer-spikes-50-g", FORCE, "10 samples 50 g off", f.spikes(50 * G, 10), 3.0),
    part("accelerometer-spikes-5-g", FORCE, "10 samples 5 g off", f.spikes(5 * G, 10), 3.0),
    part("accelerometer-spikes-1-g", FORCE, "100 samples 1 g off", f.spikes(G, 100), 3.0),
    whole("accelerometer-noise-only", FORCE, "noise of 0.3 m/s² about 1 g", f.be_noise(0.3)),
    part("accelerometer-noise-only-1-s", FORCE, "noise of 0.3 m/s² for 1 s", f.be_noise(0.3), 1.0),
    whole("accelerometer-noise-added", FORCE, "noise of 1 m/s² added", f.add_noise(1.0)),
    whole("accelerometer-hum", FORCE, "sine of 0.5 m/s² and 1 Hz added", f.add_hum(0.5, 1.0)),
    part("accelerometer-ramp", FORCE, "ramp to 2 m/s² within 3 s", f.ramp(2.0), 3.0),
    whole("accelerometer-drift", FORCE, "ramp to 1 m/s² over the run", f.ramp(1.0)),
    part("accelerometer-bias-step", FORCE, "0.5 m/s² added from one place on", f.add(0.5), None),
    whole("accelerometer-stuck", FORCE, "stuck all the time", f.hold),
    part("accelerometer-stuck-1-s", FORCE, "stuck within its range for 1 s", f.hold, 1.0),
    part("accelerometer-stuck-to-the-end", FORCE, "stuck from one place on", f.hold, None),
    part("accelerometer-stuck-with-dither", FORCE, "stuck for 2 s but for the converter's noise",
         f.hold_with_dither(0.001), 2.0),
    whole("accelerometer-stuck-all-with-dither", FORCE, "stuck but for the converter's noise",
          f.hold_with_dither(0.001)),
)  # fmt: skip
BANDS_AND_RANGES = (
    *(whole(f"accelerometer-ac-coupled-{hz:g}-hz", FORCE, f"high-passed at {hz:g} Hz, 1 g added",
            f.couple(hz, G)) for hz in (0.1, 0.5, 2.0)),
    *(whole(f"accelerometer-low-passed-{hz:g}-hz", FORCE, f"low-passed at {hz:g} Hz",
            f.smooth(hz)) for hz in (2.0, 10.0)),
    whole("accelerometer-range-2-g", FORCE, "saturated 1 g from rest", f.clip_force(1.0)),
    whole("accelerometer-range-1.1-g", FORCE, "saturated 0.1 g from rest", f.clip_force(0.1)),
    whole("accelerometer-range-1.03-g", FORCE, "saturated 0.03 g from rest", f.clip_force(0.03)),
    part("accelerometer-full-scale-0.2-s", FORCE, "at 4 g for 0.2 s", f.constant(4 * G), 0.2),
    whole("accelerometer-quantised-0.01-g", FORCE, "steps of 0.01 g", f.quantise(0.01 * G)),
    whole("accelerometer-quantised-0.2-g", FORCE, "steps of 0.2 g", f.quantise(0.2 * G)),
    ListedFault("accelerometer-other-axis", "turned by 20 degrees towards longitudinal", True,
                mix(FORCE, "longitudinal_specific_force", radians(20.0))),
)  # fmt: skip
DROP_OUTS = (
    part("accelerometer-drop-out-0.1-s", FORCE, "no samples for 0.1 s", f.lose, 0.1),
    part("accelerometer-drop-out-2-s", FORCE, "no samples for 2 s", f.lose, 2.0),
    whole("accelerometer-drop-outs-3-ms", FORCE, "no samples for 3 ms twice a second",
          f.lose_often(0.003, 0.5)),
    whole("accelerometer-drop-outs-random", FORCE, "every 20th sample lost at random",
          f.lose_randomly(0.05)),
    whole("accelerometer-mostly-lost", FORCE, "60 % of the samples lost", f.lose_randomly(0.6)),
    part("accelerometer-drop-out-as-0", FORCE, "0 for 0.05 s", f.constant(0.0), 0.05),
    part("accelerometer-drop-out-held", FORCE, "the last sample repeated for 0.1 s", f.hold, 0.1),
)  # fmt: skip
ACCELEROMETER_FAULTS = (
    *SIGNS_AND_UNITS, *CLOCKS, *SAMPLES, *BANDS_AND_RANGES, *DROP_OUTS,
)  # fmt: skip
