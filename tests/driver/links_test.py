#!/usr/bin/python3
"""Pages point to what is there, and every picture is in a page."""
import os
import re
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)]*)?\)")


def files(ending):
    for top in ("doc", "source", "contrib", "prm", "tests", "include"):
        for directory, _, names in os.walk(os.path.join(ROOT, top)):
            yield from (os.path.join(directory, name) for name in names if name.endswith(ending))
    yield from (os.path.join(ROOT, name) for name in os.listdir(ROOT) if name.endswith(ending))


def links(page):
    """The places in this tree that a page points to."""
    with open(page, encoding="utf-8") as text:
        for place in LINK.findall(text.read()):
            if not re.match(r"[a-z]+:", place):
                yield os.path.normpath(os.path.join(os.path.dirname(page), place))


class LinksTest(unittest.TestCase):
    def test_links(self):
        broken = [f"{os.path.relpath(page, ROOT)}: {os.path.relpath(place, ROOT)}"
                  for page in files(".md") for place in links(page) if not os.path.exists(place)]
        self.assertEqual(broken, [])

    def test_pictures(self):
        shown = {place for page in files(".md") for place in links(page)}
        self.assertEqual([os.path.relpath(name, ROOT) for name in files(".png") if name not in shown], [])


if __name__ == "__main__":
    unittest.main()
