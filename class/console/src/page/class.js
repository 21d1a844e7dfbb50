// The class at a glance, those first who need help.
function need(student) {
  if (!student.here) return -1;
  return (student.grave ? 1e6 : 0) + student.incidents;
}

const cards = new Map();   // by the student's number: its item of the list
function newCard(number) {
  const button = make("button");
  button.type = "button";
  button.dataset.student = number;
  const picture = make("canvas");
  picture.hidden = true;
  picture.setAttribute("aria-hidden", "true");
  button.append(make("strong"), ...Array.from({ length: 6 }, () => make("span")), picture);
  button.onclick = () => open(number);
  const item = make("li");
  item.append(button);
  return item;
}

// A card is written and not made anew: a click on a part that has been replaced since it was pressed is lost.
function card(student) {
  if (!cards.has(student.student)) cards.set(student.student, newCard(student.student));
  const item = cards.get(student.student);
  const button = item.firstChild;
  button.classList.toggle("troubled", student.incidents > 0);
  const lines = [
    student.here ? student.scene || "–" : tr("not_connected"),
    student.step ? stepText(student.step) : "",
    pointsText(student.points),
    known(student.hottest_c) ? tr("hottest", { temperature: decimals(student.hottest_c, 1) }) : "",
    student.paused ? tr("paused") : "",
    student.incidents > 0 ? `⚠ ${count(student.incidents, "incident")}: ${student.gravest ?? ""}` : "",
  ];
  [student.name, ...lines].forEach((line, at) => {
    write(button.children[at], line);
    button.children[at].hidden = !line;
  });
  if (!student.here) button.querySelector("canvas").hidden = true;
  return item;
}

// A card's picture, behind the student's number. It is taken away where the next three, which are 4 s apart, have not come.
const OLD = 15000;   // ms
async function receiveCard(head) {
  const number = head.getUint32(4, true);
  const canvas = cards.get(number)?.querySelector("canvas");
  const isShown = () => !page.bare && page.opened === null;
  if (!canvas || !isShown()) return;
  try {
    const image = await createImageBitmap(new Blob([new Uint8Array(head.buffer, 8)], { type: "image/jpeg" }));
    // A class in which the student has left may have come before the picture, or while it was decoded.
    if (isShown() && page.students.some((student) => student.student === number && student.here)) {
      Object.assign(canvas, { width: image.width, height: image.height, hidden: false });
      canvas.getContext("2d").drawImage(image, 0, 0);
      canvas.dataset.drawn = performance.now();
    }
    image.close();
  } catch { /* A broken one is left out. */ }
}
setInterval(() => {
  for (const canvas of $("students").querySelectorAll("canvas")) {
    if (performance.now() - canvas.dataset.drawn > OLD) canvas.hidden = true;
  }
}, 1000);

// A class on a screen that all see may be shown without pictures. Then none is asked for.
function showCardPictures() {
  $("card-pictures").setAttribute("aria-pressed", !page.bare);
  if (!page.bare) return;
  for (const canvas of $("students").querySelectorAll("canvas")) canvas.hidden = true;
}
$("card-pictures").onclick = () => {
  page.bare = !page.bare;
  keep("bare", page.bare ? "yes" : "no");
  showCardPictures();
  tellPictures();
};

// What is pressed stays where it is until it is let go.
function showCards(pressed) {
  const list = $("students");
  for (const [number, item] of cards) {
    if (page.students.some((student) => student.student === number)) continue;
    item.remove();
    cards.delete(number);
  }
  const focused = document.activeElement;
  [...page.students].sort((one, other) => need(other) - need(one)).map(card).forEach((item, at) => {
    const there = list.children[at];
    if (item !== there && !(pressed && item.isConnected)) list.insertBefore(item, pressed ? null : there ?? null);
  });
  // A card that has moved has lost the focus.
  if (focused !== document.activeElement && list.contains(focused)) focused.focus();
}
$("students").onclick = () => showCards(false);

function showClass(students, choices) {
  const first = page.students.length === 0;
  page.students = students;
  showAll(students, choices);
  $("empty").hidden = students.length > 0;
  showCards($("students").matches(":active"));
  showName();
  // One headset is no class.
  if (first && students.length === 1 && page.opened === null) open(students[0].student);
}

function showName() {
  const student = page.students.find((student) => student.student === page.opened);
  if (student) write($("name"), student.name + (student.here ? "" : ` (${tr("not_connected")})`));
  if (student && !student.here && page.over === page.opened) showSummary();
}

function open(student) {
  if (!say({ say: "open", student })) return;
  page.opened = student;
  tellPictures();
}

$("to-class").onclick = () => {
  page.opened = page.is = page.state = page.over = null;
  // First, so that no card's picture is asked for where the class has none.
  tellPictures();
  say({ say: "close" });
  forgetPicture();
  show("class");
  if (!page.socket) connect();
};

let curvesOf = null;
function showOpened(student, is) {
  page.opened = student;
  page.is = is;
  page.state = page.over = null;
  $("summary").hidden = true;
  forgetPicture();
  showCamera();
  tellPictures();
  // A student that was lost for a moment keeps its curves.
  if (curvesOf !== student) {
    forgetCurves();
    zoomTo(1);
  }
  curvesOf = student;
  loseOrders();
  showScenes();
  showName();
  show("student");
}

// What is asked of all. How many students it went to is said, and each one's card shows what came of it.
const asked = new Map();   // by the page's number: words, and what follows
function orderAll(command, words, then = () => {}) {
  echoes += 1;
  if (!say({ say: "order-all", echo: echoes, command })) {
    return write($("all-said"), tr("not_sent", { words }));
  }
  asked.set(echoes, { words, then });
  write($("all-said"), `${words} …`);
}

function orderedAll(echo, given, refused) {
  const order = asked.get(echo);
  if (!order) return;
  asked.delete(echo);
  const students = count(given, "student");
  const { words } = order;
  write($("all-said"), refused ? tr("sent_refused", { words, students, refused: count(refused, "student") }) : tr("sent", { words, students }));
  if (given > 0) order.then();
}

function loseAsked() {
  for (const { words } of asked.values()) write($("all-said"), words + tr("lost"));
  asked.clear();
}

let allChoices = [];
function showAll(students, choices) {
  $("all").hidden = students.length < 2;
  $("all-scene").hidden = choices.length === 0;
  // A list that is open would close.
  if (JSON.stringify(allChoices) === JSON.stringify(choices)) return;
  allChoices = choices;
  $("all-choice").replaceChildren(...choices.map(({ title, kind }, choice) => {
    const option = make("option", KINDS[kind] + title);
    option.value = choice;
    return option;
  }));
}
$("all-pause").onclick = () => orderAll({ do: "pause", on: true }, tr("pause"));
$("all-go").onclick = () => orderAll({ do: "pause", on: false }, tr("resume"));
$("all-end").onclick = () => {
  askEnd(tr("all_end_question"), count(page.students.filter((student) => student.here).length, "session_ends"));
};
$("all-scene").onsubmit = (event) => {
  event.preventDefault();
  const choice = Number($("all-choice").value);
  const words = $("all-choice").selectedOptions[0].textContent;
  // The lesson's own scene begins the lesson anew. Recordings with another scene are not graded.
  const leaves = (student) => student.here && student.step && student.choice !== choice;
  const leaving = page.students.filter(leaves).length;
  const lesson = leaving > 0 ? count(leaving, "lessons_end") : "";
  askFirst(words, { work: tr("all_lose"), lesson }, () => orderAll({ do: "scene", choice }, words));
};
$("all-send").onsubmit = (event) => {
  event.preventDefault();
  const text = $("all-message").value;
  orderAll({ do: "message", text }, tr("message"), () => { if ($("all-message").value === text) $("all-message").value = ""; });
};
$("all-unsay").onclick = () => orderAll({ do: "message", text: "" }, tr("taken_away"));
