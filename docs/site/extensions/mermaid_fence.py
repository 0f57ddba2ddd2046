"""Diagrams in fences of the language mermaid, which a forge draws, too: drawn by the reader's browser with the copy of
Mermaid that is part of the site (static/mermaid.min.js, which scripts/build_docs.sh puts there)."""

from docutils import nodes
from sphinx.util.docutils import SphinxDirective


class diagram(nodes.General, nodes.Element):  # noqa: N801 - nodes are named so
    pass


class Mermaid(SphinxDirective):
    has_content = True

    def run(self):
        return [diagram("", text="\n".join(self.content))]


def visit(translator, node):
    translator.body.append(f'<pre class="mermaid">{translator.encode(node["text"])}</pre>')
    raise nodes.SkipNode


def add_script(app, _page, _template, _context, doctree):
    if doctree is not None and next(doctree.findall(diagram), None) is not None:
        app.add_js_file("mermaid.min.js")
        app.add_js_file("diagrams.js")


def setup(app):
    app.add_node(diagram, html=(visit, None))
    app.add_directive("mermaid", Mermaid)
    app.connect("html-page-context", add_script)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
