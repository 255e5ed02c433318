"""Where a source can be changed by one operator, constant or statement, so that the change is chosen at run time.

A mutant is an expression or a statement of the source with one change. The rewritten source has both, and asks
`contct_mutant_is(number)` which of them to take."""

import re

from cpp_tokens import ASSIGNMENTS, Source

# One change each; where there are two, both are candidates.
BINARY = {'<': ['<=', '>='], '<=': ['<', '>'], '>': ['>=', '<='], '>=': ['>', '<'], '==': ['!='], '!=': ['=='],
          '+': ['-'], '-': ['+'], '*': ['/'], '/': ['*'], '&&': ['||'], '||': ['&&'], '%': ['/']}
CONSTANTS = {'0': '1', '1': '0', '0.0': '1.0', '1.0': '0.0', '2': '1', '2.0': '1.0', '0.5': '1.0', 'true': 'false', 'false': 'true'}
CALLS = {'min': 'max', 'max': 'min'}
ASSIGNING = {'+=': '-=', '-=': '+=', '*=': '/=', '/=': '*='}
# After these a token begins an expression, so that '-' is a sign there.
BEGINS_EXPRESSION = {'(', '[', '{', ',', ';', '?', ':', 'return'} | ASSIGNMENTS


class Candidate:
    """source[begin:end] becomes `mutated` where the mutant is chosen: a list of texts and of pairs (begin, end), which are
    parts of the source that other mutants may have changed."""

    def __init__(self, path, source, begin, end, site, was, becomes, mutated, statement=False):
        self.path, self.begin, self.end, self.site = path, begin, end, site
        self.line = source.line_at(site)
        self.text = source.line_text(self.line)
        column = site - source.starts_of_lines[self.line - 1]
        line_start = source.text.split('\n')[self.line - 1]
        self.nth = line_start[:column].count(was.split('(')[0]) + 1 if was else 1
        self.was, self.becomes = was, becomes
        self.mutated, self.statement = mutated, statement
        self.occurrence = 1  # of this line's text in its file, where others have the same key
        self.last_line = source.line_at(max(begin, end - 1))
        self.first_line = source.line_at(begin)

    def key(self):
        """What names a mutant in the table of survivors: it holds while its line is as it is."""
        return (self.path, self.text, self.was, self.becomes, self.nth, self.occurrence)

    def rewritten(self, number, render):
        kept = render(self.begin, self.end)
        if self.statement:
            return f'{{ if (!contct_mutant_is({number})) {kept} }}'  # in braces: an else may follow
        mutated = ''.join(p if isinstance(p, str) else render(*p) for p in self.mutated)
        # On one line, so that a compiler's messages name the lines of the source.
        return f'(contct_mutant_is({number}) ? {on_one_line(mutated)} : {self.as_it_is(kept)})'

    def as_it_is(self, kept):
        return f'static_cast<bool>({kept})' if self.was == 'return' else kept


def on_one_line(text):
    """The same code without line breaks, and so without comments that end with one."""
    parts = re.split(r'("(?:\\.|[^"\\\n])*"|//[^\n]*)', text)
    return ''.join(' ' if p.startswith('//') else p if p.startswith('"') else p.replace('\n', ' ') for p in parts)


def constant_spans(source):
    """Where nothing is decided at run time: constants, static_assert, template heads, constexpr functions."""
    tokens, spans = source.tokens, []
    for i, t in enumerate(tokens):
        if t.text in ('constexpr', 'consteval', 'static_assert', 'using', 'enum', 'concept', 'requires'):
            j = i + 1
            while j < len(tokens) and tokens[j].text not in (';', '{'):
                if tokens[j].text == '(' and tokens[j].partner is not None:
                    j = tokens[j].partner
                j += 1
            if j < len(tokens) and tokens[j].text == '{' and tokens[j].partner is not None:
                j = tokens[j].partner
                while t.text == 'constexpr' and j + 1 < len(tokens) and tokens[j + 1].text not in (';',) and tokens[j - 1].text == '=':
                    j += 1
            if t.text == 'constexpr' and i > 0 and tokens[i - 1].text == 'if':
                j = tokens[i + 1].partner if tokens[i + 1].partner is not None else i + 1
            spans.append((t.begin, tokens[min(j, len(tokens) - 1)].end))
        if t.text == '<' and not t.binary and t.partner is not None:
            spans.append((t.begin, tokens[t.partner].end))
        if t.text == 'case':
            j = i + 1
            while tokens[j].text != ':':
                j += 1
            spans.append((t.begin, tokens[j].end))
    return spans


def bool_bodies(source):
    """The bodies of functions that return bool."""
    tokens, bodies = source.tokens, []
    for i, t in enumerate(tokens):
        if t.text != 'bool':
            continue
        j = i + 1
        while j < len(tokens) and (tokens[j].kind == 'word' or tokens[j].text == '::'):
            j += 1
        if j >= len(tokens) or tokens[j].text != '(' or tokens[j].partner is None or j == i + 1:
            continue
        j = tokens[j].partner + 1
        while j < len(tokens) and tokens[j].text in ('const', 'noexcept', 'override', 'final'):
            j += 1
        if j < len(tokens) and tokens[j].text == '{' and tokens[j].partner is not None:
            bodies.append((j, tokens[j].partner))
    return bodies


def of_source(path, text):
    source = Source(text)
    tokens = source.tokens
    constant = constant_spans(source)
    found = []

    def add(first, after, site, was, becomes, mutated, statement=False):
        begin, end = tokens[first].begin, tokens[after - 1].end
        if not any(b <= site < e for b, e in constant):
            found.append(Candidate(path, source, begin, end, site, was, becomes, mutated, statement))

    def span(first, after):
        return (tokens[first].begin, tokens[after - 1].end)

    for i, t in enumerate(tokens):
        before = tokens[i - 1] if i else None
        if t.binary and t.text in BINARY:
            left, right = source.left_operand(i), source.right_operand(i)
            if left is None or right is None:
                continue
            if t.text in '+-*/' and (tokens[i - 1].kind == 'string' or tokens[i + 1].kind == 'string'):
                continue
            l, r = span(left, i), span(i + 1, right)
            for other in BINARY[t.text]:
                add(left, right, t.begin, t.text, other, ['(', l, f') {other} (', r, ')'])
        elif t.text in CONSTANTS and not (before and before.text in ('.', '->', 'operator', '#')):
            if before and before.text == '=' and i + 1 < len(tokens) and tokens[i + 1].text == ';' and tokens[i - 2].text == ')':
                continue  # a pure virtual function
            add(i, i + 1, t.begin, t.text, CONSTANTS[t.text], [CONSTANTS[t.text]])
        elif t.text == '!' and i + 1 < len(tokens) and not t.binary:
            after = source.unary_operand(i + 1)
            if after:
                operand = span(i + 1, after)
                add(i, after, t.begin, '!', 'nothing', ['static_cast<bool>(', operand, ')'])
        elif t.text == '-' and not t.binary and before and (before.text in BEGINS_EXPRESSION or before.binary):
            after = source.unary_operand(i + 1)
            if after:
                operand = span(i + 1, after)
                add(i, after, t.begin, 'sign -', 'nothing', ['(', operand, ')'])
        elif t.text in ('++', '--') and before and before.text in (';', '{', '}', ')', '(', 'else', ','):
            after = source.unary_operand(i + 1)
            if after:
                operand = span(i + 1, after)
                other = '--' if t.text == '++' else '++'
                add(i, after, t.begin, t.text, other, [other, operand])
        elif t.text in CALLS and i + 1 < len(tokens) and before and before.text == '::' and tokens[i - 2].text == 'std':
            k = i + 1
            if tokens[k].text == '<' and tokens[k].partner is not None:
                k = tokens[k].partner + 1
            if tokens[k].text != '(' or tokens[k].partner is None:
                continue
            after = tokens[k].partner + 1
            rest = span(i + 1, after)
            add(i - 2, after, tokens[i].begin, t.text, CALLS[t.text], [f'std::{CALLS[t.text]}', rest])

    # Statements that call or assign, and what a function that returns bool returns.
    for i, t in enumerate(tokens):
        before = tokens[i - 1] if i else None
        starts = before is not None and (before.text in (';', '{', '}', 'else') or (before.text == ')' and t.kind == 'word'))
        if not starts or not (t.kind == 'word' or t.text in ('*', '(')) or t.text in (
                'return', 'if', 'for', 'while', 'switch', 'do', 'throw', 'else', 'case', 'break', 'continue', 'default', 'using',
                'const', 'delete', 'static', 'auto', 'public', 'private', 'protected', 'template', 'operator', 'static_assert'):
            continue
        if before.text == ')' and before.partner is not None and tokens[before.partner - 1].text not in ('if', 'for', 'while'):
            continue
        after = source.unary_operand(i)
        if after is None or after >= len(tokens):
            continue
        if tokens[after].text == ';' and tokens[after - 1].text == ')':
            add(i, after + 1, t.begin, 'the call', 'nothing', [], statement=True)
        elif tokens[after].text in ASSIGNMENTS and not (tokens[after].text == '=' and tokens[after + 1].text == '['):
            k = after
            while k < len(tokens) and tokens[k].text != ';':
                k = (tokens[k].partner + 1) if tokens[k].text in '([{' and tokens[k].partner is not None else k + 1
                if k < len(tokens) and tokens[k].text in ')}]':
                    break
            if k < len(tokens) and tokens[k].text == ';':
                add(i, k + 1, t.begin, 'the assignment', 'nothing', [], statement=True)
                if tokens[after].text in ASSIGNING:
                    other = ASSIGNING[tokens[after].text]
                    l, r = span(i, after), span(after + 1, k)
                    add(i, k, tokens[after].begin, tokens[after].text, other, [l, f' {other} (', r, ')'])
    for first, last in bool_bodies(source):
        i = first
        while i + 1 < last:
            i += 1
            if tokens[i].text == '{' and source.of_lambda(i) and tokens[i].partner is not None:
                i = tokens[i].partner  # what a function inside returns is its own
            if tokens[i].text == 'return' and tokens[i + 1].text not in (';', 'true', 'false', '!'):
                k = i + 1
                while tokens[k].text != ';':
                    k = (tokens[k].partner + 1) if tokens[k].text in '([{' and tokens[k].partner is not None else k + 1
                part = span(i + 1, k)
                add(i + 1, k, tokens[i].begin, 'return', 'return !', ['!(', part, ')'])
    seen = {}
    for c in found:
        seen[c.key()] = c.occurrence = seen.get(c.key(), 0) + 1
    return found


def rewrite(text, chosen):
    """The source with all chosen mutants, a list of pairs (number, Candidate) that are nested or apart."""
    ordered = sorted(chosen, key=lambda c: (c[1].begin, -c[1].end, c[1].statement is False, c[0]))

    def render(begin, end, without=()):
        made, at = '', begin
        for number, c in ordered:
            if number in without or c.begin < at or c.begin < begin or c.end > end:
                continue
            made += text[at:c.begin]
            made += c.rewritten(number, lambda b, e: render(b, e, (*without, number)))
            at = c.end
        return made + text[at:end]

    return '#include "contct/mutant_is.hpp"\n#line 1\n' + render(0, len(text))


def crosses(a, b):
    """Whether neither contains the other: such mutants cannot be in one source."""
    return a.begin < b.end and b.begin < a.end and not (
        (a.begin <= b.begin and b.end <= a.end) or (b.begin <= a.begin and a.end <= b.end))
