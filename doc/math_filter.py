#!/usr/bin/env python3
"""Doxygen's input filter for .md files: $...$ and $$...$$ become Doxygen's formulas."""
import re
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    text = file.read()
text = re.sub(r"\$\$(.+?)\$\$", r"\\f[\1\\f]", text, flags=re.DOTALL)
text = re.sub(r"(?<!\\f)\$([^$`]+?)\$", r"\\f$\1\\f$", text)
sys.stdout.write(text)
