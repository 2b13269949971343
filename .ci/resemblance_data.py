"""Write vectors.json, what every mutant and some good devices do to the probes.

    python .ci/resemblance_data.py

It takes minutes. Run it after a change of a mutant, a probe or a feature.
"""

import sys
import time
from pathlib import Path

from floatref_conformance.resemblance.catalogue import FILE, write_vectors
from floatref_conformance.resemblance.making import measure_vectors

ROOM = Path(__file__).parents[1] / "conformance" / "floatref_conformance" / "resemblance"


def main() -> None:
    """Measure all vectors and write the file."""
    begin_s = time.monotonic()

    def show(name: str) -> None:
        print(f"{time.monotonic() - begin_s:6.1f} s  {name}", file=sys.stderr, flush=True)

    text = write_vectors(measure_vectors(show))
    (ROOM / FILE).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
