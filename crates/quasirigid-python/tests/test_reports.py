"""The report in a browser: the body moves, the reduced equations run, and nothing leaves the page."""

from __future__ import annotations

import itertools
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES

from quasirigid import Model

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no Chromium or Chrome on this machine: the report was not opened in a browser")
playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: the report was not opened in a browser")

DRAWING = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
Open = Callable[..., Any]


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Reports of a stiff body, of a soft one, and of one with a name that would end the page's scripts."""
    folder = tmp_path_factory.mktemp("reports")
    made = {}
    for name, changes in {
        "boom-satellite": {"run.duration": "20 min"},
        "nutation-damper": {},
        "axial-mass": {},
        "friction-wheel": {"body.name": "</script><img src=x onerror=alert(1)>\"'&<b>"},
    }.items():
        made[name] = folder / f"{name}.html"
        Model.from_file(EXAMPLES / name / "model.toml").with_(changes).run().report(made[name])
    return made


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as tools:
        opened = tools.chromium.launch(executable_path=BROWSER, args=DRAWING)
        yield opened
        opened.close()


@pytest.fixture
def look(browser: Any, pages: dict[str, Path]) -> Iterator[Open]:
    """Opens a report, and checks at the end that it said nothing to the console and asked for no other file."""
    said: list[str] = []
    asked: list[str] = []
    opened = []

    def look(name: str, *, script: str = "", wait: bool = True, **options: Any) -> Any:
        page = browser.new_page(**{"viewport": {"width": 1000, "height": 900}, **options})
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        if script:
            page.add_init_script(script)
        page.goto(pages[name].as_uri())
        opened.append(page)
        if wait:
            until(page, "document.querySelector('#panel-work').textContent !== ''")
        return page

    yield look
    for page in opened:
        page.close()
    assert not said and set(asked) <= {path.as_uri() for path in pages.values()}, (said, asked)


def picture(page: Any) -> bytes:
    shot: bytes = page.locator("#viewer-canvas").screenshot()
    return shot


def until(page: Any, true: str) -> None:
    """Waits for an expression; the page's own policy forbids the driver to poll it."""
    for _ in range(200):
        if page.evaluate(true):
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never: {true}")


def paused(page: Any) -> None:
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    if page.locator("#viewer-play").inner_text() == "Pause":
        page.click("#viewer-play")
    until(page, "document.querySelector('#viewer-play').textContent === 'Play'")


def slide(page: Any, name: str, value: float) -> None:
    page.evaluate("([name, value]) => { const it = document.getElementById(name); it.value = value; it.dispatchEvent(new Event('input')); }", [name, value])


def test_the_body_moves_and_stops(look: Open) -> None:
    page = look("nutation-damper")
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    until(page, "document.querySelector('#viewer-play').textContent === 'Pause'")
    first = picture(page)
    page.wait_for_timeout(400)
    assert picture(page) != first
    paused(page)
    still = picture(page)
    page.wait_for_timeout(200)
    assert picture(page) == still
    slide(page, "viewer-scrub", 0.7)
    until(page, "document.querySelector('#viewer-time').textContent.startsWith('42 s')")
    assert picture(page) != still
    assert "|ω|" in page.inner_text("#viewer-state")


def test_every_control_changes_the_picture(look: Open) -> None:
    page = look("nutation-damper")
    paused(page)
    slide(page, "viewer-scrub", 0.2)

    def changes(act: Callable[[], Any]) -> None:
        before = picture(page)
        act()
        page.wait_for_timeout(150)
        assert picture(page) != before

    changes(lambda: page.check("input[name=viewer-view][value=body]"))
    changes(lambda: page.uncheck("#viewer-show-momentum"))
    changes(lambda: page.uncheck("#viewer-show-spin"))
    changes(lambda: page.uncheck("#viewer-show-axes"))
    changes(lambda: slide(page, "viewer-magnified", 1))
    changes(lambda: page.locator("#viewer-legend button").first.click())
    page.focus("#viewer-canvas")
    for key in ["ArrowLeft", "ArrowUp", "+", "-", "2", ".", "Shift+ArrowRight"]:
        changes(lambda key=key: page.keyboard.press(key))
    page.keyboard.press("r")
    page.keyboard.press(" ")
    until(page, "document.querySelector('#viewer-play').textContent === 'Pause'")
    box = page.locator("#viewer-canvas").bounding_box()
    page.keyboard.press(" ")

    def drag() -> None:
        page.mouse.move(box["x"] + 200, box["y"] + 200)
        page.mouse.down()
        page.mouse.move(box["x"] + 320, box["y"] + 240)
        page.mouse.up()

    changes(drag)
    page.select_option("#viewer-motion", label="mode 1: nutation")
    assert "rad/s in the body" in page.inner_text("#viewer-motion-words")
    first = picture(page)
    page.wait_for_timeout(300)
    assert picture(page) != first


def test_what_is_under_the_pointer_is_named(look: Open) -> None:
    page = look("boom-satellite")
    paused(page)
    box = page.locator("#viewer-canvas").bounding_box()
    found = set()
    for x, y in itertools.product(range(20, 90, 5), range(20, 90, 5)):
        page.mouse.move(box["x"] + box["width"] * x / 100, box["y"] + box["height"] * y / 100)
        if page.locator("#viewer-tip").is_visible():
            found.add(page.inner_text("#viewer-tip").split(":")[0])
    assert found & {"tip 1", "tip 2", "carrier"}


def test_sliders_integrate_the_equations(look: Open) -> None:
    page = look("boom-satellite")
    curve = "document.querySelector('#panel-angle path.viewer-ours').getAttribute('d')"
    for name, value in [("spin", -0.5), ("wobble", 40), ("stiffness", 0.4), ("damping", 0.5)]:
        before = page.evaluate(curve)
        slide(page, f"panel-{name}", value)
        until(page, f"{curve} !== {before!r}")
    assert "as in the run" not in page.inner_text("#panel-stiffness-words")
    assert "holds" in page.get_attribute("#panel", "class")
    slide(page, "panel-spin", 1)
    until(page, "document.querySelector('#panel').classList.contains('fails')")
    assert "do not hold" in page.inner_text("#panel-validity")
    page.click("#panel-reset")
    until(page, "document.querySelector('#panel').classList.contains('holds')")
    assert page.inner_text("#panel-spin-words") == "as in the run"


@pytest.mark.parametrize("name", ["boom-satellite", "axial-mass"])
def test_the_page_integrates_as_the_program(look: Open, pages: dict[str, Path], name: str) -> None:
    """States after fifty revolutions: the page's integrator against the program's at 1e-13."""
    text = pages[name].read_text()
    scripts = text[text.index('"use strict";') :]
    scripts = scripts[: scripts.index("if (byId(\"scene\")) startViewer();")]
    page = look(name)
    found = page.evaluate(
        f"""(() => {{ {scripts}
        const {{ equations }} = JSON.parse(byId("scene").textContent);
        const motion = new FreeMotion(scaledEquations(equations), 1e-13);
        motion.start(0, equations.start.K, equations.start.attitude);
        const start = motion.spin();
        const end = (100 * Math.PI) / size(start);
        motion.to(end, 1e7);
        return {{ start, end, t: motion.t, spin: motion.spin(), attitude: motion.attitude(), from: equations.start.attitude }};
        }})()"""
    )
    model = Model.from_file(EXAMPLES / name / "model.toml")
    start = np.array([found["start"]])
    history = model.simulate(initial=start, system="reduced", duration=found["end"], samples=2, tolerance=1e-13, order=3)
    assert (found["t"], found["from"]) == (found["end"], [1.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(found["spin"], history.angular_velocity[0, -1], rtol=0, atol=1e-9 * np.linalg.norm(start))
    same = np.sign(np.dot(found["attitude"], history.attitude[0, -1]))
    np.testing.assert_allclose(same * np.array(found["attitude"]), history.attitude[0, -1], rtol=0, atol=1e-9)


def test_a_hostile_name_stays_text(look: Open) -> None:
    page = look("friction-wheel")
    assert page.locator("img").count() == 0
    assert page.inner_text("h1") == "</script><img src=x onerror=alert(1)>\"'&<b>"
    assert page.locator("#panel-stiffness-control").is_hidden() and "rotors" in page.inner_text("#panel-fixed")


def test_without_webgl_the_curves_and_the_still_picture_stay(look: Open) -> None:
    page = look("boom-satellite", script="HTMLCanvasElement.prototype.getContext = () => null;")
    assert page.locator("#viewer-live").is_hidden() and "no WebGL2" in page.inner_text("#viewer-absent")
    assert page.locator("svg.sphere").is_visible()
    assert page.evaluate("document.querySelector('#panel-angle path.viewer-ours').getAttribute('d')")


def test_who_wants_no_motion_sees_none(look: Open) -> None:
    page = look("boom-satellite", reduced_motion="reduce")
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    page.wait_for_timeout(300)
    assert page.inner_text("#viewer-play") == "Play"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_narrow_screen_holds_the_page(look: Open, scheme: str) -> None:
    page = look("boom-satellite", viewport={"width": 320, "height": 640}, color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") <= 320
    assert page.locator("#viewer-canvas").bounding_box()["width"] <= 320


def test_paper_has_the_still_picture(look: Open) -> None:
    page = look("boom-satellite")
    page.emulate_media(media="print")
    assert page.locator("#viewer-canvas").is_hidden() and page.locator("svg.sphere").is_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_bars_a_reader(look: Open, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    page = look("boom-satellite", color_scheme=scheme, reduced_motion="reduce")
    found = axe.Axe().run(page).response["violations"]
    serious = [each for each in found if each["impact"] in ("serious", "critical")]
    assert not serious, [(each["id"], [node["html"][:120] for node in each["nodes"][:3]]) for each in serious]
