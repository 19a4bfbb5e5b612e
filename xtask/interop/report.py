"""What the checks share: the list of samples, and a line for each claim."""

import json
import pathlib
import sys


class Checks:
    """Collects claims; `finish` ends the program with 1 if one of them does not hold."""

    def __init__(self):
        self.folder = pathlib.Path(sys.argv[1])
        self.samples = json.loads((self.folder / "samples.json").read_text())
        self.failures = 0
        self.claims = 0

    def of_kind(self, kind):
        """The samples of one kind of file, with their paths."""
        for sample in self.samples:
            if sample["kind"] == kind:
                yield sample, str(self.folder / sample["file"])

    def claim(self, sample, text, holds):
        self.claims += 1
        if not holds:
            self.failures += 1
            print(f"FAILED  {sample['file']}: {text}", flush=True)

    def note(self, sample, text):
        print(f"        {sample['file']}: {text}", flush=True)

    def finish(self, program):
        if self.claims == 0:
            print(f"FAILED  {program}: nothing was checked")
        print(f"{program}: {self.claims} claims, {self.failures} failures", flush=True)
        sys.exit(1 if self.failures or self.claims == 0 else 0)
