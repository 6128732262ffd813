// Mouse, pen and touch on the picture: one pointer turns it, two zoom, a hovering one names what is under it.
const TURN = 0.008; // rad per pixel
const bindPointer = (viewer) => {
  const { canvas, camera } = viewer;
  const down = new Map();
  const tip = byId("viewer-tip");

  const spread = () => {
    const [a, b] = [...down.values()];
    return { gap: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  };
  const drag = (event) => {
    const before = down.size === 2 ? spread() : down.get(event.pointerId);
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = down.size === 2 ? spread() : down.get(event.pointerId);
    camera.turn(TURN * (after.x - before.x), TURN * (after.y - before.y));
    if (down.size === 2 && before.gap > 0) camera.closer(after.gap / before.gap);
    viewer.redraw();
  };
  const hover = (event) => {
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const found = viewer.under(x / box.width, y / box.height);
    tip.hidden = !found;
    if (!found) return;
    const moved = found.displacement > 0 ? `, displaced by ${lengthWords(found.displacement)}` : "";
    tip.textContent = `${found.piece.name}${moved}`;
    tip.style.left = `${clamp(x + 14, 0, Math.max(0, box.width - tip.offsetWidth - 4))}px`;
    tip.style.top = `${clamp(y + 16, 0, box.height - tip.offsetHeight)}px`;
  };
  const release = (event) => {
    down.delete(event.pointerId);
    canvas.classList.toggle("viewer-held", down.size > 0);
  };

  canvas.addEventListener("pointerdown", (event) => {
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    canvas.setPointerCapture(event.pointerId);
    canvas.classList.add("viewer-held");
    tip.hidden = true;
  });
  canvas.addEventListener("pointermove", (event) => (down.has(event.pointerId) ? drag(event) : hover(event)));
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", () => (tip.hidden = true));
  // The wheel scrolls the page until the picture has been clicked.
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      camera.closer(Math.exp(-0.0015 * event.deltaY));
      viewer.redraw();
    },
    { passive: false },
  );
};
