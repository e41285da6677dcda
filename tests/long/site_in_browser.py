#!/usr/bin/env python3
"""Looks at a built site in headless Chromium, every page opened as a file: exits 1 with a line for each fault.

  tests/long/site_in_browser.py FOLDER [--pictures DIR]

No page may be wider than its window, at 1280 and at 412 pixels. No script may fail. The search must find a page by a word that stands in it.
--pictures writes a picture of each page at both widths."""
import argparse
import html
import re
import subprocess
import sys
import tempfile
from pathlib import Path

WIDTHS = (1280, 412)
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--hide-scrollbars"]
# Shows each page in a frame of each width and writes a line about it.
MEASURE = """<!doctype html><body><script>
const pages = %s, widths = %s;
async function look(page, width) {
  const frame = document.createElement("iframe");
  frame.width = width; frame.height = 900;
  document.body.append(frame);
  const loaded = new Promise(done => frame.onload = done);
  frame.src = page;
  await loaded;
  const root = frame.contentDocument.documentElement;
  const line = document.createElement("p");
  line.className = "measured";
  line.textContent = [page, width, root.scrollWidth, root.classList.contains("no-js") ? "dead" : "alive"].join("\\t");
  frame.remove();
  document.body.append(line);
}
(async () => { for (const width of widths) for (const page of pages) await look(page, width); document.body.dataset.done = "1"; })();
</script></body>"""


def chromium(url, *flags):
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(["chromium", *FLAGS, f"--user-data-dir={profile}", *flags, url], capture_output=True, text=True, timeout=300, check=False)
        return done.stdout


def measured(folder):
    pages = sorted(str(page.relative_to(folder)) for page in folder.rglob("*.html"))
    harness = folder / "measure.html"
    harness.write_text(MEASURE % (pages, list(WIDTHS)))
    try:
        seen = chromium(harness.as_uri(), "--allow-file-access-from-files", "--virtual-time-budget=600000", "--window-size=1400,1000", "--dump-dom")
    finally:
        harness.unlink()
    rows = [html.unescape(row).split("\t") for row in re.findall(r'<p class="measured">(.*?)</p>', seen, re.S)]
    if len(rows) != len(pages) * len(WIDTHS):
        sys.exit(f"only {len(rows)} of {len(pages) * len(WIDTHS)} pages were measured")
    return rows


def faults(folder):
    for page, width, seen, state in measured(folder):
        if int(seen) > int(width):
            yield f"{page}: {seen} px wide in a window of {width} px"
        if state == "dead":
            yield f"{page}: its scripts do not run"
    for word, page in {"crackle": "theory/criteria.html", "epitrochoid": "constraints.html"}.items():
        found = chromium((folder / "search.html").as_uri() + f"?q={word}", "--virtual-time-budget=20000", "--dump-dom")
        if not re.search(rf'<li[^>]*>\s*<a href="{re.escape(page)}', found):
            yield f"search.html: {word} does not lead to {page}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pictures", type=Path)
    given = parser.parse_args()
    folder = given.folder.resolve()
    found = list(faults(folder))
    print("\n".join(found) or f"every page fits into {WIDTHS[0]} and {WIDTHS[1]} px, and the search answers")
    if given.pictures:
        given.pictures.mkdir(parents=True, exist_ok=True)
        for page in sorted(folder.rglob("*.html")):
            for width in WIDTHS:
                name = str(page.relative_to(folder)).replace("/", "-").replace(".html", f"-{width}.png")
                chromium(page.as_uri(), f"--window-size={width},1400", f"--screenshot={(given.pictures / name).resolve()}")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
