"""The tokens of a C++ source as clang-format leaves it, and how far the operands of an operator reach.

clang-format puts blanks on both sides of a binary operator and on neither side of a template's brackets: that tells
them apart without a parser."""

import bisect
import re

TOKEN = re.compile(r'''
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<raw>R"(?P<mark>[^(]*)\(.*?\)(?P=mark)")
  | (?P<string>"(?:\\.|[^"\\\n])*")
  | (?P<char>(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+')
  | (?P<number>(?:0[xX][0-9a-fA-F'.]+(?:[pP][+-]?\d+)?|\.?\d[0-9'.]*(?:[eE][+-]?\d+)?)[A-Za-z]*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<operator><=>|->\*|<<=|\.\.\.|->|\+\+|--|<=|==|!=|&&|\|\||\+=|-=|\*=|/=|%=|&=|\|=|\^=|::|<<
                 |>=(?=\s)|>>=(?=\s)|>>(?=\s)|\S)
  | (?P<blank>\s+)
''', re.VERBOSE | re.DOTALL)

PRECEDENCE = {'||': 1, '&&': 2, '|': 3, '^': 4, '&': 5, '==': 6, '!=': 6, '<': 7, '>': 7, '<=': 7, '>=': 7,
              '<=>': 8, '<<': 9, '>>': 9, '+': 10, '-': 10, '*': 11, '/': 11, '%': 11}
ASSIGNMENTS = {'=', '+=', '-=', '*=', '/=', '%=', '&=', '|=', '^=', '<<=', '>>='}
CLOSING = {'(': ')', '[': ']', '{': '}', '<': '>'}
# Words before which an expression ends and after which another begins.
ENDS_BEFORE = {'return', 'case', 'throw', 'else', 'co_return', 'new', 'delete', 'const', 'do', 'goto'}


class Token:
    __slots__ = ('kind', 'text', 'begin', 'end', 'line', 'binary', 'partner', 'after_blank')

    def __init__(self, kind, text, begin, line, after_blank):
        self.kind, self.text, self.begin, self.line = kind, text, begin, line
        self.end = begin + len(text)
        self.after_blank = after_blank
        self.binary = False
        self.partner = None  # the index of the bracket that belongs to it


class Source:
    """A source in tokens, without comments and directives."""

    def __init__(self, text):
        self.text = text
        self.starts_of_lines = [0] + [m.end() for m in re.finditer('\n', text)]
        self.tokens = self._tokens()
        self._mark_binary()
        self._match_brackets()

    def line_at(self, position):
        return bisect.bisect_right(self.starts_of_lines, position)

    def line_text(self, line):
        return self.text.split('\n')[line - 1].strip()

    def _tokens(self):
        found = []
        directives = [(m.start(), m.end()) for m in re.finditer(r'^[ \t]*#(?:[^\n\\]|\\.|\\\n)*', self.text, re.MULTILINE)]
        position, blank = 0, True
        while position < len(self.text):
            if directives and position >= directives[0][0]:
                position = max(position, directives.pop(0)[1])
                continue
            m = TOKEN.match(self.text, position)
            kind = m.lastgroup if m.lastgroup != 'mark' else 'raw'
            if kind in ('blank', 'comment'):
                blank = True
            else:
                found.append(Token('string' if kind == 'raw' else kind, m.group(), position, self.line_at(position), blank))
                blank = False
            position = m.end()
        return found

    def _mark_binary(self):
        for i, t in enumerate(self.tokens[1:-1], 1):
            before, after = self.tokens[i - 1], self.tokens[i + 1]
            t.binary = (t.text in PRECEDENCE and t.after_blank and after.after_blank and before.text != 'operator' and
                        (before.kind in ('word', 'number', 'string', 'char') or before.text in (')', ']', '}', '>')) and
                        before.text not in ENDS_BEFORE)

    def _match_brackets(self):
        open_ones = []
        for i, t in enumerate(self.tokens):
            if t.kind != 'operator':
                continue
            if t.text in '([{' or (t.text == '<' and not t.binary):
                open_ones.append(i)
            elif t.text in ')]}' or (t.text == '>' and not t.binary):
                while open_ones and CLOSING[self.tokens[open_ones[-1]].text] != t.text:
                    if t.text == '>':
                        break
                    open_ones.pop()  # a '<' that was no bracket
                else:
                    if open_ones:
                        t.partner = open_ones.pop()
                        self.tokens[t.partner].partner = i

    def left_operand(self, operator):
        """The index of the first token of what stands to the left of a binary operator; None where that is unclear."""
        level = PRECEDENCE[self.tokens[operator].text]
        i = operator
        while i > 0:
            right, t = self.tokens[i], self.tokens[i - 1]
            starts_expression = right.kind in ('word', 'number', 'string', 'char')
            if t.text in (')', ']', '}') or (t.text == '>' and not t.binary):
                if t.partner is None:
                    return None
                if starts_expression or (t.text == '}' and right.text in ('!', '*', '++', '--', '-')):
                    break
                i = t.partner
                continue
            if t.text in ('(', '[', '{', ',', ';', '?', ':') or t.text in ASSIGNMENTS or t.text in ENDS_BEFORE:
                break
            if t.text == '<' and not t.binary:
                break
            if t.binary and PRECEDENCE[t.text] < level:
                break
            if t.kind == 'word' and starts_expression:  # two words in a row: a declaration
                return None
            i -= 1
        return i if i < operator else None

    def right_operand(self, operator):
        """The index after the last token of what stands to the right of it."""
        level = PRECEDENCE[self.tokens[operator].text]
        i = operator + 1
        while i < len(self.tokens):
            t = self.tokens[i]
            if t.text in ('(', '[', '{') or (t.text == '<' and not t.binary):
                if t.text == '{' and i > operator + 1 and self.tokens[i - 1].text == ')' and t.after_blank and not self.of_lambda(i):
                    break
                if t.partner is None:
                    return None
                i = t.partner + 1
                continue
            if t.text in (')', ']', '}', ',', ';', '?', ':') or t.text in ASSIGNMENTS or (t.text == '>' and not t.binary):
                break
            if t.binary and PRECEDENCE[t.text] <= level:
                break
            i += 1
        return i if i > operator + 1 else None

    def of_lambda(self, brace):
        """Whether a brace opens the body of a lambda."""
        before = self.tokens[brace - 1]
        return before.text == ']' or (before.text == ')' and before.partner is not None and
                                      self.tokens[before.partner - 1].text == ']')

    def unary_operand(self, start):
        """The index after a postfix expression that begins at `start`."""
        i = start
        while i < len(self.tokens) and self.tokens[i].text in ('!', '*', '-', '++', '--', '&'):
            i += 1
        if i >= len(self.tokens):
            return None
        t = self.tokens[i]
        if t.text == '(':
            if t.partner is None:
                return None
            i = t.partner + 1
        elif t.kind in ('word', 'number', 'string', 'char'):
            i += 1
        else:
            return None
        while i < len(self.tokens):
            t = self.tokens[i]
            if t.text in ('.', '->', '::'):
                i += 2
            elif t.text in ('(', '[') or (t.text == '<' and not t.binary) or (t.text == '{' and not t.after_blank):
                if t.partner is None:
                    return None
                i = t.partner + 1
            else:
                break
        return i
