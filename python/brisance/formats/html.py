"""A result as one page that needs nothing else: the viewer and the recording in a single file.

It opens from disk, in any browser of the last years with WebGL 2, without a server or a network.
"""

from __future__ import annotations

import base64
import gzip
import html
import re
from pathlib import Path
from typing import TYPE_CHECKING

from brisance.errors import BrisanceError
from brisance.formats.atomic import write_text
from brisance.formats.packed import pack

if TYPE_CHECKING:
    from brisance.result import Result

STATIC = Path(__file__).parents[1] / "view" / "static"
"""Where the built viewer lies: ``index.html``, ``viewer.js``, ``viewer.css``."""


def check_viewer() -> None:
    """Raise :class:`BrisanceError` unless the viewer has been built."""
    if not (STATIC / "index.html").is_file():
        raise BrisanceError("the viewer has not been built; run make viewer, which needs Node 20 or newer.")


def write_html(result: Result, path: Path | str) -> None:
    """Write the page of a result, whole or not at all."""
    write_text(path, page(result))


def page(result: Result) -> str:
    """The page of a result."""
    check_viewer()
    text, script, style = (
        (STATIC / name).read_text(encoding="utf-8") for name in ("index.html", "viewer.js", "viewer.css")
    )
    # Within a script element only its own end tag ends it; within a string of it "<\/" is "</".
    script = script.replace("</script", "<\\/script").replace("<!--", "<\\!--")
    data = base64.b64encode(gzip.compress(pack(result), 6, mtime=0)).decode()
    # The page's own script may run only after the recording and the body are there.
    text, scripts = re.subn(r'<script type="module"[^>]*></script>', "", text)
    text, styles = re.subn(r'<link rel="stylesheet"[^>]*>', lambda _: f"<style>{style}</style>", text)
    text, icons = re.subn(r"<title>[^<]*</title>", f"<title>{html.escape(result.scene.name)}</title>", text)
    if (scripts, styles, icons) != (1, 1, 1):
        raise BrisanceError("the viewer's page is not as it was built; run make viewer.")
    head, end = text.rsplit("</body>", 1)
    return (
        f'{head}<script type="application/octet-stream" id="recording">{data}</script>\n'
        f'<script type="module">{script}</script>\n</body>{end}'
    )
