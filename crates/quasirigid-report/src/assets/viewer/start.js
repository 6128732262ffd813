// Starts the viewer where the browser can draw it; elsewhere the still picture stays, with a sentence.
const startViewer = () => {
  const scene = JSON.parse(byId("scene").textContent);
  const gl = glContext(byId("viewer-canvas"));
  let controls = null;
  let viewer = null;
  if (gl) {
    byId("viewer-live").hidden = false;
    viewer = new Viewer(scene, gl);
    controls = new Controls(viewer);
    addEventListener("beforeprint", () => {
      viewer.draw();
      Object.assign(byId("viewer-paper"), { src: viewer.canvas.toDataURL(), hidden: false });
    });
  } else {
    byId("viewer-absent").hidden = false;
    byId("viewer-absent").textContent = "The body is not drawn in motion: this browser has no WebGL2. The picture and the curves below need none.";
  }
  if (!scene.equations || !scene.principal) return;
  const panel = new Panel(scene, viewer?.track ?? null, (frames) => viewer?.follow(frames ?? viewer.track));
  if (controls) controls.panel = panel;
};
if (byId("scene")) startViewer();
