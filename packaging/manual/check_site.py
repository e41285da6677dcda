#!/usr/bin/env python3
"""Exits 1 with a line for every src, href and url() of a built site that names a missing file, a missing heading or another machine.

  packaging/manual/check_site.py FOLDER

Links that a reader follows to other sites are allowed. Files that a page needs to be shown must lie in the folder."""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.wanted, self.names = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("id", "name"):
                self.names.add(value)
            elif key in ("src", "href", "data", "poster") and value is not None:
                self.wanted.append((tag, value))


def faults(folder):
    pages = {page: Page(page.read_text()) for page in folder.rglob("*.html")}
    if not pages:
        yield f"{folder}: no page is there"
    for page, content in pages.items():
        for tag, wanted in content.wanted:
            said = f"{page.relative_to(folder)}: {tag} {wanted}:"
            parts = urlsplit(wanted)
            if parts.scheme in ("data", "mailto"):
                continue
            if parts.scheme or parts.netloc:
                if tag != "a":
                    yield f"{said} lies on another machine"
                continue
            target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            if not target.is_file():
                yield f"{said} the file is missing"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].names:
                yield f"{said} the heading is missing"
    for sheet in folder.rglob("*.css"):
        for wanted in re.findall(r"url\(\s*[\"']?([^\"')]+)", sheet.read_text()):
            if not wanted.startswith(("data:", "#")) and not (sheet.parent / urlsplit(wanted).path).is_file():
                yield f"{sheet.relative_to(folder)}: url({wanted}): the file is missing"


def main():
    found = sorted(faults(Path(sys.argv[1]).resolve()))
    print("\n".join(found), file=sys.stderr, end="\n" if found else "")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
