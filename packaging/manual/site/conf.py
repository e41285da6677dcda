"""How Sphinx makes the manual's site out of docs/ (docs/adr/0028-the-site-is-made-by-sphinx.md). packaging/manual/build calls it."""
import re
import shutil
from pathlib import Path

from docutils.nodes import SkipNode
from docutils.utils.math import latex2mathml
from pygments.lexers.javascript import JavascriptLexer
from sphinx.errors import SphinxError

HERE = Path(__file__).resolve().parent
MATH_FONT = Path("/usr/share/fonts/truetype/dejavu/DejaVuMathTeXGyre.ttf")  # fonts-dejavu-extra
NORMALIZE = Path("/usr/share/nodejs/normalize.css/normalize.css")  # node-normalize.css

project = "Reachlab"
author = copyright = "The Reachlab authors"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
exclude_patterns = ["examples"]
suppress_warnings = ["myst.header"]  # pages written from schemas begin groups of keys at the third level

html_theme = "furo"
html_title = "Reachlab"
html_static_path = ["static"]
html_css_files = ["manual.css"]
html_copy_source = html_show_sourcelink = html_show_sphinx = False
html_show_search_summary = False  # it asks for pages by HTTP, which a page that was opened as a file may not
html_search_scorer = str(HERE / "scorer.js")
html_favicon = str(HERE.parents[2] / "resources/icons/reachlab.svg")
pygments_style = "friendly"
html_math_renderer = "mathml"
# An accented symbol with an index: the converter would put the index below the accent.
ACCENT = re.compile(r"\\(?:d{0,2}dot|bar|hat|tilde)(?:\{[^{}]*\}|\s*\\[a-z]+\s[A-Za-z]|\s*\\[a-z]+|\s+[A-Za-z])(?=[_^])")


def mathml(source, block):
    """The formula as MathML, which needs no script and prints. A command that is not known ends the build."""
    tree = latex2mathml.math(xmlns="http://www.w3.org/1998/Math/MathML", display="block" if block else "inline")
    node, source = tree, source.strip()
    if block and ("&" in source or r"\\" in source) and r"\begin" not in source:
        node = latex2mathml.mtd()
        tree.append(latex2mathml.mtable(latex2mathml.mtr(node), **{"class": "aligned", "displaystyle": "true"}))
    try:
        latex2mathml.parse_latex_math(node, ACCENT.sub(r"{\g<0>{}}", source))
    except SyntaxError as error:
        raise SphinxError(f"formula {source}: {error}") from error
    markup = tree.toxml() if hasattr(tree, "toxml") else tree.toprettyxml()  # the name in docutils 0.21, and before
    return spaced(bold(markup))


def spaced(markup):
    """A space after the name of a function, and none about a slash or the bars of an absolute value."""
    markup = markup.replace("<mo>&ApplyFunction;</mo>", '<mspace width="0.17em"></mspace>')
    return re.sub(r"<mo( [^>]*)?>([/|])</mo>", r'<mo\1 lspace="0" rspace="0">\2</mo>', markup)


def bold(markup):
    """Bold symbols as the letters that Unicode has for them: browsers of today leave the attribute unread."""
    def letter(found):
        first, base = ("A", 0x1D400) if found[1].isupper() else ("a", 0x1D41A)
        return f"<mi>{chr(base + ord(found[1]) - ord(first))}</mi>"

    return re.sub(r'<mi mathvariant="bold">([A-Za-z])</mi>', letter, markup)


def inline_formula(translator, node):
    translator.body.append(mathml(node.astext(), False))
    raise SkipNode


def block_formula(translator, node):
    number = f'<span class="eqno">({node["number"]})</span>' if node.get("number") else ""
    translator.body.append(f'<div class="math">{number}{mathml(node.astext(), True)}</div>')
    raise SkipNode


def make_local(app, error):
    """Debian's Furo asks a web server for a style sheet and loads its script as a module. Neither works where a page is opened as a file."""
    if error:
        return
    static = Path(app.outdir) / "_static"
    shutil.copy(MATH_FONT, static)
    sheet, imported = static / "styles/furo.css", "@import url(/javascript/normalize.css/normalize.css);"
    if "normalize.css v" not in (css := sheet.read_text()):  # Debian 13's Furo holds that sheet itself
        sheet.write_text(replaced(css, imported, NORMALIZE.read_text()))
    script, spy = static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    code = script.read_text().replace("import * as Gumshoe", "import Gumshoe")
    script.write_text(spy.read_text() + replaced(code, 'import Gumshoe from "./gumshoe-patched.js";', ""))
    spy.unlink()


def replaced(text, old, new):
    if old not in text:
        raise SphinxError(f"the theme has changed: it has no {old}")
    return text.replace(old, new)


def setup(app):
    app.add_lexer("jsonc", JavascriptLexer)
    app.add_html_math_renderer("mathml", (inline_formula, None), (block_formula, None))
    app.connect("build-finished", make_local)
