// The controls under the picture, and the words beside them.
const bindControls = (viewer) => {
  const words = (id, text) => {
    if (byId(id).textContent !== text) byId(id).textContent = text;
  };
  const rate = () => (viewer.now?.omega ? size(viewer.now.omega) : 0);
  const setSpeed = (speed) => {
    viewer.runClock.speed = clamp(speed, 1, 1e9);
    byId("viewer-speed").value = Math.log10(viewer.runClock.speed);
    viewer.redraw();
  };
  const setMagnified = (factor) => {
    viewer.magnified = factor;
    byId("viewer-magnified").value = Math.log10(factor);
    viewer.redraw();
  };
  const actions = {
    toggle: () => {
      viewer.clock.play(!viewer.clock.playing);
      viewer.redraw();
    },
    scrub: (part) => {
      viewer.clock.part = part;
      viewer.redraw();
    },
    look: (view) => {
      viewer.view = view;
      for (const radio of document.getElementsByName("viewer-view")) radio.checked = radio.value === view;
      viewer.redraw();
    },
    reset: () => {
      viewer.camera.reset();
      viewer.redraw();
    },
  };

  byId("viewer-play").addEventListener("click", actions.toggle);
  byId("viewer-scrub").addEventListener("input", (event) => actions.scrub(Number(event.target.value)));
  byId("viewer-reset").addEventListener("click", actions.reset);
  byId("viewer-speed").addEventListener("input", (event) => setSpeed(10 ** Number(event.target.value)));
  byId("viewer-speed-real").addEventListener("click", () => setSpeed(1));
  byId("viewer-speed-turn").addEventListener("click", () => setSpeed((2 * Math.PI) / (3 * rate())));
  byId("viewer-speed-whole").addEventListener("click", () => setSpeed((viewer.frames.end - viewer.frames.start) / 30));
  byId("viewer-magnified").addEventListener("input", (event) => setMagnified(10 ** Number(event.target.value)));
  for (const radio of document.getElementsByName("viewer-view")) radio.addEventListener("change", () => actions.look(radio.value));
  for (const name of ["spin", "momentum", "axes"]) {
    byId(`viewer-show-${name}`).addEventListener("change", (event) => {
      viewer.show[name] = event.target.checked;
      viewer.redraw();
    });
  }
  byId("viewer-amplitude").addEventListener("input", (event) => {
    viewer.amplitude = Number(event.target.value);
    viewer.redraw();
  });
  bindPointer(viewer);
  bindKeys(viewer, actions);
  fillLegend(viewer);
  fillMotions(viewer, setMagnified);

  /** Keeps the words and sliders in step with the picture. */
  const update = () => {
    const { clock, mode, frames } = viewer;
    words("viewer-play", clock.playing ? "Pause" : "Play");
    const scrub = byId("viewer-scrub");
    scrub.value = clock.part;
    const scale = timeUnit(clock.end - clock.start);
    const time = mode
      ? `${numeral(360 * clock.part, 3)}° of a period`
      : `${(clock.time / scale[0]).toFixed(2)} of ${inUnit(clock.end, scale, 4)}`;
    words("viewer-time", time);
    scrub.setAttribute("aria-valuetext", time);
    words("viewer-speed-words", speedWords(viewer.runClock.speed, rate()));
    byId("viewer-speed").setAttribute("aria-valuetext", byId("viewer-speed-words").textContent);
    const magnified = byId("viewer-magnified-words");
    words("viewer-magnified-words", viewer.magnified === 1 ? "as it is" : factorWords(viewer.magnified));
    byId("viewer-magnified").setAttribute("aria-valuetext", magnified.textContent);
    words("viewer-amplitude-words", numeral(viewer.amplitude, 2));
    byId("viewer-strobe").hidden = mode !== null || rate() * clock.step <= Math.PI;
    if (!clock.playing) words("viewer-state", stateWords(viewer, time));
    for (const name of ["momentum", "spin", "1", "2", "3"]) {
      const tag = byId(`viewer-tag-${name}`);
      const place = viewer.tags.find(([tagged]) => tagged === name)?.[1];
      tag.hidden = !place;
      if (place) [tag.style.left, tag.style.top] = place.map((part) => `${(100 * clamp(part, 0.02, 0.98)).toFixed(2)}%`);
    }
    if (frames && !mode) viewer.onTime?.(clock.part);
  };

  viewer.runClock = viewer.clock;
  viewer.onDraw = update;
  const largest = viewer.largestDisplacement();
  byId("viewer-magnified-control").hidden = !(largest > 0);
  setMagnified(largest > 0 ? Math.max(1, rounded((0.05 * viewer.radius) / largest)) : 1);
  byId("viewer-magnified").max = Math.max(2, Math.log10(viewer.magnified) + 2);
  byId("viewer-magnified").value = Math.log10(viewer.magnified);
  const start = viewer.frames?.frame(0);
  if (start && size(start.omega) > 0) setSpeed(rounded((2 * Math.PI) / (3 * size(start.omega))));
  return actions;
};

/** What the picture shows, in a sentence. */
const stateWords = ({ mode, now, scene }, time) => {
  if (mode) return `Small motion about the steady spin: ${mode.source.name}; ${mode.words()}.`;
  if (!now.omega) return "The body at rest.";
  const { moments, axes } = scene.principal ?? {};
  const circled = axes && (circlesGreatest(now.momentum, moments, axes) ? 2 : 0);
  const nutation = axes && angleBetween(now.momentum, times(Math.sign(dot(axes[circled], now.momentum)) || 1, axes[circled]));
  const angle = axes ? `, angular momentum ${angleWords(nutation)} from the axis of ${circled ? "greatest" : "least"} moment` : "";
  const lost = now.dissipated > 0 ? `, ${numeral(now.dissipated)} J dissipated` : "";
  return `${time}: spin ${numeral(size(now.omega))} rad/s${angle}${lost}.`;
};

/** Whether K circles the axis of greatest moment. */
const circlesGreatest = (momentum, moments, axes) => {
  const squares = axes.map((axis) => dot(axis, momentum) ** 2);
  return squares.reduce((sum, square, i) => sum + square * (1 / moments[i] - 1 / moments[1]), 0) <= 0;
};

const fillLegend = (viewer) => {
  const holder = byId("viewer-legend");
  for (const entry of viewer.legend) {
    const button = holder.appendChild(document.createElement("button"));
    button.type = "button";
    button.setAttribute("aria-pressed", "true");
    const swatch = button.appendChild(document.createElement("span"));
    swatch.className = "viewer-swatch";
    swatch.style.background = `var(${entry.color})`;
    button.append(entry.name);
    const light = (on) => () => {
      viewer.lit = on ? entry.pieces : null;
      viewer.redraw();
    };
    for (const [event, on] of [["pointerenter", true], ["pointerleave", false], ["focus", true], ["blur", false]]) {
      button.addEventListener(event, light(on));
    }
    button.addEventListener("click", () => {
      const hidden = !entry.pieces[0].hidden;
      for (const piece of entry.pieces) piece.hidden = hidden;
      button.setAttribute("aria-pressed", String(!hidden));
      viewer.redraw();
    });
  }
};

const fillMotions = (viewer, setMagnified) => {
  const list = byId("viewer-motion");
  byId("viewer-motion-control").hidden = viewer.modes.length === 0;
  list.append(new Option(viewer.track ? "the run" : "at rest", ""));
  viewer.modes.forEach((mode, i) => list.append(new Option(`mode: ${mode.source.name}`, String(i))));
  let usual = null;
  list.addEventListener("change", () => {
    const mode = list.value === "" ? null : viewer.modes[Number(list.value)];
    usual ??= viewer.magnified;
    viewer.choose(mode);
    setMagnified(mode ? mode.magnified : usual);
    if (!mode) usual = null;
    byId("viewer-amplitude-control").hidden = !mode;
    byId("viewer-speed-control").hidden = Boolean(mode);
    byId("viewer-side").hidden = Boolean(mode) || !viewer.polhode;
    byId("viewer-motion-words").textContent = mode ? mode.words() : "";
  });
};
