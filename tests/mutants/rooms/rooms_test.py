#!/usr/bin/env python3
"""The machinery of rooms.py on a small tree: what it changes, what its tests notice, and what the table must say.

    python3 tests/mutants/rooms/rooms_test.py"""

import contextlib
import io
import os
import shutil
import sys
import tempfile
import unittest
from unittest import mock

here = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, here)
import candidates  # noqa: E402
import rooms  # noqa: E402


def found_in(text):
    return [(c.was, c.becomes) for c in candidates.of_source('cpp/contct/shelf/a.cpp', text)]


def rewritten(text, **wanted):
    """The source with the one mutant that has these properties."""
    chosen = [c for c in candidates.of_source('a.cpp', text) if all(getattr(c, k) == v for k, v in wanted.items())]
    assert len(chosen) == 1, chosen
    return candidates.rewrite(text, [(7, chosen[0])]).split('#line 1\n')[1]


class Candidates(unittest.TestCase):
    def test_an_operand_ends_where_an_operator_binds_less(self):
        self.assertEqual(rewritten('void f() { x = a - b * c + d; }', was='*'),
                         'void f() { x = a - (contct_mutant_is(7) ? (b) / (c) : b * c) + d; }')
        self.assertEqual(rewritten('bool f() { if (a < b && g(c, d)) h(); }', was='&&'),
                         'bool f() { if ((contct_mutant_is(7) ? (a < b) || (g(c, d)) : a < b && g(c, d))) h(); }')

    def test_a_template_argument_and_a_pointer_are_no_operands(self):
        self.assertEqual(found_in('void f(std::vector<int>& x, const double* y) { std::array<int, 2> z; }'), [])

    def test_nothing_in_a_constant_a_comment_or_a_text_is_changed(self):
        self.assertEqual(found_in('constexpr int a = 1 + 2;\nint b;  // 1 + 2\nconst char* c = "1 + 2";\n#if 1 + 2\n#endif\n'), [])

    def test_a_call_an_assignment_and_a_sign_are_taken_out(self):
        self.assertEqual(rewritten('void f() { g(x); }', was='the call'), 'void f() { { if (!contct_mutant_is(7)) g(x); } }')
        self.assertEqual(rewritten('void f() { a[k] = b; }', was='the assignment'), 'void f() { { if (!contct_mutant_is(7)) a[k] = b; } }')
        self.assertEqual(rewritten('double f() { return -x; }', was='sign -'), 'double f() { return (contct_mutant_is(7) ? (x) : -x); }')

    def test_an_else_stays_with_its_if(self):
        self.assertEqual(rewritten('void f() { if (a) g(); else throw 1; }', was='the call'),
                         'void f() { if (a) { if (!contct_mutant_is(7)) g(); } else throw 1; }')

    def test_what_a_lambda_returns_is_not_what_its_function_returns(self):
        text = 'bool f() { const auto g = [](int i) { return i; }; return g(k); }'
        self.assertEqual(rewritten(text, was='return'), text.replace('g(k)', '(contct_mutant_is(7) ? !(g(k)) : static_cast<bool>(g(k)))'))

    def test_mutants_within_mutants_keep_the_lines(self):
        text = 'bool f() {\n  return a && // first\n         !b;\n}\nint g() { return 1; }\n'
        chosen = list(enumerate((c for c in candidates.of_source('a.cpp', text)), 1))
        made = candidates.rewrite(text, chosen).split('#line 1\n')[1]
        self.assertEqual(made.count('\n'), text.count('\n'))
        for number, _ in chosen:
            self.assertIn(f'contct_mutant_is({number})', made)

    def test_the_draw_of_a_line_does_not_depend_on_other_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(here, 'fixture'), folder, dirs_exist_ok=True)
            settings = rooms.Settings(os.path.join(folder, 'settings.toml'))
            before = [c.key() for c in rooms.draw_of(settings, 3)]
            with open(os.path.join(folder, 'cpp/contct/shelf/shelf.cpp'), 'a', encoding='utf-8') as source:
                source.write('int more(int a) { return a + 3; }\n')
            after = [c.key() for c in rooms.draw_of(settings, 3)]
            self.assertEqual(len(after), len(before) + 1)
            self.assertEqual([k for k in after if k in before], before)
            self.assertNotEqual([c.key() for c in rooms.draw_of(settings, 4)], after)


class Run(unittest.TestCase):
    """A copy of the fixture, built once."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.tree = os.path.join(cls.folder, 'fixture')
        shutil.copytree(os.path.join(here, 'fixture'), cls.tree)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_with(self, change=lambda table: table):
        """Exit status and output of a run with the table of survivors changed."""
        table = os.path.join(self.tree, 'survivors.toml')
        with open(os.path.join(here, 'fixture/survivors.toml'), encoding='utf-8') as file:
            changed = change(file.read())
        with open(table, 'w', encoding='utf-8') as file:
            file.write(changed)
        arguments = ['rooms.py', os.path.join(self.folder, 'work'), '--settings', os.path.join(self.tree, 'settings.toml'), '--draw', '100']
        out = io.StringIO()
        with mock.patch.object(sys, 'argv', arguments), contextlib.redirect_stdout(out):
            try:
                return rooms.main(), out.getvalue()
            except rooms.Failure as failure:
                return 2, str(failure)

    def test_every_mutant_is_noticed_or_has_a_reason(self):
        status, out = self.run_with()
        self.assertEqual(status, 0, out)
        self.assertRegex(out, r'shelf +29 +21 +8 +0 +100\.0\n')
        self.assertIn('1 that do not compile were replaced', out)
        with open(os.path.join(self.folder, 'work/log'), encoding='utf-8') as log:
            endless = [line for line in log if "/ -> *" in line and ':32' in line]
        self.assertEqual(len(endless), 1)
        self.assertIn("'how': 'time'", endless[0])

    def test_a_survivor_without_a_reason_fails_the_run(self):
        status, out = self.run_with(lambda table: table.split('[[survivor]]', 2)[2].join(['[[survivor]]', '']))
        self.assertEqual(status, 1, out)
        self.assertIn('survives', out)

    def test_a_reason_for_a_mutant_that_is_noticed_fails_the_run(self):
        status, out = self.run_with(lambda table: table + '''
[[survivor]]
file = 'cpp/contct/shelf/shelf.cpp'
line = 'int sum = 0;'
was = '0'
becomes = '1'
reason = 'The sum begins anywhere.'
''')
        self.assertEqual(status, 1, out)
        self.assertIn('the table says that nothing can notice it', out)

    def test_a_line_that_is_gone_and_an_empty_reason_are_refused(self):
        status, out = self.run_with(lambda table: table.replace("line = '++calls;'", "line = '++Calls;'"))
        self.assertEqual(status, 2, out)
        self.assertIn('found no such mutant', out)
        status, out = self.run_with(lambda table: table.replace('Nothing reads it.', ' '))
        self.assertEqual(status, 2, out)
        self.assertIn('found no reason', out)


if __name__ == '__main__':
    unittest.main()
