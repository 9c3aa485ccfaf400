"""Models: runs the commands of a page in results/models, those of its ```sh blocks, from the repository's root.

    python3 results/models.py NAME...     lgp on the PATH; all pages unless named; minutes each
"""

import re
import subprocess
import sys
import time

from tables import RESULTS

PAGES = RESULTS / "models"


def commands(page):
    """The text of its blocks of commands."""
    return "\n".join(re.findall(r"^```sh\n(.*?)^```", page.read_text(), re.S | re.M))


def main():
    names = sys.argv[1:] or sorted(page.parent.name for page in PAGES.glob("*/README.md"))
    for name in names:
        started = time.monotonic()
        script = commands(PAGES / name / "README.md")
        subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=RESULTS.parent, check=True)
        print(f"{name}: {time.monotonic() - started:.0f} s")


main()
