"""Take the pictures of docs/batch.md: a batch of a hundred recordings, and its summary drawn.

    python .ci/batch_pictures.py

Pictures go to docs/images: batch-terminal.png is what a terminal shows when nearly half of the
files are done, and at the end; batch-network.png is what `--plot` draws.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from terminal import as_html, command_line, frames, picture, run_in_terminal, without_frames

ROOT = Path(__file__).parents[1]
IMAGES = ROOT / "docs" / "images"
CORPUS = ROOT / "tests" / "benchmarks" / "batch_corpus.py"
FILES, CORRUPT, COLUMNS = 100, 6, 116
SHOWN_AS = "/srv/survey"
"""The folder that the picture shows in place of a temporary one."""
COMMAND = "floatref batch short/manifest.csv --out network-short --segment 50 --jobs 2"
NETWORK = "floatref batch short/manifest.csv --out drawn --segment 50 --pipeline temporal-basic"


def shown(folder: Path) -> str:
    """Return the HTML of the batch's terminal, in progress and at its end."""
    text = run_in_terminal(COMMAND, folder, COLUMNS).replace(str(folder), SHOWN_AS)
    holding = f"of {FILES} files"
    progress = frames(text, holding)
    middle = next(line for line in progress if _done(line, holding) >= 0.43 * FILES)
    end = without_frames(text, holding)
    return f"{command_line(COMMAND)}{as_html(middle)}<hr>{as_html(end)}"


def _done(line: str, holding: str) -> int:
    return int(line[: line.index(holding)].split()[-1].rpartition("m")[2])


def main() -> None:
    """Write the recordings, run both commands and take the pictures."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        numbers = ["--files", str(FILES), "--corrupt", str(CORRUPT)]
        subprocess.run([sys.executable, CORPUS, folder / "short", *numbers], check=True)
        picture(shown(folder), COLUMNS, IMAGES / "batch-terminal.png")
        run_in_terminal(f"{NETWORK} --plot {IMAGES}/batch-network.png", folder, COLUMNS)


if __name__ == "__main__":
    main()
