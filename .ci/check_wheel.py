"""Check that the wheel in a folder holds every file of the packages that is under version control.

python .ci/check_wheel.py FOLDER
"""

import subprocess
import sys
import zipfile
from pathlib import Path

ROOMS = ("sdk", "adapters", "reference_impl", "conformance")


def main(folder: Path) -> int:
    """Return 1 if a file of the packages is missing from the wheel in ``folder``, else 0."""
    (wheel,) = folder.glob("floatref-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        inside = set(archive.namelist())
    listed = subprocess.run(
        ["git", "ls-files", *ROOMS], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    expected = {name.partition("/")[2] for name in listed}
    for name in sorted(expected - inside):
        print(f"{wheel.name}: {name} is missing")
    strangers = {name.split("/")[0] for name in inside} - {name.split("/")[0] for name in expected}
    for name in sorted(name for name in strangers if not name.endswith(".dist-info")):
        print(f"{wheel.name}: {name} does not belong there")
        expected.add(name)
    print(f"{wheel.name}: {len(inside)} files")
    return 0 if expected <= inside else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
