// Starts the viewer. Without WebGL2 the still picture stays, with a sentence.
const startViewer = () => {
  const source = byId("scene");
  if (!source || !byId("viewer")) return;
  const scene = JSON.parse(source.textContent);
  const canvas = byId("viewer-canvas");
  const gl = glContext(canvas);
  if (!gl) {
    byId("viewer-absent").textContent = "This browser does not offer WebGL2, so the body is shown as a still picture.";
    byId("viewer-absent").hidden = false;
    byId("viewer").classList.add("viewer-still");
  }
  let viewer = null;
  if (gl) {
    byId("viewer-live").hidden = false;
    byId("still")?.classList.add("viewer-replaced");
    canvas.setAttribute("aria-label", `${scene.name}, the body in motion`);
    viewer = new Viewer(scene, gl);
    byId("viewer-side").hidden = !viewer.polhode;
    for (const id of ["viewer-speed-control"]) byId(id).hidden = !viewer.track;
    bindControls(viewer);
    playInView(viewer);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => viewer.recolor());
  }
  if (scene.equations?.start && scene.principal) {
    const equations = scaledEquations(scene.equations);
    const track = viewer?.track ?? null;
    const panel = new Panel(scene, track, (frames) => viewer?.follow(frames ?? track));
    if (viewer) viewer.onTime = (part) => panel.mark(part);
  }
};

/** Plays by itself while in view, unless the reader wants no motion or has used the controls. */
const playInView = (viewer) => {
  if (!viewer.track || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  const live = byId("viewer-live");
  let touched = false;
  for (const event of ["pointerdown", "keydown"]) live.addEventListener(event, () => (touched = true), { once: true });
  new IntersectionObserver((entries) => {
    const seen = entries.some((entry) => entry.isIntersecting);
    if (touched && seen) return;
    viewer.clock.play(seen);
    viewer.redraw();
  }, { threshold: 0.2 }).observe(viewer.canvas);
};

startViewer();
