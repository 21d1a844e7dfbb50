// Curves of the last minute, each with a table of the same.
const WINDOW = 60;           // s
const MOST_POINTS = 1500;    // of a curve: 20 a second, and some to spare
const DASHES = [[], [8, 4], [2, 3], [10, 3, 2, 3], [4, 4], [14, 4], [1, 5], [6, 2, 1, 2]];
const MILLILITRES = 1e6;     // of a cubic metre

const plots = [
  { title: tr("temperature"), digits: 1, free: true, of: (state) => state.readings.flasks.flatMap((flask) => [
    [tr("flask_hottest", { flask: flask.name }), flask.hottest_c], [tr("flask_mean", { flask: flask.name }), flask.mean_c]]) },
  { title: tr("superheat"), solver: true, digits: 1, of: (state) => [[tr("highest"), state.readings.superheat_k]] },
  { title: tr("void"), solver: true, digits: 1, of: (state) => [[tr("liquid"), percent(state.readings.void_fraction)]] },
  { title: tr("spilt"), digits: 1, of: (state) => [
    [tr("bench"), scaled(state.readings.bench_m3, MILLILITRES)], [tr("floor"), scaled(state.readings.floor_m3, MILLILITRES)]] },
  { title: tr("frame_time"), solver: true, digits: 2, of: (state) => [
    [tr("mean"), scaled(state.frames.mean_s, 1000)], [tr("longest"), scaled(state.frames.worst_s, 1000)],
    [tr("period"), scaled(state.frames.period_s, 1000)]], note: (state) => tr("missed", { number: state.frames.missed }) },
];
const scaled = (value, by) => known(value) ? value * by : null;
const percent = (value) => scaled(value, 100);

for (const plot of plots) {
  plot.curves = new Map();   // by name: points [time, value]
  const figure = make("figure");
  plot.caption = make("figcaption", plot.title);
  plot.canvas = make("canvas");
  plot.canvas.setAttribute("role", "img");
  plot.canvas.setAttribute("aria-label", tr("curves", { title: plot.title }));
  plot.keys = make("ul", "", "keys");
  plot.details = make("details");
  plot.table = make("div", "", "table");
  plot.details.append(make("summary", tr("as_table")), plot.table);
  plot.details.ontoggle = () => { dirty = true; };
  figure.append(plot.caption, plot.canvas, plot.keys, plot.details);
  $(plot.solver ? "solver-plots" : "plots").append(figure);
}
$("solver").ontoggle = () => { dirty = true; };

let dirty = false;
function forgetCurves() {
  for (const plot of plots) plot.curves.clear();
  dirty = true;
}

let plotted = null;   // scene of the curves: another one has other vessels
function addPoints(state) {
  if (state.scene !== plotted) forgetCurves();
  plotted = state.scene;
  const now = performance.now() / 1000;
  for (const plot of plots) {
    for (const [name, value] of plot.of(state)) {
      if (!plot.curves.has(name)) plot.curves.set(name, []);
      const points = plot.curves.get(name);
      points.push([now, value]);
      while (points.length > MOST_POINTS || points[0][0] < now - WINDOW) points.shift();
    }
    if (plot.note) write(plot.caption, `${plot.title}; ${plot.note(state)}`);
  }
  dirty = true;
}

// The canvas's pen, in CSS pixels.
function penOf(canvas) {
  const scale = devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  Object.assign(canvas, { width: Math.round(width * scale), height: Math.round(height * scale) });
  const pen = canvas.getContext("2d");
  pen.scale(scale, scale);
  return { pen, width, height };
}

// A step of 1, 2 or 5 times a power of ten, some four of which make `span`.
function stepOf(span) {
  const power = 10 ** Math.floor(Math.log10(span / 4));
  return power * ([1, 2, 5].find((step) => step * power * 5 >= span) ?? 10);
}

function drawPlot(plot, now) {
  const style = getComputedStyle(document.documentElement);
  const { pen, width, height } = penOf(plot.canvas);
  if (width === 0) return;
  const values = [...plot.curves.values()].flat().map(([, value]) => value).filter(known);
  let low = Math.min(0, ...values), high = Math.max(...values);
  // Of temperatures, 0 °C is none.
  if (plot.free && values.length) low = Math.min(...values);
  if (!(high - low > 1e-9)) high = low + 1;
  const step = stepOf(high - low);
  [low, high] = [Math.floor(low / step) * step, Math.ceil(high / step) * step];
  const [left, right, top, bottom] = [44, 6, 6, 18];
  const x = (time) => left + (1 - (now - time) / WINDOW) * (width - left - right);
  const y = (value) => top + (high - value) / (high - low) * (height - top - bottom);
  pen.font = "12px system-ui, sans-serif";
  pen.fillStyle = style.getPropertyValue("--faint");
  pen.strokeStyle = style.getPropertyValue("--line");
  pen.lineWidth = 0.5;
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (let value = low; value <= high + step / 2; value += step) {
    pen.fillText(String(Number(value.toPrecision(6))), left - 6, y(value));
    pen.beginPath();
    pen.moveTo(left, y(value));
    pen.lineTo(width - right, y(value));
    pen.stroke();
  }
  pen.textBaseline = "alphabetic";
  for (const ago of [60, 40, 20, 0]) {
    pen.textAlign = ago === 60 ? "left" : ago === 0 ? "right" : "center";
    pen.fillText(ago ? `−${ago} s` : tr("now"), x(now - ago), height - 4);
  }
  [...plot.curves.values()].forEach((points, at) => {
    stroke(pen, style, at);
    pen.beginPath();
    let on = false;
    for (const [time, value] of points) {
      if (!known(value)) { on = false; continue; }
      if (on) pen.lineTo(x(time), y(value)); else pen.moveTo(x(time), y(value));
      on = true;
    }
    pen.stroke();
  });
}

function stroke(pen, style, at) {
  pen.strokeStyle = style.getPropertyValue(`--c${at % 8}`);
  pen.setLineDash(DASHES[at % 8]);
  pen.lineWidth = 2;
}

function drawKeys(plot) {
  const style = getComputedStyle(document.documentElement);
  const names = [...plot.curves.keys()];
  if (plot.keys.children.length !== names.length) {
    plot.keys.replaceChildren(...names.map(() => {
      const item = make("li");
      item.append(make("canvas"), make("span"));
      return item;
    }));
  }
  names.forEach((name, at) => {
    const item = plot.keys.children[at];
    const last = plot.curves.get(name).at(-1)?.[1];
    write(item.lastChild, `${name}: ${digits(last, plot.digits)}`);
    const { pen, width, height } = penOf(item.firstChild);
    stroke(pen, style, at);
    pen.beginPath();
    pen.moveTo(0, height / 2);
    pen.lineTo(width, height / 2);
    pen.stroke();
  });
}

// The values of now, and of every five seconds before.
function drawTable(plot, now) {
  const table = make("table");
  const head = make("tr");
  head.append(make("th", tr("seconds_ago")), ...[...plot.curves.keys()].map((name) => make("th", name)));
  table.append(head);
  for (let ago = 0; ago <= WINDOW; ago += 5) {
    const row = make("tr");
    row.append(make("td", String(ago)));
    for (const points of plot.curves.values()) {
      const point = points.findLast(([time]) => time <= now - ago + 0.001);
      row.append(make("td", digits(point?.[1], plot.digits)));
    }
    table.append(row);
  }
  plot.table.replaceChildren(table);
}

// Ten times a second is enough, a table once.
let tables = 0;
function redraw() {
  if (dirty && !$("student").hidden) {
    dirty = false;
    const now = performance.now() / 1000;
    const withTables = now - tables >= 1;
    if (withTables) tables = now;
    for (const plot of plots) {
      drawPlot(plot, now);
      drawKeys(plot);
      if (plot.details.open && (withTables || !plot.table.firstChild)) drawTable(plot, now);
    }
  }
  setTimeout(() => requestAnimationFrame(redraw), 100);
}
addEventListener("resize", () => { dirty = true; });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { dirty = true; });

// The page begins.
showHiding();
showCardPictures();
redraw();
chooseCodec().then(begin);
