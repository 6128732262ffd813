// Keys of the viewer. Those of sliders, lists and buttons stay theirs.
const STEP_IN_TIME = 0.01; // of the run

const bindKeys = (viewer, actions) => {
  const { camera, canvas } = viewer;
  const turn = (azimuth, elevation) => () => camera.turn(azimuth, elevation);
  const step = (sign) => () => actions.scrub(viewer.clock.part + sign * STEP_IN_TIME);
  const anywhere = {
    "1": () => actions.look("body"),
    "2": () => actions.look("inertial"),
    "+": () => camera.closer(1.15),
    "=": () => camera.closer(1.15),
    "-": () => camera.closer(1 / 1.15),
    ",": step(-1),
    ".": step(1),
    r: actions.reset,
    R: actions.reset,
  };
  const onPicture = {
    ArrowLeft: turn(-0.1, 0),
    ArrowRight: turn(0.1, 0),
    ArrowUp: turn(0, 0.1),
    ArrowDown: turn(0, -0.1),
  };
  const shifted = { ArrowLeft: step(-1), ArrowRight: step(1) };
  byId("viewer-live").addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.tagName === "SELECT") return;
    const onCanvas = event.target === canvas;
    const pressed = event.key === " " && !["BUTTON", "INPUT"].includes(event.target.tagName);
    const spaceOnSlider = event.key === " " && event.target.type === "range";
    const action =
      pressed || spaceOnSlider
        ? actions.toggle
        : anywhere[event.key] ?? (onCanvas ? (event.shiftKey ? shifted : onPicture)[event.key] : undefined);
    if (!action) return;
    event.preventDefault();
    action();
    viewer.redraw();
  });
};
