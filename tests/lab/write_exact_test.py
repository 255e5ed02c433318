"""python3 tests/lab/write_exact_test.py CONTCT REFERENCE"""
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
from exact_structures import Beam, Plate, root_of_square, zeros_inside
from write_exact import printing, with_exact, words, zero_right_of

HERE = Path(__file__).parent


class Words(unittest.TestCase):
    def test_a_fraction_is_written_as_one_up_to_40_digits_and_then_as_a_decimal(self):
        self.assertEqual(words(Fraction(-208, 58875)), "-208/58875")
        self.assertEqual(words(Fraction(0)), "0")
        self.assertEqual(words(Fraction(10**19 + 1, 10**19)), f"{10**19 + 1}/{10**19}")
        self.assertEqual(words(Fraction(10**20 + 1, 10**19)), "10." + "0" * 18 + "1" + "0" * 19)

    def test_the_last_of_40_digits_is_rounded(self):
        two_thirds = Fraction(2 * 10**50 + 1, 3 * 10**50)
        self.assertEqual(words(two_thirds), "0." + "6" * 39 + "7")
        self.assertEqual(words(-two_thirds / 10**6), "-6." + "6" * 38 + "7e-7")
        self.assertEqual(words(1 - Fraction(1, 10**45)), "1." + "0" * 39)
        self.assertEqual(words(Fraction(12) + Fraction(1, 3 * 10**50)), "12." + "0" * 38)


    def test_a_printed_number_is_the_exact_one_rounded_cut_or_neither(self):
        for text, exact, found in (("0.667", "2/3", "rounded"), ("0.666", "2/3", "cut"), ("0.665", "2/3", "neither"),
                                   ("0.668", "2/3", "neither"), ("-0.666", "-2/3", "cut"), ("0.667", "-2/3", "neither"),
                                   ("6.67e-1", "2/3", "rounded"), ("1e1", "17", "cut"), ("0.12", "1/8", "rounded"),
                                   ("0.13", "1/8", "rounded"), ("0.5", "0.504", "rounded"), ("0.500", "0.504", "neither"),
                                   ("0.0", "0", "rounded"), ("0.0", "1/1000", "neither"), ("0.1", "0", "neither")):
            self.assertEqual(printing(text, Fraction(exact)), found, (text, exact))


class Structures(unittest.TestCase):
    def test_zeros_are_found_where_a_polynomial_changes_its_sign(self):
        self.assertEqual(zeros_inside([Fraction(-1), Fraction(2)], Fraction(1)), [Fraction(1, 2)])
        (root,) = zeros_inside([Fraction(-2), Fraction(0), Fraction(1)], Fraction(2))
        self.assertLess(abs(root - root_of_square(Fraction(2))), Fraction(1, 10**60))
        self.assertEqual(zeros_inside([Fraction(1), Fraction(-2), Fraction(1)], Fraction(2)), [])

    def test_a_simply_supported_beam_has_its_largest_deflection_and_moment_in_the_middle_of_its_element(self):
        beam = Beam({"beam": {"length": 1, "elements": 1, "EI": 1}, "step": [{"uniform": -384}]})
        u = [Fraction(v) for v in (0, -16, 0, 16)]
        self.assertEqual(beam.extreme(u, 0, "w", False)[0], -5)
        self.assertEqual(beam.extreme(u, 0, "moment", True), (48, [Fraction(1, 2)]))
        self.assertEqual(beam.place(u, 0, "shear", 1, "left"), 192)

    def test_two_equal_extremes_are_both_found(self):
        beam = Beam({"beam": {"length": 2, "elements": 2, "EI": 1}, "step": [{"uniform": -384}]})
        _, places = beam.extreme([Fraction(v) for v in (0, -16, 0, 0, 0, 16)], 0, "w", False)
        self.assertEqual(len(places), 2)
        self.assertEqual(sum(places), 2)

    def test_a_plate_that_is_a_quadratic_has_the_moments_of_its_curvatures(self):
        plate = Plate({"plate": {"size": [2, 3], "elements": [2, 2], "D": 10, "nu": Fraction(1, 4)}})
        u = []
        for y in plate.y:
            for x in plate.x:
                u += [x * x + 3 * y * y + 5 * x * y, 2 * x + 5 * y, 6 * y + 5 * x]
        self.assertEqual(plate.moments(u, 3, 2), {"mx": 35, "my": 65, "mxy": Fraction(75, 2)})

    def test_a_change_of_sign_is_measured_from_its_start(self):
        way = [(Fraction(i), i) for i in range(4)]
        w = [Fraction(v) for v in (-1, 1, 1, -3)]
        self.assertEqual(zero_right_of(way, w, Fraction(0)), Fraction(1, 2))
        self.assertEqual(zero_right_of(way, w, Fraction(1)), Fraction(5, 4))
        with self.assertRaises(ValueError):
            zero_right_of(way[:2], [Fraction(1)] * 2, Fraction(0))


class Table(unittest.TestCase):
    """A table of the first problems alone, in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.table = Path(self.folder.name) / "verification.toml"
        (self.table.parent / "problems").symlink_to(REFERENCE / "problems")
        cases = (REFERENCE / "verification.toml").read_text().split("[[case]]")
        self.text = "[[case]]".join(cases[:3])

    def run_command(self, *arguments):
        return subprocess.run([sys.executable, HERE / "write_exact.py", PROGRAM, self.table.parent, *arguments],
                              capture_output=True, text=True)

    def test_numbers_that_are_missing_are_written_as_they_stand_in_reference(self):
        bare = "\n".join(line for line in self.text.split("\n") if not line.startswith("exact "))
        self.assertNotEqual(bare, self.text)
        self.table.write_text(bare)
        self.assertEqual(self.run_command().returncode, 0)
        self.assertEqual(self.table.read_text().strip(), self.text.strip())

    def test_a_digit_that_is_changed_is_noticed(self):
        for right, wrong in (('"-26/5375"', '"-27/5375"'), ('"1/10"', '"0.1"')):
            self.assertIn(right, self.text)
            self.table.write_text(self.text.replace(right, wrong, 1))
            found = self.run_command("--check")
            self.assertEqual(found.returncode, 1)
            self.assertIn(f"exact: found {wrong}, allowed: {right}".replace('"', ""), found.stdout)
            self.assertIn("1 of them not in the table", found.stdout)

    def test_a_printed_number_is_rounded_or_cut_as_the_table_says(self):
        for right, wrong in (('printed   = "-0.00266667"', 'cut       = "-0.00266667"'),
                             ("value     = -0.00266666667", "value     = -0.00266666666")):
            self.assertIn(right, self.text)
            self.table.write_text(self.text.replace(right, wrong, 1))
            found = self.run_command("--check")
            self.assertEqual(found.returncode, 1)
            self.assertIn(": exactly -1/375", found.stdout)
            self.assertIn("0 of them not in the table, 1 misprinted", found.stdout)

    def test_too_few_numbers_are_not_enough(self):
        self.table.write_text(self.text)
        self.assertEqual(self.run_command("--check", "--least", "30").returncode, 0)
        self.assertEqual(self.run_command("--check", "--least", "600").returncode, 1)

    def test_a_table_is_written_whole(self):
        self.table.write_text(self.text)
        self.assertEqual(self.run_command("--most-nodes", "101").returncode, 2)


if __name__ == "__main__":
    PROGRAM, REFERENCE = sys.argv[1], Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1])
