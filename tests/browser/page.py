"""A page with the viewer alone, joined as the report joins it."""

import json
from pathlib import Path

ASSETS = Path(__file__).resolve().parents[2] / "crates/quasirigid-report/src/assets"
VIEWER = ASSETS / "viewer"
POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
STILL = '<figure id="still"><svg viewBox="-60 -40 120 80" role="img" aria-label="The body"><circle r="30" fill="#a9b4c0"/></svg></figure>'


def scripts():
    """The files of the script in their order."""
    return [VIEWER / line for line in (VIEWER / "order.txt").read_text().split()]


def script(files=None):
    return "\n".join(path.read_text() for path in files or scripts())


def escaped(scene):
    """JSON that cannot end the element it stands in."""
    return json.dumps(scene, separators=(",", ":")).replace("<", "\\u003c")


def page(scene):
    style = "\n".join(path.read_text() for path in (ASSETS / "palette.css", ASSETS / "page.css", VIEWER / "viewer.css"))
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{POLICY}"><title>quasirigid report</title><style>{style}</style></head>
<body><main><h1>Report</h1>
{(VIEWER / "viewer.html").read_text()}
{STILL}
</main><script type="application/json" id="scene">{escaped(scene)}</script>
<script>(() => {{ "use strict";
{script()}
}})();</script></body></html>"""
