"""Links of a page to a file or a folder of the repository, which a forge shows: here the file has a page of its own
with its text, and a folder leads to its README, or to a page with its files."""

import html
import posixpath
from pathlib import Path
from string import Template

from docutils import nodes
from pygments.lexers import get_lexer_for_filename
from pygments.util import ClassNotFound
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

LARGEST = 300_000  # bytes of a file that is shown
INSTEAD = {"interfaces/stride/master.h": "docs/site/c-api"}  # a file that has a page made for readers


class SourceLinks(SphinxTransform):
    """Puts a link of our own in the place of MyST's to what is no page."""

    default_priority = 20

    def apply(self, **_kwargs):
        for node in list(self.document.findall(self._is_link)):
            path = posixpath.normpath(posixpath.join(posixpath.dirname(self.env.docname), node["reftarget"]))
            target = Path(self.env.srcdir, path)
            page = page_of(self.env, path)
            if page:
                link = addnodes.pending_xref("", *node.children, refdomain="doc", reftype="myst", reftarget=page,
                                             reftargetid=None, refdoc=self.env.docname, refexplicit=True)
            elif target.exists():
                link = addnodes.pending_xref("", *node.children, refdomain="", reftype="source", reftarget=path,
                                             refdoc=self.env.docname, refexplicit=True)
                notes(self.env).setdefault(self.env.docname, set()).add(path)
            else:
                continue
            node.replace_self(link)

    @staticmethod
    def _is_link(node):
        is_xref = isinstance(node, addnodes.pending_xref) and node["reftype"] == "myst" and not node.get("refdomain")
        return is_xref or isinstance(node, addnodes.download_reference)


def page_of(env, path):
    """The page that is to be shown for this file or folder, or None."""
    if path in INSTEAD:
        return INSTEAD[path]
    readme = posixpath.join(path, "README")
    return readme if readme in env.found_docs else None


def notes(env):
    """The files and folders that the pages link to, by page."""
    if not hasattr(env, "stride_sources"):
        env.stride_sources = {}
    return env.stride_sources


def resolve(app, _env, node, content):
    if node["reftype"] != "source":
        return None
    uri = app.builder.get_relative_uri(node["refdoc"], f"source/{node['reftarget']}")
    return nodes.reference("", "", content, internal=True, refuri=uri)


def write_pages(app, error):
    """Without the theme's navigation, which takes longer to make than all else together."""
    if error or app.builder.format != "html":
        return
    template = Path(__file__).with_name("source.html").read_text(encoding="utf-8")
    paths = set().union(*notes(app.env).values())
    for path in sorted(paths):
        target = Path(app.srcdir, path)
        body = folder_body(app, path, target, paths) if target.is_dir() else file_body(app, target)
        uri = app.builder.get_relative_uri(f"source/{path}", "README")
        out = Path(app.outdir, "source", f"{path}.html")
        out.parent.mkdir(parents=True, exist_ok=True)
        parts = {"title": html.escape(path), "project": html.escape(app.config.html_title), "start": uri,
                 "static": posixpath.join(posixpath.dirname(uri), "_static"), "body": body}
        out.write_text(Template(template).substitute(parts), encoding="utf-8")


def folder_body(app, path, folder, paths):
    lines = []
    for name in sorted(each.name for each in folder.iterdir() if not each.name.startswith((".", "__"))):
        shown = f"<code>{html.escape(name)}</code>"
        if f"{path}/{name}" in paths:
            uri = app.builder.get_relative_uri(f"source/{path}", f"source/{path}/{name}")
            shown = f'<a href="{html.escape(uri)}">{shown}</a>'
        lines.append(f"<li>{shown}</li>")
    return "<ul>{}</ul>".format("\n".join(lines))


def file_body(app, file):
    if file.stat().st_size > LARGEST:
        return "<p>It is too long to be shown.</p>"
    try:
        lexer = get_lexer_for_filename(file.name).aliases[0]
    except (ClassNotFound, IndexError):
        lexer = "text"
    return app.builder.highlighter.highlight_block(file.read_text(encoding="utf-8"), lexer, force=True)


def purge(_app, env, docname):
    notes(env).pop(docname, None)


def merge(_app, env, _docnames, other):
    notes(env).update(notes(other))


def setup(app):
    app.add_transform(SourceLinks)
    app.connect("missing-reference", resolve)
    app.connect("build-finished", write_pages)
    app.connect("env-purge-doc", purge)
    app.connect("env-merge-info", merge)
    return {"version": "1", "env_version": 1, "parallel_read_safe": True, "parallel_write_safe": True}
