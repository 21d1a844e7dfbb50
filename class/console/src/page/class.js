// The class at a glance.
function card(student) {
  const button = make("button", "", student.incidents > 0 ? "troubled" : "");
  button.type = "button";
  button.dataset.student = student.student;
  button.append(make("strong", student.name));
  const lines = [
    student.here ? student.scene || "–" : "not connected",
    student.step ? `step ${student.step[0]} of ${student.step[1]}` : "",
    known(student.hottest_c) ? `hottest ${student.hottest_c.toFixed(1)} °C` : "",
    student.paused ? "paused" : "",
    student.incidents > 0 ? `⚠ ${student.incidents} incident${student.incidents > 1 ? "s" : ""}: ${student.last ?? ""}` : "",
  ];
  for (const line of lines.filter(Boolean)) button.append(make("span", line));
  button.onclick = () => open(student.student);
  const item = make("li");
  item.append(button);
  return item;
}

function showClass(students) {
  const first = page.students.length === 0;
  page.students = students;
  $("empty").hidden = students.length > 0;
  const focused = document.activeElement?.dataset?.student;
  $("students").replaceChildren(...students.map(card));
  if (focused) $("students").querySelector(`[data-student="${CSS.escape(focused)}"]`)?.focus();
  showName();
  // One headset is no class.
  if (first && students.length === 1 && page.opened === null) open(students[0].student);
}

function showName() {
  const student = page.students.find((student) => student.student === page.opened);
  if (student) write($("name"), student.name + (student.here ? "" : " (not connected)"));
}

function open(student) {
  if (say({ say: "open", student })) page.opened = student;
}

$("to-class").onclick = () => {
  say({ say: "close" });
  page.opened = page.is = page.state = null;
  forgetPicture();
  show("class");
};

let curvesOf = null;
function showOpened(student, is) {
  page.opened = student;
  page.is = is;
  page.state = null;
  forgetPicture();
  // A student that was lost for a moment keeps its curves.
  if (curvesOf !== student) forgetCurves();
  curvesOf = student;
  loseOrders();
  showScenes();
  showName();
  show("student");
}
