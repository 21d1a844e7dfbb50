// Magnifies the live view by wheel, two fingers or buttons. What is magnified is moved by dragging, or by arrow keys.
const MOST_ZOOM = 4;
const ZOOM_STEP = 1.25;   // of a button
// x and y: where the picture's left and upper edges are, in the view's widths and heights.
const zoom = { scale: 1, x: 0, y: 0 };

function showZoom() {
  const within = (at) => Math.min(0, Math.max(1 - zoom.scale, at));
  [zoom.x, zoom.y] = [within(zoom.x), within(zoom.y)];
  const is = zoom.scale > 1;
  $("picture").style.transform = is ? `translate(${100 * zoom.x}%, ${100 * zoom.y}%) scale(${zoom.scale})` : "";
  $("screen").classList.toggle("magnified", is);
  $("farther").disabled = !is;
  $("closer").disabled = zoom.scale >= MOST_ZOOM;
  write($("scale"), is ? `× ${decimals(zoom.scale, 1)}` : "");
}

function moveZoom(x, y) {
  zoom.x += x;
  zoom.y += y;
  showZoom();
}

// The place [x, y] of the view stays where it is.
function zoomTo(scale, [x, y] = [0.5, 0.5]) {
  const next = Math.min(MOST_ZOOM, Math.max(1, scale));
  const more = next / zoom.scale - 1;
  zoom.scale = next;
  moveZoom((zoom.x - x) * more, (zoom.y - y) * more);
}

const placeOf = ({ clientX, clientY }) => {
  const box = $("screen").getBoundingClientRect();
  return [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
};

$("closer").onclick = () => zoomTo(zoom.scale * ZOOM_STEP);
$("farther").onclick = () => zoomTo(zoom.scale / ZOOM_STEP);

$("screen").addEventListener("wheel", (event) => {
  if (page.hides) return;
  // Some browsers count lines of 40 pixels. Two fingers on a touchpad are a wheel with Ctrl, and turn it little.
  const turned = event.deltaY * (event.deltaMode === 0 ? 1 : 40) * (event.ctrlKey ? 5 : 1);
  const before = zoom.scale;
  zoomTo(before * 1.002 ** -turned, placeOf(event));
  // At either end the page scrolls on.
  if (zoom.scale !== before || event.ctrlKey) event.preventDefault();
}, { passive: false });

let held = null;       // where the mouse is that drags
let dragged = false;   // a click that ends a drag is none
$("screen").onmousedown = (event) => {
  dragged = false;
  held = event.button === 0 && zoom.scale > 1 ? placeOf(event) : null;
};
addEventListener("mousemove", (event) => {
  if (!held || (event.movementX === 0 && event.movementY === 0)) return;
  const [from, to] = [held, placeOf(event)];
  moveZoom(to[0] - from[0], to[1] - from[1]);
  held = to;
  dragged = true;
});
addEventListener("mouseup", () => { held = null; });

let fingers = [];   // where they were
const middleOf = (all) => {
  const mean = (side) => all.reduce((sum, one) => sum + one[side], 0) / all.length;
  return placeOf({ clientX: mean("clientX"), clientY: mean("clientY") });
};
const spreadOf = ([one, two]) => Math.max(1, Math.hypot(one.clientX - two.clientX, one.clientY - two.clientY));
function touch(event) {
  const now = [...event.targetTouches].map(({ clientX, clientY }) => ({ clientX, clientY }));
  const pinches = now.length === 2;
  const moves = event.type === "touchmove" && now.length === fingers.length && (pinches || zoom.scale > 1);
  if (moves) {
    const [from, to] = [fingers, now].map(middleOf);
    moveZoom(to[0] - from[0], to[1] - from[1]);
    if (pinches) zoomTo(zoom.scale * spreadOf(now) / spreadOf(fingers), to);
  }
  // One finger on what is not magnified scrolls the page, and a tap is a click.
  if (event.cancelable && (pinches || moves)) event.preventDefault();
  fingers = now;
}
for (const kind of ["touchstart", "touchmove", "touchend", "touchcancel"]) {
  $("screen").addEventListener(kind, touch, { passive: false });
}

const MOVES = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
$("picture").onkeydown = (event) => {
  const move = MOVES[event.key];
  if (!move || zoom.scale === 1) return;
  event.preventDefault();
  moveZoom(move[0] / 4, move[1] / 4);
};
showZoom();
