#!/usr/bin/env python3
"""A C header as doxygen wants it: comments in front of a declaration begin with /**, those behind
one, on its line, with /**<; and of `typedef struct x {...} x;` the struct alone, which is what it
describes. The first comment, and titles of sections, are of no declaration."""
import re
import sys

TEXT = open(sys.argv[1], encoding="utf-8").read()
TEXT = TEXT[TEXT.index("*/") + 2:]
TEXT = re.sub(r"^([ \t]*)/\* (?!---)", r"\1/** ", TEXT, flags=re.M)
TEXT = re.sub(r"^typedef (struct|enum) (\w+) \{(.*?)\} \2;", r"\1 \2 {\3};", TEXT, flags=re.M | re.S)
print(re.sub(r"(?<=[;,}\w)]) */\* ", " /**< ", TEXT), end="")
