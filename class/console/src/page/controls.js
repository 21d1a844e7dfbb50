// What an instructor can ask for. A control shows what the student's program says, not what was pressed; while an order is
// under way it has three dots.
let echoes = 0;
const waiting = new Map();   // by the page's number: command, control, words, the hub's number, what follows

function order(command, words, control, then = () => {}) {
  if (page.opened === null) return;
  echoes += 1;
  if (!say({ say: "order", echo: echoes, student: page.opened, command })) {
    return write($("said"), tr("not_sent", { words }));
  }
  waiting.set(echoes, { command, control, words, number: null, then });
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
  if (order.command.do === "end") page.over = page.opened;
}

function refused(echo, why) {
  if (echo === null) return write($("said"), why[0].toUpperCase() + why.slice(1) + ".");
  done(echo, tr("refused", { why }));
}

function loseOrders() {
  for (const [echo, { command }] of [...waiting]) {
    // A program that was ended closes its connection, often before its last state is sent.
    done(echo, tr(command.do === "end" && page.over !== null ? "done" : "lost"));
  }
}

// What brings up a scene from its start, which takes a while, and loses what the student has done in this attempt.
const BEGIN = ["scene", "reset", "toggle"];
let confirmed = null;
function askFirst(title, { work = "", lesson = "" }, then) {
  confirmed = then;
  write($("lose-title"), title);
  write($("lose-what"), work);
  write($("lose-lesson"), lesson);
  askIn("lose", "lose-not");
}

// A browser focuses a dialog's first button. What Enter presses must do no harm.
function askIn(dialog, harmless) {
  $(dialog).showModal();
  $(harmless).focus();
}
$("lose-not").onclick = () => $("lose").close();
$("lose-now").onclick = () => {
  $("lose").close();
  confirmed?.();
};

function beginScene(command, words, control) {
  const begin = () => order(command, words, control);
  const { worked, attempt, step, choice } = page.state ?? {};
  // The lesson's own scene begins the lesson anew. Recordings with another scene are not graded.
  const leaves = step && (command.do === "toggle" || (command.do === "scene" && command.choice !== choice));
  if (!worked && !leaves) return begin();
  askFirst(words, { work: worked ? tr("at_work", { attempt }) : "", lesson: leaves ? tr("lesson_ends") : "" }, begin);
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

const toggle = (id, command, isOn, words) => {
  $(id).onclick = () => {
    const on = !isOn();
    order({ do: command, on }, words[Number(on)], $(id));
  };
};
toggle("pause", "pause", () => page.state?.controls.paused, [tr("resume"), tr("pause")]);
toggle("spare", "spare", () => page.state?.controls.spared, [tr("heard"), tr("muted")]);
$("reset").onclick = () => beginScene({ do: "reset" }, tr("from_start"), $("reset"));
$("other-order").onclick = () => beginScene({ do: "toggle" }, tr("other_order"), $("other-order"));
$("speed").onchange = () => {
  const rate = Number($("speed").value);
  order({ do: "slow-motion", rate }, tr("speed_is", { speed: $("speed").selectedOptions[0].textContent }), $("speed"));
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
  order({ do: "message", text }, tr("message"), event.submitter ?? $("message"), sent);
};
$("unsay").onclick = () => order({ do: "message", text: "" }, tr("taken_away"), $("unsay"));
function askEnd(title, what) {
  write($("sure-title"), title);
  write($("sure-what"), what);
  askIn("sure", "end-not");
}
$("end").onclick = () => askEnd(tr("end_question"), "");
$("end-not").onclick = () => $("sure").close();
$("end-now").onclick = () => {
  $("sure").close();
  if (page.opened === null) orderAll({ do: "end" }, tr("end_order")); else order({ do: "end" }, tr("end_order"), $("end"));
};

function showControls(state) {
  const controls = state.controls;
  for (const [echo, order] of waiting) {
    if (order.number === null || order.number > state.done) continue;
    order.then();
    done(echo, BEGIN.includes(order.command.do) && state.coming ? tr("prepared") : tr("done"));
  }
  $("coming").hidden = !state.coming;
  if (state.coming) write($("coming-scene"), tr("preparing", { scene: state.coming.scene }));
  const asked = state.coming ? state.coming.choice : state.choice;
  [...$("scenes").querySelectorAll("button")].forEach((button, choice) => {
    button.setAttribute("aria-pressed", choice === asked);
  });
  write($("pause"), tr(controls.paused ? "resume" : "pause"));
  $("pause").classList.toggle("on", controls.paused);
  $("spare").setAttribute("aria-pressed", controls.spared);
  const speed = $("speed");
  if (document.activeElement !== speed && !("waits" in speed.dataset)) {
    const options = [...speed.options];
    // A program that is too slow for its scene has speeds of its own.
    speed.value = options.find((option) => Math.abs(option.value - controls.rate) < 0.005)?.value ?? "";
  }
  const boils = known(controls.k_v) && page.is.k_v !== null;
  for (const part of $("set-k-v").querySelectorAll("input, button")) part.disabled = !boils || controls.ended;
  write($("k-v-now"), boils ? String(Number(controls.k_v.toPrecision(4))) : tr("no_boiling"));
  write($("shown"), controls.message || tr("nothing"));
  for (const part of $("controls").querySelectorAll("button, input, select")) {
    if (!part.closest("#set-k-v")) part.disabled = controls.ended;
  }
  // Only a scene of a pair has another order.
  if (!known(page.is.choices[state.choice]?.counterpart)) $("other-order").disabled = true;
  if (!controls.message) $("unsay").disabled = true;
  if (controls.ended) {
    write($("said"), tr("session_over"));
    page.over = page.opened;
    showSummary();
  }
}

// What stays of a session that is over.
function showSummary() {
  const state = page.state;
  if (!state || !$("summary").hidden) return;
  const attempts = count(Math.max(state.attempt, 1), "attempt");
  write($("summary-length"), tr("lasted", { time: seconds(state.time_s), attempts, scene: state.scene }));
  const { incidents_so_far: all, grave_so_far: grave } = state;
  const listed = state.incidents.length;
  write($("summary-incidents"), count(all, "incident") + (grave ? tr("of_grave", { number: grave }) : "") +
    (listed < all ? tr("listed_some", { number: listed }) : all ? tr("listed") : "."));
  write($("summary-recording"), page.is.replays ? tr("was_replay")
    : state.recording ? tr("recorded", { file: state.recording })
    : tr("not_recorded"));
  $("summary").hidden = false;
  for (const part of $("controls").querySelectorAll("button, input, select")) part.disabled = true;
  $("summary").scrollIntoView({ block: "nearest" });
}

const sentence = (one) => " " + (one.grave ? "⚠ " : "") + one.text;
function entries(list, said, mark = () => "") {
  const key = JSON.stringify(said);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...said.map((one) => {
    const item = make("li", "", mark(one));
    item.append(make("time", seconds(one.t_s)), sentence(one));
    return item;
  }));
}

// Incidents of earlier attempts stay, each attempt under its own heading, the present one first. The amount of one that is under way
// grows: then its text alone is written, so that the list stays where it was scrolled to.
function showIncidents({ attempt, scene, incidents }) {
  const key = JSON.stringify([attempt, scene, incidents.map((one) => ({ ...one, text: "" }))]);
  const list = $("incident-list");
  const numbers = [...new Set([...incidents.map((one) => one.attempt), attempt])].sort((a, b) => b - a);
  const listed = numbers.map((number) => incidents.filter((one) => one.attempt === number));
  if (list.dataset.key === key) {
    const items = list.querySelectorAll("li");
    return listed.flat().forEach((one, at) => write(items[at].lastChild, sentence(one)));
  }
  list.dataset.key = key;
  list.replaceChildren(...numbers.flatMap((number, at) => {
    const those = listed[at];
    const title = number === attempt ? tr("scene_now", { scene }) : those[0].scene;
    const items = make("ol");
    entries(items, those, (one) => one.grave ? "grave" : "");
    return [make("h4", tr("attempt", { number, scene: title })), those.length > 0 ? items : make("p", tr("none_so_far"), "small")];
  }));
}

function showState(state) {
  page.state = state;
  showControls(state);
  const { step, hints } = state;
  write($("step"), step ? stepText(step) : tr("no_procedure"));
  write($("points"), pointsText(state.points));
  $("progress").hidden = !step;
  if (step) Object.assign($("progress"), { max: Math.max(step.of, 1), value: Math.max(step.number - 1, 0) });
  entries($("hints"), hints);
  showIncidents(state);
  write($("incident-count"), String(state.incidents_of_attempt));
  write($("scene"), state.scene);
  write($("time"), seconds(state.time_s));
  addPoints(state);
}
