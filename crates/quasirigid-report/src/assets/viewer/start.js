// Starts the viewer where the browser can read the scene and draw it; elsewhere the still picture stays, with a sentence.
const startViewer = async () => {
  const lacks = (what) => {
    byId("viewer-absent").hidden = false;
    byId("viewer-absent").textContent = `The body is not drawn in motion: this browser has no ${what}. The picture and the curves below need none.`;
  };
  if (!canUnpack) return lacks("DecompressionStream");
  const scene = await unpacked(byId("scene"));
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
    lacks("WebGL2");
  }
  if (scene.equations && scene.principal) {
    const panel = new Panel(scene, viewer?.track ?? null, (frames) => viewer?.follow(frames ?? viewer.track));
    if (controls) controls.panel = panel;
  }
  performance.mark("quasirigid:viewer");
};
if (byId("scene")) startViewer();
