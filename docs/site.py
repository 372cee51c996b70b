# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Hooks of mkdocs: the README is the first page; notebooks are pages; files that are no pages are named, not linked,
but must be there."""

import json
import logging
import pathlib
import re

from mkdocs.structure.files import File

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent
LINK = re.compile(r"\[([^]]*)\]\(([^)#:\s]+)(#[^)\s]*)?\)")
log = logging.getLogger("mkdocs.hooks.site")


def on_files(files, config):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    files.append(File.generated(config, "index.md", content=text))
    for path in sorted((DOCS / "notebooks").glob("*.ipynb")):
        files.remove(files.get_file_from_path(f"notebooks/{path.name}"))
        files.append(File.generated(config, f"notebooks/{path.stem}.md", content=notebook_text(path)))
    return files


def notebook_text(path):
    """The cells of a notebook as Markdown."""
    texts = []
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"])
        language = "sh" if text.startswith("%%bash\n") else "python"
        texts.append(text if cell["cell_type"] == "markdown" else f"```{language}\n{text.removeprefix('%%bash' + chr(10))}\n```")
    return "\n\n".join(texts) + "\n"


def on_page_markdown(markdown, page, **_):
    is_readme = page.file.src_uri == "index.md"
    folder = ROOT if is_readme else (DOCS / page.file.src_uri).parent

    def mended(link):
        text, target, anchor = link.group(1), link.group(2), link.group(3) or ""
        path = (folder / target).resolve()
        if not path.exists():
            log.warning("%s: a link to %s, which is not there", page.file.src_uri, target)
        if not path.is_relative_to(DOCS):
            return text
        if path.suffix == ".ipynb":
            target = re.sub(r"\.ipynb$", ".md", target)
            path = path.with_suffix(".md")
        return f"[{text}]({path.relative_to(DOCS)}{anchor})" if is_readme else f"[{text}]({target}{anchor})"

    return LINK.sub(mended, markdown)
