// What an instructor can ask for. A control shows what the student's program says, not what was pressed; while an order is
// under way it has three dots.
let echoes = 0;
const waiting = new Map();   // by the page's number: control, words, the hub's number, what follows

function order(command, words, control, then = () => {}) {
  if (page.opened === null) return;
  echoes += 1;
  if (!say({ say: "order", echo: echoes, student: page.opened, command })) {
    return write($("said"), `${words}: not sent, there is no connection.`);
  }
  waiting.set(echoes, { control, words, number: null, begins: BEGIN.includes(command.do), ends: command.do === "end", then });
  control.dataset.waits = "";
  write($("said"), `${words} …`);
}

function done(echo, end) {
  const order = waiting.get(echo);
  if (!order) return;
  waiting.delete(echo);
  if (![...waiting.values()].some((other) => other.control === order.control)) delete order.control.dataset.waits;
  write($("said"), order.words + end);
}

function ordered(echo, number) {
  const order = waiting.get(echo);
  if (!order) return;
  order.number = number;
  // Its last state may not come: the program ends with its session.
  if (order.ends) page.over = page.opened;
}

function refused(echo, why) {
  if (echo === null) return write($("said"), why[0].toUpperCase() + why.slice(1) + ".");
  done(echo, `: refused, ${why}.`);
}

function loseOrders() {
  for (const echo of [...waiting.keys()]) done(echo, ": the connection was lost; see below whether it was done.");
}

// What brings up a scene from its start, which takes a while, and loses what the student has done in this attempt.
const BEGIN = ["scene", "reset", "toggle"];
let confirmed = null;
function askFirst(title, what, then) {
  confirmed = then;
  write($("lose-title"), title);
  write($("lose-what"), what);
  $("lose").showModal();
}
$("lose-not").onclick = () => $("lose").close();
$("lose-now").onclick = () => {
  $("lose").close();
  confirmed?.();
};

function beginScene(command, words, control) {
  const begin = () => order(command, words, control);
  if (!page.state?.worked) return begin();
  askFirst(words, `The student is at work: attempt ${page.state.attempt} ends, and its flasks are lost.`, begin);
}

const KINDS = { correct: "✓ ", incorrect: "✗ ", other: "" };
function showScenes() {
  for (const part of document.querySelectorAll(".of-session")) part.hidden = page.is.replays;
  const legend = $("scenes").querySelector("legend");
  $("scenes").replaceChildren(legend, ...page.is.choices.map(({ title, kind }, choice) => {
    const button = make("button", KINDS[kind] + title);
    button.type = "button";
    button.onclick = () => beginScene({ do: "scene", choice }, title, button);
    return button;
  }));
  const range = page.is.k_v;
  if (range) Object.assign($("k-v"), { min: range.least, max: range.most });
}

const toggle = (id, command, words) => {
  $(id).onclick = () => {
    const on = $(id).getAttribute("aria-pressed") !== "true";
    order({ do: command, on }, words[Number(on)], $(id));
  };
};
toggle("pause", "pause", ["Go on", "Pause"]);
toggle("spare", "spare", ["Boiling heard again", "Boiling muted"]);
$("reset").onclick = () => beginScene({ do: "reset" }, "From the start", $("reset"));
$("other-order").onclick = () => beginScene({ do: "toggle" }, "The other order", $("other-order"));
$("speed").onchange = () => {
  const rate = Number($("speed").value);
  order({ do: "slow-motion", rate }, `Speed ${$("speed").selectedOptions[0].textContent}`, $("speed"));
};
$("set-k-v").onsubmit = (event) => {
  event.preventDefault();
  order({ do: "k-v", value: $("k-v").valueAsNumber }, `k_v ${$("k-v").value}`, event.submitter ?? $("k-v"));
};
$("send").onsubmit = (event) => {
  event.preventDefault();
  const text = $("message").value;
  // Until the student's program has it, it can be sent again.
  const sent = () => { if ($("message").value === text) $("message").value = ""; };
  order({ do: "message", text }, "Message", event.submitter ?? $("message"), sent);
};
$("unsay").onclick = () => order({ do: "message", text: "" }, "Message taken away", $("unsay"));
$("end").onclick = () => $("sure").showModal();
$("end-not").onclick = () => $("sure").close();
$("end-now").onclick = () => {
  $("sure").close();
  order({ do: "end" }, "End", $("end"));
};

function showControls(state) {
  const controls = state.controls;
  for (const [echo, order] of waiting) {
    if (order.number === null || order.number > state.done) continue;
    order.then();
    done(echo, order.begins && state.coming ? ": being prepared." : ": done.");
  }
  $("coming").hidden = !state.coming;
  if (state.coming) write($("coming-scene"), `Being prepared: ${state.coming.scene}. Until then the present scene goes on.`);
  const asked = state.coming ? state.coming.choice : state.choice;
  [...$("scenes").querySelectorAll("button")].forEach((button, choice) => {
    button.setAttribute("aria-pressed", choice === asked);
  });
  $("pause").setAttribute("aria-pressed", controls.paused);
  $("spare").setAttribute("aria-pressed", controls.spared);
  const speed = $("speed");
  if (document.activeElement !== speed && !("waits" in speed.dataset)) {
    const options = [...speed.options];
    // A program that is too slow for its scene has speeds of its own.
    speed.value = options.find((option) => Math.abs(option.value - controls.rate) < 0.005)?.value ?? "";
  }
  const boils = known(controls.k_v) && page.is.k_v !== null;
  for (const part of $("set-k-v").querySelectorAll("input, button")) part.disabled = !boils || controls.ended;
  write($("k-v-now"), boils ? String(Number(controls.k_v.toPrecision(4))) : "–, this scene has none");
  write($("shown"), controls.message || "nothing");
  for (const part of $("controls").querySelectorAll("button, input, select")) {
    if (!part.closest("#set-k-v")) part.disabled = controls.ended;
  }
  // Only a scene of a pair has another order.
  if (!known(page.is.choices[state.choice]?.counterpart)) $("other-order").disabled = true;
  if (!controls.message) $("unsay").disabled = true;
  if (controls.ended) {
    write($("said"), "The session is over.");
    page.over = page.opened;
    showSummary();
  }
}

// What stays of a session that is over.
function showSummary() {
  const state = page.state;
  if (!state || !$("summary").hidden) return;
  const count = (number, one) => `${number} ${one}${number === 1 ? "" : "s"}`;
  const attempts = Math.max(state.attempt, 1);
  write($("summary-length"), `It lasted ${seconds(state.time_s)} of simulated time, in ${count(attempts, "attempt")}; the last scene was: ${state.scene}.`);
  const grave = state.incidents.filter((incident) => incident.grave).length;
  write($("summary-incidents"), count(state.incidents_so_far, "incident") + (grave ? `, ${grave} of them grave` : "") +
    (state.incidents_so_far ? "; they are listed below." : "."));
  write($("summary-recording"), page.is.replays ? "It was a replay, which writes its own report."
    : state.recording ? `It is recorded on the student's computer in ${state.recording}`
    : "It was not recorded.");
  $("summary").hidden = false;
  for (const part of $("controls").querySelectorAll("button, input, select")) part.disabled = true;
  $("summary").scrollIntoView({ block: "nearest" });
}

function entries(list, said, mark = () => "") {
  const key = JSON.stringify(said);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...said.map((one) => {
    const item = make("li", "", mark(one));
    item.append(make("time", seconds(one.t_s)), " " + (one.grave ? "⚠ " : "") + one.text);
    return item;
  }));
}

// Incidents of earlier attempts stay, each attempt under its own heading, the present one first.
function showIncidents({ attempt, scene, incidents }) {
  const key = JSON.stringify([attempt, scene, incidents]);
  const list = $("incident-list");
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  const numbers = [...new Set([...incidents.map((one) => one.attempt), attempt])].sort((a, b) => b - a);
  list.replaceChildren(...numbers.flatMap((number) => {
    const those = incidents.filter((one) => one.attempt === number);
    const title = number === attempt ? `${scene} (now)` : those[0].scene;
    const items = make("ol");
    entries(items, those, (one) => one.grave ? "grave" : "");
    return [make("h4", `Attempt ${number}: ${title}`), those.length > 0 ? items : make("p", "None so far.", "small")];
  }));
}

function showState(state) {
  page.state = state;
  showControls(state);
  const { step, hints } = state;
  write($("step"), step ? (step.number > step.of ? `Done: ${step.title}` : `Step ${step.number} of ${step.of}: ${step.title}`) : "This scene has no procedure.");
  $("progress").hidden = !step;
  if (step) Object.assign($("progress"), { max: Math.max(step.of, 1), value: Math.max(step.number - 1, 0) });
  entries($("hints"), hints);
  showIncidents(state);
  write($("incident-count"), String(state.incidents_of_attempt));
  write($("scene"), state.scene);
  write($("time"), seconds(state.time_s));
  addPoints(state);
}
