#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every relative link of the Markdown documents leads to a file that exists and, with #heading, to a heading of it.

    python3 tests/package/document_links.py PROJECT
"""

import re
import sys
from pathlib import Path
from urllib.parse import unquote

FOLDERS = ("docs", "examples", "tests", "robots", "generated", "LICENSES")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)")


def without_code(text):
    text = re.sub(r"^(```|~~~).*?^\1\s*$", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(text):
    """The anchors that GitHub gives to the headings of a page."""
    found, count = set(), {}
    text = re.sub(r"^(```|~~~).*?^\1\s*$", "", text, flags=re.S | re.M)
    for heading in re.findall(r"^#{1,6}\s+(.*?)\s*#*$", text, flags=re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        seen = count.get(name, 0)
        count[name] = seen + 1
        found.add(name if seen == 0 else f"{name}-{seen}")
    return found


def main():
    top = Path(sys.argv[1]).resolve()
    pages = sorted(top.glob("*.md"))
    for folder in FOLDERS:
        pages += sorted((top / folder).rglob("*.md"))
    links, broken = 0, []
    for page in pages:
        for link in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
            if re.match(r"[a-z][a-z0-9+.-]*:", link):
                continue
            links += 1
            path, _, anchor = link.partition("#")
            target = (page.parent / unquote(path)).resolve() if path else page
            here = page.relative_to(top)
            if not target.exists():
                broken.append(f"{here}: the link to {link} leads to no file")
            elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text(encoding="utf-8")):
                broken.append(f"{here}: the link to {link} leads to no heading")
    print("\n".join(broken + [f"{len(pages)} documents, {links} relative links, {len(broken)} broken"]))
    sys.exit(1 if broken or links < 50 else 0)


main()
