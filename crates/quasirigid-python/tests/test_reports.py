"""The report in a browser: the body moves, the reduced equations run, and nothing leaves the page."""

from __future__ import annotations

import base64
import itertools
import json
import shutil
import subprocess
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, program, until

from quasirigid import Model

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no Chromium or Chrome on this machine: the report was not opened in a browser")
playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: the report was not opened in a browser")

DRAWING = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
Open = Callable[..., Any]

ALONG_THE_SPIN = """
[carrier]
mass = 9
center_of_mass = [0, 0, 0]
inertia = [0.139, 0.108, 0.0458]
[material.laminate]
density = 1600
young = 1e11
poisson = 0.3
rheology = { kind = "kelvin-voigt", time = 1.4e-3 }
[section.tube]
shape = "tube"
radius = 0.004
thickness = 0.0003
[[beam]]
name = "boom"
nodes = { root = [0, 0, 0.183], tip = [0, 0, 1.683] }
lines = [["root", "tip"]]
section = "tube"
material = "laminate"
masses = [{ node = "tip", mass = 0.1 }]
attach = "root"
[initial]
wobble = { angle = "0.2 deg", rate = "5 rpm", mode = "long-axis" }
"""


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
        made[name] = folder / name / "report.html"
        Model.from_file(EXAMPLES / name / "model.toml").with_(changes).run().write(folder / name)
    for name, origin, change in [("large", "nutation-damper", enlarged), ("unstable", "boom-satellite", unstable)]:
        made[name] = with_scene(folder / origin, folder / name, change)
    return made


def with_scene(origin: Path, folder: Path, change: Callable[[Any], None]) -> Path:
    """The report of a copy of a record whose scene has been changed."""
    shutil.copytree(origin, folder)
    scene = json.loads((folder / "scene.json").read_text())
    change(scene)
    (folder / "scene.json").write_text(json.dumps(scene))
    subprocess.run([program(), "report", folder, "--quiet"], check=True)
    return folder / "report.html"


def packed(values: Any, kind: str) -> str:
    return base64.b64encode(np.asarray(values, dtype=kind).tobytes()).decode()


def whole(vectors: Any) -> dict[str, Any]:
    """Vectors as whole multiples of a unit."""
    unit = float(np.abs(vectors).max()) / 32767
    return {"unit": unit, "values": packed(np.round(vectors / unit), "<i2")}


def enlarged(scene: Any) -> None:
    """A membrane of ten thousand vertices with six modes in place of the body, in two thousand frames."""
    side, frames, modes = 100, 2000, range(6)
    x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side)))
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    cells = [corner, corner + 1, corner + side, corner + 1, corner + side + 1, corner + side]
    wave = [np.sin((m % 3 + 1) * np.pi * (x + 1) / 2) * np.sin((m // 3 + 1) * np.pi * (y + 1) / 2) for m in modes]
    upwards = [np.stack([0 * x, 0 * x, w], axis=-1) for w in wave]
    scene["radius"] = 1.5
    scene["coordinates"] = [{"name": f"mode {m}", "unit": "m"} for m in modes]
    scene["pieces"] = [
        {
            "name": "membrane",
            "kind": "panel",
            "vertices": whole(np.stack([x, y, 0.1 * (1 - x * x) * (1 - y * y)], axis=-1)),
            "triangles": packed(np.stack(cells, axis=-1), "<u2"),
            "lines": None,
            "size": None,
            "fields": [{"coordinate": m, "vectors": whole(upwards[m])} for m in modes],
            "turning": None,
        }
    ]
    scene["modes"] = []
    track = scene["track"]
    rows = np.linspace(0, len(base64.b64decode(track["t"])) // 8 - 1, frames)
    for key, kind, width in [("attitude", "<f4", 4), ("omega", "<f4", 3), ("momentum", "<f4", 3), ("dissipated", "<f8", 1)]:
        known = np.frombuffer(base64.b64decode(track[key]), kind).reshape(-1, width)
        track[key] = packed(known[rows.round().astype(int)], kind)
    track["t"] = packed(rows * scene["equations"]["start"]["duration"] / rows[-1], "<f8")
    track["q"] = packed([[0.01 * np.sin(0.01 * (m + 1) * i) for m in modes] for i in range(frames)], "<f4")
    scene["equations"]["displacements"] = []


def unstable(scene: Any) -> None:
    """Terms so large that the equations have no solution for long."""
    for term in scene["equations"]["energy_gradient"]:
        if term["degree"] > 1:
            term["values"] = [[1e300 * value for value in row] for row in term["values"]]


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


def until_another_picture(page: Any, before: bytes) -> None:
    for _ in range(400):
        if picture(page) != before:
            return
        page.wait_for_timeout(50)
    pytest.fail("the picture stays as it is")


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
    until_another_picture(page, picture(page))
    paused(page)
    still = picture(page)
    page.wait_for_timeout(200)
    assert picture(page) == still
    slide(page, "viewer-scrub", 0.7)
    until(page, "document.querySelector('#viewer-time').textContent.startsWith('42 s')")
    until_another_picture(page, still)
    assert "|ω|" in page.inner_text("#viewer-state")


def test_every_control_changes_the_picture(look: Open) -> None:
    page = look("nutation-damper")
    paused(page)
    slide(page, "viewer-scrub", 0.2)

    def changes(act: Callable[[], Any]) -> None:
        before = picture(page)
        act()
        until_another_picture(page, before)

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
    until_another_picture(page, picture(page))


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


def test_arrows_hide_no_boom_along_the_spin(browser: Any, tmp_path: Path) -> None:
    read = pytest.importorskip("matplotlib.image").imread
    Model(ALONG_THE_SPIN).run(duration=60).write(tmp_path / "along")
    page = browser.new_page(viewport={"width": 1000, "height": 900})
    page.goto((tmp_path / "along" / "report.html").as_uri())
    paused(page)
    shown = read(BytesIO(picture(page)))
    page.uncheck("#viewer-show-momentum")
    page.uncheck("#viewer-show-spin")
    page.wait_for_timeout(150)
    changed = np.abs(read(BytesIO(picture(page))) - shown).max(axis=-1) > 0.1
    rows = np.flatnonzero(changed.any(axis=1))
    page.close()
    assert 0.05 * len(shown) < np.ptp(rows) < 0.25 * len(shown), "the boom is a third of the picture high"


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
    slide(page, "panel-damping", 2)
    until(page, "document.querySelector('#panel').classList.contains('fails')")
    slide(page, "panel-stiffness", 2)
    until(page, "document.querySelector('#panel').classList.contains('holds')")
    page.click("#panel-reset")
    assert page.inner_text("#panel-spin-words") == "as in the run"


def momentum_with(reduced: Any, spin: Any) -> Any:
    """Angular momentum with an angular velocity in the energy form: the inertia corrects an estimate."""
    K = reduced.angular_momentum(spin)
    for _ in range(100):
        K = K + reduced.inertia @ (spin - reduced.angular_velocity(K))
    return K


@pytest.mark.parametrize("name", ["boom-satellite", "nutation-damper", "axial-mass"])
def test_the_page_integrates_as_the_program(look: Open, pages: dict[str, Path], name: str) -> None:
    """States over fifty revolutions: the page's integrator against the program's at 1e-13."""
    text = pages[name].read_text()
    model = Model.from_file(EXAMPLES / name / "model.toml")
    rate = np.linalg.norm(model.simulate(system="reduced", duration=1, samples=2, order=3).angular_velocity[0])
    history = model.simulate(system="reduced", duration=100 * np.pi / rate, samples=51, tolerance=1e-13, order=3)
    spin, attitude = np.array(history.angular_velocity), np.array(history.attitude)
    K = momentum_with(model.reduce(3), spin[0])
    scripts = text[text.rindex('"use strict";') :]
    scripts = scripts[: scripts.index("if (byId(\"scene\")) startViewer();")]
    states = look(name).evaluate(
        f"""async (start) => {{ {scripts}
        const [K, attitude, moments] = start;
        const motion = new FreeMotion(scaledEquations((await unpacked(byId("scene"))).equations), 1e-13);
        motion.start(0, K, attitude);
        return moments.map((t) => {{
          motion.to(t);
          return {{ spin: motion.spin(), attitude: motion.attitude(), dissipated: motion.dissipated() }};
        }});
        }}""",
        [list(K), list(attitude[0]), list(history.t)],
    )
    found = {key: np.array([state[key] for state in states]) for key in ("spin", "attitude", "dissipated")}
    np.testing.assert_allclose(found["spin"], spin, rtol=0, atol=1e-9 * rate)
    same = np.sign(np.sum(found["attitude"] * attitude, axis=-1, keepdims=True))
    np.testing.assert_allclose(same * found["attitude"], attitude, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found["dissipated"], history.dissipated, rtol=1e-9, atol=1e-9 * history.dissipated[-1])


@pytest.mark.parametrize("slowness", [1, 300])
def test_the_sliders_move_the_body_too(look: Open, slowness: int) -> None:
    """On a slow machine too, where the first pictures show a run's beginning, and its end may never come."""
    slow = f"const real = performance.now.bind(performance); performance.now = () => {slowness} * real();"
    page = look("boom-satellite", script=slow, reduced_motion="reduce")
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    slide(page, "viewer-scrub", 0.4)
    page.wait_for_timeout(200)
    before = picture(page), page.inner_text("#viewer-state")
    slide(page, "panel-wobble", 60)
    until(page, f"document.querySelector('#viewer-state').textContent !== {before[1]!r}")
    until_another_picture(page, before[0])
    page.click("#panel-reset")
    until(page, f"document.querySelector('#viewer-state').textContent === {before[1]!r}")


def test_curves_of_both_axes_and_of_the_full_equations(look: Open) -> None:
    page = look("nutation-damper")
    angles = "[...document.querySelectorAll('#panel-angle .tick[text-anchor=end]')].map((tick) => Number(tick.textContent))"
    assert "full equations" in page.inner_text("#panel-theirs")
    assert page.locator("#panel-angle .viewer-curve").count() == 2
    assert 1 <= max(page.evaluate(angles)) <= 2
    page.select_option("#panel-axis", "0")
    until(page, f"{angles}.includes(50)")
    assert float(page.inner_text("#panel-wobble-words").rstrip("°")) > 80


def test_equations_without_a_solution_say_so(look: Open) -> None:
    page = look("unstable")
    until(page, "document.querySelector('#panel-work').textContent.startsWith('Broken off')")
    assert "fails" in page.get_attribute("#panel", "class")


def test_fast_rotation_is_called_stroboscopic(look: Open) -> None:
    page = look("boom-satellite")
    paused(page)
    assert page.locator("#viewer-strobe").is_hidden()
    slide(page, "viewer-speed", 2.5)
    page.click("#viewer-play")
    until(page, "!document.querySelector('#viewer-strobe').hidden")


def test_ten_thousand_vertices_fit_and_move(look: Open, pages: dict[str, Path]) -> None:
    assert pages["large"].stat().st_size < 1_000_000
    page = look("large", script=CLOCK)
    page.locator("#viewer-canvas").scroll_into_view_if_needed()
    until(page, "document.querySelector('#viewer-play').textContent === 'Pause'")
    until_another_picture(page, picture(page))
    page.wait_for_timeout(1500)
    spent = sorted(page.evaluate("spent"))
    print(f"script of a frame: median {spent[len(spent) // 2]:.1f} ms, greatest {spent[-1]:.1f} ms")


# Milliseconds that each frame's script takes.
CLOCK = """
window.spent = [];
const request = window.requestAnimationFrame;
window.requestAnimationFrame = (draw) => request((now) => {
  const from = performance.now();
  draw(now);
  spent.push(performance.now() - from);
});
"""


def test_a_hostile_name_stays_text(look: Open) -> None:
    page = look("friction-wheel")
    assert page.locator("img:not(#viewer-paper)").count() == 0
    assert page.inner_text("h1") == "</script><img src=x onerror=alert(1)>\"'&<b>"
    assert page.locator("#panel-stiffness-control").is_hidden() and "rotors" in page.inner_text("#panel-fixed")


def test_without_webgl_the_curves_and_the_still_picture_stay(look: Open) -> None:
    page = look("boom-satellite", script="HTMLCanvasElement.prototype.getContext = () => null;")
    assert page.locator("#viewer-live").is_hidden() and "no WebGL2" in page.inner_text("#viewer-absent")
    assert page.locator("svg.sphere").is_visible()
    assert page.evaluate("document.querySelector('#panel-angle path.viewer-ours').getAttribute('d')")


def test_without_inflation_the_still_picture_and_the_figures_stay(look: Open) -> None:
    page = look("boom-satellite", script="delete window.DecompressionStream;", wait=False)
    assert page.locator("#viewer-live").is_hidden() and page.locator("#panel").is_hidden()
    assert "no DecompressionStream" in page.inner_text("#viewer-absent")
    assert page.locator("svg.sphere").is_visible() and page.locator("#spin-title").count() == 1
    assert page.locator("figure .plot path.curve").first.get_attribute("d") and page.locator(".over").count() == 0


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


def test_paper_has_the_body_as_it_was_shown(look: Open) -> None:
    page = look("boom-satellite")
    assert page.locator("#viewer-paper").is_hidden()
    assert len(page.pdf()) > 10_000
    assert page.locator("#viewer-paper").get_attribute("src").startswith("data:image/png;base64,")
    page.emulate_media(media="print")
    assert page.locator("#viewer-paper").is_visible() and page.locator("#viewer-controls, .viewer-transport").first.is_hidden()
    drawn = page.evaluate("""async () => {
        const image = byId("viewer-paper"), canvas = document.createElement("canvas");
        await image.decode();
        Object.assign(canvas, { width: image.naturalWidth, height: image.naturalHeight });
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
        return new Set(Array.from({ length: data.length / 4 }, (_, i) => data.slice(4 * i, 4 * i + 3).join())).size;
    }""".replace("byId(", "document.getElementById("))
    assert drawn > 20, "a body, not a blank"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_bars_a_reader(look: Open, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    page = look("boom-satellite", color_scheme=scheme, reduced_motion="reduce")
    found = axe.Axe().run(page).response["violations"]
    serious = [each for each in found if each["impact"] in ("serious", "critical")]
    assert not serious, [(each["id"], [node["html"][:120] for node in each["nodes"][:3]]) for each in serious]


def test_the_moving_picture_moves_in_a_page_and_rests_for_who_asks(browser: Any, tmp_path: Path) -> None:
    """``plot --figure motion`` in an image, and opened by itself with less motion asked for."""
    Model.from_file(EXAMPLES / "axial-mass" / "model.toml").run(tmp_path / "run", duration="2 min", samples=2001)
    call = [program(), "plot", tmp_path / "run", "--figure", "motion", "--out", tmp_path / "motion.svg", "--quiet"]
    subprocess.run(call, check=True)
    (tmp_path / "page.html").write_text('<img src="motion.svg" alt="">')

    def shots(name: str, **options: Any) -> list[bytes]:
        page = browser.new_page(viewport={"width": 900, "height": 520}, **options)
        page.goto((tmp_path / name).as_uri())
        found = []
        for _ in range(3):
            page.wait_for_timeout(600)
            found.append(page.screenshot())
        page.close()
        return found

    assert len(set(shots("page.html"))) == 3
    assert len(set(shots("motion.svg", reduced_motion="reduce"))) == 1
