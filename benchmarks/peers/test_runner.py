"""Tests of the runner that need none of the programs: `python -m unittest`."""

import shlex
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import quasirigid
from problem import CASES, START_SPIN, momentum_drift, reference_spin, spin_error
from records import Failed, Failure, Record, Run, call
from settings import SETTINGS
from tables import cheapest, run_table, target_table

STAND_IN = """
import argparse, json
parser = argparse.ArgumentParser()
parser.add_argument("--case")
parser.add_argument("--tolerance", type=float)
asked = parser.parse_args()
print("a line that is no result")
for method, factor in ("full", 1.0), ("reduced", 10.0):
    omega = [{w0!r} + 0.5 * factor * asked.tolerance, {w1!r}, {w2!r}]
    print(json.dumps(dict(
        case=asked.case, tolerance=asked.tolerance, omega=omega, momentum_drift=0.0,
        seconds=2e-3 / factor, steps=7, method=method,
    )))
"""


def run(program: str, seconds: float, error: float) -> Run:
    """A run with these numbers."""
    return Run("A", program, f"{seconds} s", seconds, None, error, 0.0, None)


class Problem(unittest.TestCase):
    """The problem agrees with its published tables."""

    def test_every_case_has_a_reference_and_settings(self) -> None:
        for case in CASES:
            self.assertEqual(spin_error(case, reference_spin(case)), 0.0)
            for program, settings in SETTINGS.items():
                self.assertTrue(settings[case], f"{program}, {case}")

    def test_momentum_at_the_start_is_that_of_the_tables(self) -> None:
        rest = np.zeros(3)
        self.assertEqual(momentum_drift(START_SPIN, rest, rest), 0.0)
        drift = momentum_drift(1.001 * START_SPIN, rest, rest)
        self.assertAlmostEqual(drift, 1e-3, delta=1e-12)


class Quasirigid(unittest.TestCase):
    """The caller of quasirigid, against a stand-in."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        w0, w1, w2 = map(float, reference_spin("B"))
        script = Path(folder.name) / "stand in.py"
        script.write_text(STAND_IN.format(w0=w0, w1=w1, w2=w2))
        self.program = shlex.join([sys.executable, str(script)])

    def test_every_method_and_tolerance_gives_a_run(self) -> None:
        records = list(quasirigid.runs(self.program, "B", 60))
        self.assertEqual(len(records), 2 * len(quasirigid.TOLERANCES))
        best = cheapest(records, quasirigid.TITLE, 1e-9)
        assert best is not None
        self.assertEqual(best.setting, "reduced, tolerance 1e-10")
        self.assertEqual(best.seconds, 2e-4)
        self.assertAlmostEqual(best.error, 5e-10, delta=1e-15)

    def test_a_program_that_is_not_there_is_a_failure(self) -> None:
        records = list(quasirigid.runs("./no-such-program", "B", 60))
        self.assertTrue(all(isinstance(record, Failure) for record in records))


class Processes(unittest.TestCase):
    """Processes that end badly."""

    def test_a_crash_tells_its_last_words(self) -> None:
        with self.assertRaisesRegex(Failed, "exit status 3: gone"):
            call(
                [
                    sys.executable,
                    "-c",
                    "import sys; print('gone', file=sys.stderr); sys.exit(3)",
                ],
                60,
            )

    def test_a_long_run_is_stopped(self) -> None:
        with self.assertRaisesRegex(Failed, "> 1 s") as caught:
            call([sys.executable, "-c", "while True: pass"], 1)
        self.assertTrue(caught.exception.stopped)


class Tables(unittest.TestCase):
    """What the tables say."""

    records: list[Record] = [
        run(quasirigid.TITLE, 0.01, 5e-10),
        run(quasirigid.TITLE, 0.002, 5e-7),
        run("other", 0.5, 2e-10),
        run("other", 0.1, 8e-7),
        run("other", 0.05, 3e-6),
        Failure("A", "slow", "small step", "> 120 s", stopped=True),
        run("slow", 30.0, 1e-5),
        run("coarse", 30.0, 1e-5),
    ]

    def test_the_cheapest_run_that_is_good_enough_counts(self) -> None:
        rows = target_table(self.records).splitlines()
        cells = [[cell.strip() for cell in row.split("|")[1:-1]] for row in rows[2:]]
        self.assertEqual(
            cells[1], ["other", "0.1", "0.1 s", "50", "0.5", "0.5 s", "50"]
        )
        self.assertEqual([row[1] for row in cells[2:]], ["> 120 s", "not reached"])

    def test_every_run_has_its_line(self) -> None:
        lines = run_table(self.records).splitlines()
        self.assertEqual(len(lines), 2 + len(self.records))
        self.assertIn("| > 120 s", lines[7])


if __name__ == "__main__":
    unittest.main()
