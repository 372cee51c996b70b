# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Hooks of mkdocs: the README is the first page; files that are no pages are named, not linked, but must be there."""

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
    return files


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
        return f"[{text}]({path.relative_to(DOCS)}{anchor})" if is_readme else link.group(0)

    return LINK.sub(mended, markdown)
