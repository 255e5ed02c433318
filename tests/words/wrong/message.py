"""A module about a closed pair."""
# A comment may name an open pair.


def tell(pair):
    return f"{pair} is an open pair, `open pair` is code"
