#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Finds links of HTML pages to files and anchors that are not there. Addresses of other sites are not looked at.
#   check_links.py FOLDER

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8", errors="replace"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(values[name] for name in ("id", "name") if values.get(name))
        self.links += [(self.getpos()[0], values[name]) for name in ("href", "src") if values.get(name)]


def broken_links(folder):
    pages = {path.resolve(): Page(path) for path in sorted(folder.rglob("*.html"))}
    if not pages:
        sys.exit(f"check_links.py: no pages in {folder}")
    for path, page in pages.items():
        for line, link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            name = urllib.parse.unquote(parts.path)
            target = (path.parent / name).resolve() if name else path
            anchor = urllib.parse.unquote(parts.fragment)
            if not target.exists():
                yield f"{path}:{line}: no file {link}"
            elif anchor and target in pages and anchor not in pages[target].anchors:
                yield f"{path}:{line}: no anchor {link}"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_links.py FOLDER")
    broken = list(broken_links(pathlib.Path(sys.argv[1])))
    if broken:
        sys.exit("\n".join(broken))


main()
