"""Faults of the sensors of the vehicle's response, on the wheel and above it."""

from floatref_conformance.faults import sample_faults as f
from floatref_conformance.faults.listed import ListedFault, clocked, part, whole
from floatref_conformance.faults.of_accelerometers import G
from floatref_conformance.faults.placing import clock_fast, exchange, late

WHEEL, BODY = "unsprung_specific_force", "sprung_specific_force"
TRAVEL = "suspension_deflection"

RESPONSE_FAULTS = (
    whole("response-wheel-sign", WHEEL, "sign inverted", f.scale(-1.0)),
    whole("response-wheel-sign-about-rest", WHEEL, "sign inverted, levelled to 1 g at rest",
          f.scale_about(-1.0, G)),
    whole("response-body-sign-about-rest", BODY, "sign inverted, levelled to 1 g at rest",
          f.scale_about(-1.0, G)),
    whole("response-travel-sign", TRAVEL, "sign inverted", f.scale(-1.0)),
    whole("response-travel-in-mm", TRAVEL, "in mm", f.scale(1000.0)),
    whole("response-wheel-in-g", WHEEL, "in g", f.scale(1 / G)),
    *(whole(f"response-wheel-scale-{k:g}", WHEEL, f"scale {k:g} about rest", f.scale_about(k, G))
      for k in (0.5, 2.0)),
    *(whole(f"response-body-scale-{k:g}", BODY, f"scale {k:g} about rest", f.scale_about(k, G))
      for k in (0.5, 2.0)),
    *(whole(f"response-travel-scale-{k:g}", TRAVEL, f"scale {k:g}", f.scale(k))
      for k in (0.5, 2.0)),
    clocked("response-wheel-late-50-ms", WHEEL, "50 ms late", late(0.05)),
    clocked("response-body-late-50-ms", BODY, "50 ms late", late(0.05)),
    clocked("response-travel-late-50-ms", TRAVEL, "50 ms late", late(0.05)),
    clocked("response-wheel-clock-1-percent-fast", WHEEL, "clock 1 % fast", clock_fast(0.01)),
    whole("response-wheel-noise-only", WHEEL, "noise of 3 m/s²", f.be_noise(3.0)),
    whole("response-body-noise-only", BODY, "noise of 0.3 m/s²", f.be_noise(0.3)),
    part("response-wheel-spikes-50-g", WHEEL, "10 samples 50 g off", f.spikes(50 * G, 10), 3.0),
    part("response-wheel-stuck-1-s", WHEEL, "stuck for 1 s", f.hold, 1.0),
    part("response-body-stuck-1-s", BODY, "stuck for 1 s", f.hold, 1.0),
    part("response-travel-stuck-1-s", TRAVEL, "stuck for 1 s", f.hold, 1.0),
    whole("response-travel-stuck", TRAVEL, "stuck all the time", f.hold),
    whole("response-wheel-range-1.3-g", WHEEL, "saturated 0.3 g from rest", f.clip_force(0.3)),
    part("response-wheel-ramp", WHEEL, "ramp to 5 m/s² within 3 s", f.ramp(5.0), 3.0),
    part("response-travel-ramp", TRAVEL, "ramp to 0.1 m within 3 s", f.ramp(0.1), 3.0),
    part("response-wheel-drop-out", WHEEL, "no samples for 1 s", f.lose, 1.0),
    part("response-travel-drop-out", TRAVEL, "no samples for 1 s", f.lose, 1.0),
    ListedFault("response-wheels-swapped", "left and right wheel carriers exchanged", True,
                exchange((f"left.{WHEEL}", f"right.{WHEEL}"))),
    ListedFault("response-wheel-and-body-exchanged", "wheel carrier and body exchanged, left",
                True, exchange((f"left.{WHEEL}", f"left.{BODY}"))),
)  # fmt: skip
