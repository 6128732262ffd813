"""The charts of a report in a browser: zoom, values, the clock of the picture, and what can be taken away."""

from __future__ import annotations

import base64
import csv
import io
import json
import re
import shutil
import struct
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import EXAMPLES, until

from quasirigid import Model

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no Chromium or Chrome on this machine: the charts were not opened in a browser")
playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: the charts were not opened in a browser")

DRAWING = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
HOSTILE = '</script><img src=x onerror=alert(1)>"\'&<b>, \u0007\u202eund "'
Open = Callable[..., Any]


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A run of many revolutions, a short one, and one whose labels would end scripts and start formulas."""
    folder = tmp_path_factory.mktemp("plots")
    made = {}
    for name in ["boom-satellite", "nutation-damper"]:
        made[name] = folder / f"{name}.html"
        Model.from_file(EXAMPLES / name / "model.toml").run().report(made[name])
    text = made["nutation-damper"].read_text()
    for name, change in [("hostile", hostile), ("many", many)]:
        made[name] = folder / f"{name}.html"
        made[name].write_text(changed(text, change))
    return made


DATA = re.compile(r'(<script class="figure-data" type="application/octet-stream">)(.*?)(</script>)', re.DOTALL)


def unpacked(text: str) -> Any:
    """Data that a page holds for its scripts, each array as its bytes."""
    line, arrays = zlib.decompress(base64.b64decode(text), wbits=-15).split(b"\n", 1)

    def array(value: dict[str, Any]) -> Any:
        if "packed" not in value:
            return value
        offset, length, width, distance, times = value["packed"]
        kind = np.dtype(f"<u{width}")
        numbers = np.frombuffer(arrays[offset : offset + length], "u1").reshape(width, -1).T.copy().view(kind).ravel()
        for _ in range(times):
            for first in range(distance):
                numbers[first::distance] = np.cumsum(numbers[first::distance], dtype=kind)
        return numbers.tobytes()

    return json.loads(line, object_hook=array)


def packed(data: Any) -> str:
    """Data for a page, whose arrays are not coded."""
    arrays: list[bytes] = []

    def array(value: bytes) -> Any:
        offset = sum(map(len, arrays))
        arrays.append(value)
        return {"packed": [offset, len(value), 1, 1, 0]}

    line = json.dumps(data, default=array).encode()
    deflate = zlib.compressobj(wbits=-15)
    return base64.b64encode(deflate.compress(b"\n".join([line, b"".join(arrays)])) + deflate.flush()).decode()


def changed(text: str, change: Callable[[Any], None]) -> str:
    """A page whose data of figures have been changed."""

    def once(found: re.Match[str]) -> str:
        data = unpacked(found[2])
        change(data)
        return found[1] + packed(data) + found[3]

    return DATA.sub(once, text)


def hostile(data: Any) -> None:
    data["title"] = HOSTILE
    data["name"] = "../../" + HOSTILE
    for series, label in zip(data["series"], ["=cmd()|' /C calc'!A0", HOSTILE, "@sum(a,b)"]):
        series["label"] = label


def many(data: Any) -> None:
    """Four curves of four thousand points."""
    t = np.linspace(data["x"]["low"], data["x"]["high"], 4000)
    low, high = data["y"]["low"], data["y"]["high"]
    data["grids"] = [floats(t)]
    wave = [floats(low + (high - low) * (0.5 + 0.4 * np.sin((k + 1) * 9 * t / t[-1]))) for k in range(4)]
    data["series"] = [{"label": f"s{k}", "class": f"s{k + 1}", "grid": 0, "values": wave[k], "rows": 4000, "points": False} for k in range(4)]


def floats(values: Any) -> bytes:
    return np.asarray(values, dtype="<f4").tobytes()


def data_of(path: Path, name: str) -> Any:
    """Data of a figure, its arrays as numbers."""
    found = next(data for data in (unpacked(each[2]) for each in DATA.finditer(path.read_text())) if data["name"] == name)
    grids = [np.frombuffer(grid, "<f4").astype(float) for grid in found["grids"]]
    for series in found["series"]:
        series["x"], series["y"] = grids[series["grid"]], np.frombuffer(series["values"], "<f4").astype(float)
    return found


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as tools:
        opened = tools.chromium.launch(executable_path=BROWSER, args=DRAWING)
        yield opened
        opened.close()


@pytest.fixture
def look(browser: Any, pages: dict[str, Path]) -> Iterator[Open]:
    """Opens a report at rest, and checks at the end that it said nothing to the console and asked for no other file."""
    said: list[str] = []
    asked: list[str] = []
    opened = []

    def look(name: str, *, script: str = "", **options: Any) -> Any:
        page = browser.new_page(**{"viewport": {"width": 1000, "height": 900}, "reduced_motion": "reduce", **options})
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        if script:
            page.add_init_script(script)
        page.goto(pages[name].as_uri())
        opened.append(page)
        if options.get("java_script_enabled", True):
            until(page, "performance.getEntriesByName('quasirigid:charts').length")
        return page

    yield look
    for page in opened:
        page.close()
    own = {path.as_uri() for path in pages.values()}
    assert not said and not [url for url in asked if url not in own and not url.startswith(("data:", "blob:"))], (said, asked)


class Chart:
    """A chart of an open page, by the identifier of its figure."""

    def __init__(self, page: Any, name: str, *, scroll: bool = True) -> None:
        self.page, self.name = page, name
        self.figure = page.locator("figure", has=page.locator(f"#{name}-title"))
        self.box = self.figure.locator(".chart")
        self.over = self.figure.locator(".over")
        if scroll:
            self.over.scroll_into_view_if_needed()

    def spot(self, part: float, down: float = 0.5) -> tuple[float, float]:
        self.over.scroll_into_view_if_needed()
        box = self.over.bounding_box()
        return box["x"] + part * box["width"], box["y"] + down * box["height"]

    def hover(self, part: float, down: float = 0.5) -> None:
        self.page.mouse.move(*self.spot(part, down))
        self.settle()

    def drag(self, start: float, end: float, down: float = 0.5) -> None:
        self.page.mouse.move(*self.spot(start, down))
        self.page.mouse.down()
        self.page.mouse.move(*self.spot((start + end) / 2, down))
        self.page.mouse.move(*self.spot(end, down))
        self.page.mouse.up()
        self.settle()

    def settle(self) -> None:
        settle(self.page)

    @property
    def zoomed(self) -> bool:
        return "zoomed" in self.box.get_attribute("class")

    def shown(self, query: str) -> list[str]:
        """Texts in the drawing that is shown."""
        every = self.box.locator(query).all()
        return [node.text_content() for node in every if node.is_visible()]

    def ticks(self) -> list[str]:
        return self.shown(".tick")

    def paths(self, kind: str) -> list[str]:
        found = self.box.locator(f".part path.{kind}").evaluate_all("(paths) => paths.map((path) => path.getAttribute('d'))")
        return list(found)

    def readout(self) -> list[str]:
        texts = self.box.locator(".readout > span").all_text_contents()
        return list(texts)

    def file(self, kind: str) -> tuple[str, bytes]:
        """Name and content of a download."""
        self.figure.hover()
        with self.page.expect_download() as awaited:
            self.figure.get_by_role("button", name=kind).click()
        return awaited.value.suggested_filename, Path(awaited.value.path()).read_bytes()


def settle(page: Any) -> None:
    """Waits until what was asked for is drawn."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))")


def number(text: str) -> float:
    """A number as the page writes it."""
    raised = text.replace("−", "-").replace("\u202f", "").replace("×10", "e")
    return float(raised.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))


def numbers(text: str) -> list[float]:
    return [number(each) for each in re.findall(r"(?<!\w)−?\d[\d.\u202f]*(?:×10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?", text)]


def plot_of(page: Any, name: str) -> bytes:
    """The drawing of a chart in the corner of the window."""
    Chart(page, name, scroll=False).box.scroll_into_view_if_needed()
    corner = f".chart:has(#{name}-title) {{ position: fixed; left: 0; top: 0; width: 800px; z-index: 9; background: var(--paper); }}"
    own = ".now, .readout, .rule, .spots { display: none !important; }"
    shot: bytes = page.screenshot(style=own + corner, clip={"x": 0, "y": 0, "width": 800, "height": 300})
    return shot


@pytest.mark.parametrize("name", ["spin", "energy", "evolution-map"])
def test_the_whole_is_the_static_drawing(look: Open, name: str) -> None:
    still = look("nutation-damper", java_script_enabled=False)
    live = look("nutation-damper")
    before = plot_of(still, name)
    assert plot_of(live, name) == before
    chart = Chart(live, name)
    chart.drag(0.2, 0.7)
    assert chart.zoomed and plot_of(live, name) != before
    live.mouse.dblclick(*chart.spot(0.5))
    chart.settle()
    live.mouse.move(0, 0)
    assert not chart.zoomed and plot_of(live, name) == before


def test_charts_of_the_time_share_a_range_that_is_dragged(look: Open, pages: dict[str, Path]) -> None:
    page = look("boom-satellite")
    spin, energy, first = (Chart(page, name) for name in ("spin", "energy", "first-turns"))
    spin.drag(0.25, 0.5)
    whole = data_of(pages["boom-satellite"], "spin")["x"]
    low, high = whole["low"], whole["high"]
    for chart in (spin, energy):
        chart.over.scroll_into_view_if_needed()
        chart.settle()
        t = [number(tick) for tick in chart.shown(".tick.middle")]
        assert chart.zoomed and low + 0.24 * (high - low) <= t[0] < t[-1] <= low + 0.51 * (high - low)
    # the beginning lies outside of that range, and shows its own
    first.over.scroll_into_view_if_needed()
    first.settle()
    assert not first.zoomed
    first.drag(0.5, 1)
    assert first.zoomed
    spin.over.scroll_into_view_if_needed()
    spin.settle()
    factor = data_of(pages["boom-satellite"], "first-turns")["x"]
    ends = factor["high"] * factor["link"]["factor"] / whole["link"]["factor"]
    assert all(ends * 0.45 <= number(tick) <= ends * 1.01 for tick in spin.shown(".tick.middle"))
    spin.figure.get_by_role("button", name="whole", exact=True).click()
    spin.settle()
    assert not spin.zoomed and not first.zoomed


def test_the_vertical_axis_fits_what_is_shown(look: Open, pages: dict[str, Path]) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "evolution-nutation")
    data = data_of(pages["nutation-damper"], "evolution-nutation")
    static = chart.ticks()
    x = data["x"]
    chart.drag(0.6, 0.8)
    low, high = (x["low"] + part * (x["high"] - x["low"]) for part in (0.6, 0.8))
    inside = [y for each in data["series"] for y in each["y"][(each["x"] >= low) & (each["x"] <= high)]]
    ticks = [number(tick) for tick in chart.shown(".tick.end")]
    steps = np.diff(sorted(ticks))
    assert chart.ticks() != static and 3 <= len(ticks) <= 8
    assert np.allclose(steps, steps[0]) and round(steps[0] / 10 ** np.floor(np.log10(steps[0])), 6) in (1, 2, 5)
    span = max(inside) - min(inside)
    assert min(inside) - 0.07 * span <= min(ticks) and max(ticks) <= max(inside) + 0.07 * span
    assert max(ticks) - min(ticks) > 0.6 * span
    page.keyboard.press("Escape")
    # almost the whole has the ticks of the whole
    chart.drag(0, 0.9995)
    assert chart.zoomed and chart.ticks() == static


def test_few_decades_have_ticks_between_the_powers(look: Open) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "evolution-power")
    chart.drag(0.4, 0.5)
    ticks = [number(tick) for tick in chart.shown(".tick.end")]
    assert len(ticks) >= 3 and max(ticks) / min(ticks) < 10
    chart.drag(0.4, 0.42)
    assert len(chart.shown(".tick.end")) >= 3
    assert all(len(tick) <= 8 for tick in chart.shown(".tick.end"))


def test_the_readout_tells_the_nearest_points(look: Open, pages: dict[str, Path]) -> None:
    page = look("nutation-damper")
    for name in ("evolution-nutation", "evolution-power"):
        chart = Chart(page, name)
        data = data_of(pages["nutation-damper"], name)
        x = data["x"]
        for part in (0.1, 0.43, 0.9):
            chart.hover(part)
            at = x["low"] + part * (x["high"] - x["low"])
            told = chart.readout()
            assert abs(numbers(told[0])[0] - at) < 0.02 * (x["high"] - x["low"]) and told[0].endswith(f"\u00a0{x['unit']}")
            for series, words in zip(data["series"], told[1:], strict=True):
                value = series["y"][np.abs(series["x"] - at).argmin()]
                value = 10**value if data["y"]["log"] else value * 10.0 ** data["y"]["power"]
                assert words.startswith(f"{series['label']} ")
                assert numbers(words)[0] == pytest.approx(value, rel=1e-2), (words, value)
    other = Chart(page, "evolution-nutation")
    other.drag(0.2, 0.4)
    left = other.box.locator(".rule").evaluate("(node) => parseFloat(node.style.left)")
    assert left == pytest.approx(40, abs=0.5), "the rule is under the pointer after a zoom too"
    assert other.box.locator(".rule").is_visible() and len(other.readout()) == 3
    page.mouse.move(0, 0)
    other.settle()
    assert other.box.locator(".rule").is_hidden() and other.box.locator(".readout").is_hidden()


def test_the_readout_covers_no_curve(look: Open) -> None:
    for width in (1000, 320):
        page = look("nutation-damper", viewport={"width": width, "height": 800})
        chart = Chart(page, "spin")
        chart.hover(0.5)
        readout, plot = chart.box.locator(".readout").bounding_box(), chart.over.bounding_box()
        assert readout["y"] + readout["height"] <= plot["y"] and readout["x"] >= 0


def test_a_thinned_curve_is_a_band_and_says_so(look: Open, pages: dict[str, Path]) -> None:
    page = look("boom-satellite")
    chart = Chart(page, "spin")
    data = data_of(pages["boom-satellite"], "spin")
    series = data["series"][0]
    assert series["rows"] > len(series["x"])
    assert chart.box.locator(".note").text_content() == ""
    chart.drag(0.3, 0.32)
    note = chart.box.locator(".note").text_content()
    each = -(-series["rows"] // (len(series["x"]) // 2))
    assert re.fullmatch(rf"Extremes of ({each}|{3 * each})( to {3 * each})? rows each", note), note
    assert any(chart.paths("reach")) and not all(chart.paths("curve"))
    assert not any(area and line for area, line in zip(chart.paths("reach"), chart.paths("curve"), strict=True))
    chart.hover(0.5)
    pair = next(numbers(words) for words in chart.readout()[1:] if "…" in words)
    low, high = (data["x"]["low"] + part * (data["x"]["high"] - data["x"]["low"]) for part in (0.3, 0.32))
    near = (series["x"] > low) & (series["x"] < high)
    assert pair[0] < pair[1]
    if "…" in chart.readout()[1]:
        low, high = series["y"][near].min(), series["y"][near].max()
        first = numbers(chart.readout()[1])
        assert low - 1e-3 <= first[0] < first[1] <= high + 1e-3


def test_keys_alone_do_it_all(look: Open, pages: dict[str, Path]) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "evolution-nutation")
    told = page.locator("[aria-live=polite].unseen")
    chart.over.focus()

    def press(key: str) -> list[float]:
        page.keyboard.press(key)
        chart.settle()
        return [number(tick) for tick in chart.shown(".tick.middle")]

    before = press("Shift")
    near = press("+")
    assert near[-1] - near[0] < before[-1] - before[0] and " from " in told.text_content()
    right = press("ArrowRight")
    assert right[-1] > near[-1]
    assert press("ArrowLeft")[-1] <= right[-1]
    wide = press("-")
    assert not chart.zoomed and wide == before
    press("+")
    press("0")
    assert not chart.zoomed
    press("+")
    press("Escape")
    assert not chart.zoomed
    press("Alt+ArrowRight")
    first = told.text_content()
    press("Alt+ArrowRight")
    second = told.text_content()
    data = data_of(pages["nutation-damper"], "evolution-nutation")
    assert first != second and all(series["label"] in second for series in data["series"])
    assert chart.box.locator(".rule").is_visible()
    assert numbers(second.split(",")[0])[0] > numbers(first.split(",")[0])[0]
    chart.hover(0.5)
    assert told.text_content() == second, "the pointer speaks"


def test_a_wheel_zooms_with_control_alone_and_shift_moves(look: Open) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "spin")
    chart.hover(0.5)
    top = page.evaluate("scrollY")
    page.mouse.wheel(0, 120)
    until(page, f"scrollY > {top}")
    assert not chart.zoomed
    chart.hover(0.5)
    page.keyboard.down("Control")
    for _ in range(4):
        page.mouse.wheel(0, -120)
    page.keyboard.up("Control")
    chart.box.locator("xpath=self::*[contains(@class, 'zoomed')]").wait_for()
    chart.settle()
    before = [number(tick) for tick in chart.shown(".tick.middle")]
    page.keyboard.down("Shift")
    chart.drag(0.8, 0.3)
    page.keyboard.up("Shift")
    after = [number(tick) for tick in chart.shown(".tick.middle")]
    assert chart.zoomed and after[-1] > before[-1] and after[-1] - after[0] == pytest.approx(before[-1] - before[0], rel=0.5)


def test_escape_ends_a_drag(look: Open) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "spin")
    page.mouse.move(*chart.spot(0.3))
    page.mouse.down()
    page.mouse.move(*chart.spot(0.6))
    assert chart.box.locator(".band-of-range").is_visible()
    page.keyboard.press("Escape")
    page.mouse.up()
    chart.settle()
    assert not chart.zoomed and chart.box.locator(".band-of-range").is_hidden()


def test_fingers_zoom_and_the_page_still_scrolls(look: Open) -> None:
    page = look("nutation-damper", has_touch=True, viewport={"width": 400, "height": 800})
    chart = Chart(page, "spin")
    assert chart.over.evaluate("(node) => getComputedStyle(node).touchAction") == "pan-y"
    assert chart.figure.locator(".tools").evaluate("(node) => getComputedStyle(node).opacity") == "1"
    driver = page.context.new_cdp_session(page)

    def touch(kind: str, *parts: float) -> None:
        points = [dict(zip("xy", chart.spot(part)), id=i) for i, part in enumerate(parts)]
        driver.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", 0.45)
    touch("touchStart", 0.45, 0.55)
    for reach in (0.1, 0.2, 0.3, 0.4):
        touch("touchMove", 0.5 - reach, 0.5 + reach)
    touch("touchEnd")
    chart.settle()
    assert chart.zoomed


def test_the_clock_of_the_picture_and_the_charts_go_together(look: Open, pages: dict[str, Path]) -> None:
    page = look("nutation-damper")
    page.evaluate("window.asked = []; addEventListener('quasirigid:seek', ({ detail }) => asked.push(detail.t))")
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    page.evaluate("(() => { const it = document.getElementById('viewer-scrub'); it.value = 0.7; it.dispatchEvent(new Event('input')); })()")
    chart = Chart(page, "spin")
    until(page, "Math.abs(parseFloat(document.querySelector('figure:has(#spin-title) .now').style.left) - 70) < 0.5")
    now = chart.box.locator(".now")
    assert now.is_visible()
    page.mouse.click(*chart.spot(0.25))
    place = "parseFloat(document.querySelector('figure:has(#spin-title) .now').style.left)"
    until(page, f"Math.abs({place} - 25) < 0.5")
    x = data_of(pages["nutation-damper"], "spin")["x"]
    t = x["link"]["factor"] * (x["low"] + 0.25 * (x["high"] - x["low"]))
    assert page.evaluate("asked") == pytest.approx([t], rel=0.01)
    assert page.inner_text("#viewer-time").startswith("15") or page.inner_text("#viewer-time").startswith("14.9")
    chart.drag(0.5, 0.6)
    assert len(page.evaluate("asked")) == 1 and now.is_hidden()
    page.select_option("#viewer-motion", index=1)
    page.evaluate("window.told = 0; addEventListener('quasirigid:time', () => told++)")
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    page.click("#viewer-play")
    page.wait_for_timeout(300)
    assert page.evaluate("told") == 0


def test_the_picture_is_a_file_of_its_own(look: Open, pages: dict[str, Path]) -> None:
    page = look("nutation-damper", color_scheme="dark")
    chart = Chart(page, "evolution-power")
    light = None
    for zoom in (False, True):
        if zoom:
            chart.drag(0.2, 0.6)
        name, content = chart.file("SVG")
        assert re.fullmatch(r"nutation-damper[a-z0-9-]*-evolution-power\.svg", name)
        root = ElementTree.fromstring(content)
        text = content.decode()
        svg = "{http://www.w3.org/2000/svg}"
        curves = [path for path in root.iter(f"{svg}path") if path.get("stroke") == "#0068a8"]
        words = [node.text for node in root.iter(f"{svg}text")]
        assert root.tag == f"{svg}svg" and len(curves) == 1 and len(curves[0].get("d", "")) > 50
        assert "%" not in re.sub(r"<(title|desc)>.*?</", "", text) and "class=" not in text and "var(" not in text and "em\"" not in text
        assert {"power", "t [s]", "power [W]", *chart.ticks()} <= set(words)
        assert text != light
        assert next(node for node in root.iter(f"{svg}text") if node.text == "t [s]").get("x") == "800"
        light = text
        x = [float(place.split(" ")[0]) for place in re.split("[ML]", curves[0].get("d", ""))[1:]]
        assert 0 <= min(x) < 20 and 780 < max(x) <= 800


def test_the_picture_in_pixels(look: Open) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "spin")
    name, content = chart.file("PNG")
    width, height = struct.unpack(">II", content[16:24])
    _, svg = chart.file("SVG")
    root = ElementTree.fromstring(svg)
    assert name.endswith("-spin.png") and content[:8] == b"\x89PNG\r\n\x1a\n"
    assert (width, height) == (2 * int(root.get("width", "")), 2 * int(root.get("height", "")))
    parts, at = b"", 8
    while at < len(content):
        (length,) = struct.unpack(">I", content[at : at + 4])
        if content[at + 4 : at + 8] == b"IDAT":
            parts += content[at + 8 : at + 8 + length]
        at += length + 12
    rows = np.frombuffer(zlib.decompress(parts), np.uint8).reshape(height, -1)[:, 1:]
    inked = (rows[height // 4 : height * 3 // 4] != 0).any(axis=0).mean()
    assert inked > 0.5, inked


def test_the_table_is_the_data(look: Open, pages: dict[str, Path]) -> None:
    page = look("nutation-damper")
    for name in ("spin", "energy", "evolution-nutation"):
        chart = Chart(page, name)
        data = data_of(pages["nutation-damper"], name)
        x, y = data["x"], data["y"]
        unit = f" [{y['unit']}]"
        for start, end in [(0, 1), (0.2, 0.5)]:
            if start:
                chart.drag(start, end)
            file, content = chart.file("CSV")
            head, *rows = csv.reader(io.StringIO(content.decode(), newline=""))
            assert file.endswith(f"-{name}.csv") and content.count(b"\r\n") == len(rows) + 1
            low, high = (x["low"] + part * (x["high"] - x["low"]) for part in (start, end))
            inside = [(s["x"] >= low - 0.005 * (high - low)) & (s["x"] <= high + 0.005 * (high - low)) for s in data["series"]]
            true = (lambda v: 10**v) if y["log"] else (lambda v: v * 10.0 ** y["power"])
            if len(data["grids"]) == 1:
                assert head == [f"t [{x['unit']}]", *(s["label"] + unit for s in data["series"])]
                found = {s["label"]: [(row[0], row[k + 1]) for row in rows] for k, s in enumerate(data["series"])}
            else:
                assert head == ["series", f"t [{x['unit']}]", f"{y['name']}{unit}"]
                found = {s["label"]: [row[1:] for row in rows if row[0] == s["label"]] for s in data["series"]}
            for series, near in zip(data["series"], inside):
                known = dict(zip(np.float32(series["x"][near]), true(series["y"][near])))
                got = found[series["label"]]
                assert abs(len(got) - near.sum()) <= (0.03 * near.sum() + 2 if start else 0)
                for t, value in got:
                    expected = known[min(known, key=lambda at: abs(at - float(t)))] if len(known) < 50 else known.get(np.float32(float(t)), np.nan)
                    if value and np.isfinite(expected):
                        assert float(value) == pytest.approx(expected, rel=1e-5, abs=1e-12)
            page.keyboard.press("Escape")


def test_hostile_labels_stay_text(look: Open) -> None:
    page = look("hostile")
    chart = Chart(page, "spin")
    chart.drag(0.2, 0.6)
    chart.hover(0.5)
    assert page.locator("img:not(#viewer-paper)").count() == 0
    assert chart.shown(".label")[0] and any("=cmd()" in words for words in chart.readout())
    name, svg = chart.file("SVG")
    assert re.fullmatch(r"[a-z0-9-]+\.svg", name) and len(name) < 150
    texts = [node.text for node in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]
    assert "=cmd()|' /C calc'!A0" in texts
    _, content = chart.file("CSV")
    rows = list(csv.reader(io.StringIO(content.decode(), newline="")))
    cells = {cell for row in rows for cell in row[:1]} | set(rows[0])
    assert any(cell.startswith("'=cmd()") for cell in cells) and any(cell.startswith("'@sum(a,b)") for cell in cells)
    assert not any(cell.startswith(("=", "+", "@")) for row in rows for cell in row)
    assert any(HOSTILE in cell for cell in cells)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_narrow_screen_holds_the_charts(look: Open, scheme: str) -> None:
    page = look("boom-satellite", viewport={"width": 320, "height": 640}, color_scheme=scheme, has_touch=True)
    chart = Chart(page, "spin")
    for _ in range(5):
        chart.drag(0.3, 0.5)
    chart.hover(0.4)
    assert chart.zoomed and page.evaluate("document.documentElement.scrollWidth") <= 320
    ticks = [node.bounding_box() for node in chart.box.locator(".part .tick.middle").all()]
    assert all(a["x"] + a["width"] < b["x"] for a, b in zip(ticks, ticks[1:]))


def test_paper_shows_the_whole(look: Open) -> None:
    page = look("nutation-damper")
    chart = Chart(page, "spin")
    static = chart.ticks()
    chart.drag(0.3, 0.5)
    assert chart.ticks() != static
    page.emulate_media(media="print")
    assert chart.ticks() == static
    for style in (".tools", ".over", ".readout", ".note"):
        assert chart.figure.locator(style).is_hidden(), style


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_bars_a_reader(look: Open, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    page = look("boom-satellite", color_scheme=scheme)
    chart = Chart(page, "spin")
    chart.drag(0.3, 0.33)
    chart.hover(0.4)
    found = axe.Axe().run(page).response["violations"]
    own = ("plotted", "chart", "over", "tools", "readout", "unseen")
    serious = [each for each in found if each["impact"] in ("serious", "critical") or any(name in node["html"][:200] for node in each["nodes"] for name in own)]
    assert not serious, [(each["id"], [node["html"][:120] for node in each["nodes"][:3]]) for each in serious]


def test_no_name_leaves_the_scripts(look: Open) -> None:
    page = look("nutation-damper")
    names = ["Chart", "Series", "Group", "Gestures", "groups", "startPlots", "ticksOf", "floats", "clamp"]
    assert page.evaluate("(names) => names.filter((name) => name in window)", names) == []
    assert page.evaluate("typeof startPlots + typeof Chart") == "undefinedundefined"


# Lengths of the data of the paths of a chart, each time that one is drawn.
DRAWN = """(chart) => {
  window.drawn = [];
  const note = (changes) => drawn.push(...changes.map(({ target }) => target.getAttribute("d").length));
  new MutationObserver(note).observe(chart, { subtree: true, attributes: true, attributeFilter: ["d"] });
}"""


def test_large_charts_follow_with_little_work(look: Open) -> None:
    """A key draws each path once, and only what is in view."""
    page = look("many", viewport={"width": 1000, "height": 1600})
    chart = Chart(page, "spin")
    chart.drag(0.1, 0.9)
    chart.box.evaluate(DRAWN)

    def press(*keys: str) -> list[int]:
        page.evaluate("drawn.length = 0")
        down = "(over, keys) => keys.forEach((key) => over.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true })))"
        chart.over.evaluate(down, list(keys))
        chart.settle()
        return list(page.evaluate("drawn"))

    paths = chart.box.locator(".part path").count()
    keys = ["+", "ArrowRight", "-", "ArrowLeft"]
    wide = press(*keys)
    assert paths == 4 * 3 and len(wide) == paths * len(keys)
    assert max(wide) < 4000 * len("L1234 1234") * 0.8
    assert len(press(*["+"] * 6)) == paths * 6
    near = press("+")
    assert len(near) == paths and 0 < max(near) < max(wide) / 10
