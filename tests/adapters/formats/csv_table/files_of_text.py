"""What the adapter finds in a file of text."""

from pathlib import Path

from floatref import NativeFile
from floatref_adapters.formats.csv_table.adapter import CsvTable
from floatref_adapters.testing.whole_reading import open_content


def read(folder: Path, text: str | bytes, **options: str) -> NativeFile:
    return open_content(CsvTable(), folder / "run.csv", text, **options)
