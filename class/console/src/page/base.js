// The document, and the socket to the hub.
// A text of the page's language, with its holes filled.
const tr = (key, holes = {}) => (TEXTS[key] ?? key).replace(/\{(\w+)\}/g, (_, hole) => holes[hole] ?? "");
// So many of a kind, one or more.
const count = (number, kind) => tr(kind + (number === 1 ? "_one" : "_more"), { number });
const $ = (id) => document.getElementById(id);
const make = (tag, text = "", mark = "") => {
  const made = document.createElement(tag);
  made.textContent = text;
  if (mark) made.className = mark;
  return made;
};
// Writes only what has changed, so that a screen reader does not read it again.
const write = (at, text) => { if (at.textContent !== text) at.textContent = text; };
const known = (value) => typeof value === "number";
// With the decimal mark of the page's language.
const decimals = (value, count) => value.toLocaleString(document.documentElement.lang,
  { minimumFractionDigits: count, maximumFractionDigits: count, useGrouping: false });
const digits = (value, count) => known(value) ? decimals(value, count) : "–";
const stepText = (step) => tr(step.number > step.of ? "step_done" : "step_title", step);
const pointsText = (points) => points ? tr("points", points) : "";
const seconds = (value) => known(value) ? decimals(value, 1) + " s" : "–";

const page = {
  socket: null,      // the open socket
  students: [],      // the class, as the hub tells it
  opened: null,      // number of the student that is open
  is: null,          // what that student's program is
  state: null,       // its last state
  codec: null,       // "h264" or "jpeg"
  over: null,        // number of the student whose session was ended from here
  told: undefined,   // the pictures that the hub was last asked for; undefined before the first request of a connection
  hides: sessionStorage.getItem("hides") === "yes",
  closeUp: false,    // the live view shows the glass from close by
  bare: kept("bare") === "yes",   // the class has no pictures
};

// What this browser keeps for the next time. One that keeps nothing throws.
function kept(key) {
  try { return localStorage.getItem(key); } catch { return null; }
}
function keep(key, value) {
  try { localStorage.setItem(key, value); } catch { /* Then it counts until the page is left. */ }
}

function say(message) {
  if (page.socket?.readyState !== WebSocket.OPEN) return false;
  page.socket.send(JSON.stringify(message));
  return true;
}

function show(id) {
  for (const main of document.querySelectorAll("main")) main.hidden = main.id !== id;
  $("session").hidden = id === "entry";
  $("to-class").hidden = id !== "student";
  const focused = document.activeElement;
  if (!focused || focused === document.body || focused.closest("[hidden]")) $(id).querySelector("h2").focus();
}

// Waits longer each time, up to five seconds. Where the session was ended, its program has ended too: the summary stays.
let patience = 250;
let retry = null;
let tries = 0;
function again() {
  if (page.over !== null) {
    showSummary();
    return write($("link"), tr("session_over"));
  }
  write($("link"), tr("no_connection"));
  retry = setTimeout(connect, patience);
  patience = Math.min(2 * patience, 5000);
}

async function connect() {
  clearTimeout(retry);
  tries += 1;
  const mine = tries;
  try {
    // A socket that is refused does not say why.
    const session = await fetch("session", { cache: "no-store" });
    // A code that was given meanwhile connects by itself.
    if (mine !== tries) return;
    if (session.status === 401) return ask();
    if (!session.ok) return again();
  } catch {
    return mine === tries ? again() : undefined;
  }
  const socket = new WebSocket(location.origin.replace("http", "ws") + "/socket");
  socket.binaryType = "arraybuffer";
  socket.onopen = () => {
    patience = 250;
    page.socket = socket;
    page.told = undefined;
    write($("link"), tr("connected"));
    tellPictures();
    if (page.opened === null) show("class"); else say({ say: "open", student: page.opened });
  };
  socket.onmessage = ({ data }) => typeof data === "string" ? hear(JSON.parse(data)) : receivePicture(data);
  socket.onclose = () => {
    page.socket = null;
    loseOrders();
    loseAsked();
    again();
  };
}

function hear(message) {
  switch (message.say) {
    case "class": return showClass(message.students, message.choices);
    case "opened": return showOpened(message.student, message.is);
    case "state": return message.student === page.opened && showState(message.state);
    case "ordered": return ordered(message.echo, message.number);
    case "ordered-all": return orderedAll(message.echo, message.given, message.refused);
    case "refused": return refused(message.echo, message.why);
    case "invited": return showInvitation(message);
  }
}

// The way in: the code of the address's fragment, which leaves the address at once, or one that is typed.
function ask(said = "") {
  write($("link"), "");
  write($("entry-said"), said);
  show("entry");
  $("code").focus();
}

async function enter(code) {
  clearTimeout(retry);
  tries += 1;
  page.over = null;
  let answer;
  try {
    answer = await fetch("enter", { method: "POST", body: code });
  } catch {
    return ask(tr("no_answer"));
  }
  if (answer.ok) { $("code").value = ""; return connect(); }
  if (answer.status === 429) return ask(tr("too_many", { seconds: answer.headers.get("retry-after") }));
  ask(tr("wrong_code"));
}

$("enter").onsubmit = (event) => {
  event.preventDefault();
  enter($("code").value);
};
$("leave").onclick = async () => {
  try { await fetch("leave", { method: "POST" }); } catch { /* The hub is gone, and the session with it. */ }
  location.reload();
};
$("invite").onclick = () => say({ say: "invite" });
$("invitation-close").onclick = () => $("invitation").close();

function showInvitation({ address, code, rows }) {
  const canvas = $("qr");
  canvas.width = canvas.height = rows.length;
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, rows.length, rows.length);
  pen.fillStyle = "#000";
  rows.forEach((row, y) => [...row].forEach((mark, x) => { if (mark === "#") pen.fillRect(x, y, 1, 1); }));
  write($("invitation-address"), address);
  write($("invitation-code"), code);
  $("invitation").showModal();
}

function begin() {
  const code = decodeURIComponent(location.hash.slice(1));
  if (!code) return connect();
  history.replaceState(null, "", location.pathname);
  enter(code);
}
// An address that is pasted into this tab changes only the fragment, and loads nothing.
addEventListener("hashchange", () => {
  if (page.socket?.readyState !== WebSocket.OPEN) return begin();
  history.replaceState(null, "", location.pathname);
  write($("link"), tr("connected_already"));
});
