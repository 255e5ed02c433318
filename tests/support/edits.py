"""A source, edited: for copies of it that have a fault on purpose."""


def in_comment(text, begin, end):
    """Does the range touch a line of FORTRAN that has C in column 1? Line ends at its ends do not count."""
    while begin < end and text[begin] == "\n":
        begin += 1
    first = text.rfind("\n", 0, begin) + 1
    return any(line.startswith("C") for line in text[first:end].split("\n"))


def edited(source, replacements):
    """The source with every (old, new) made. A ValueError where `old` does not occur exactly once, or lies in a comment:
    such an edit changes nothing, or not what is meant."""
    for old, new in replacements:
        if source.count(old) != 1:
            raise ValueError(f"found {source.count(old)} times, allowed: once: {old}")
        at = source.index(old)
        if in_comment(source, at, at + len(old)):
            raise ValueError(f"found in a comment: {old}")
        source = source[:at] + new + source[at + len(old):]
    return source
