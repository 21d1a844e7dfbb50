// Ties words and plots to the films: a link such as #t=3.2 goes to that second of
// the run in all of them, also as the address's end. A line marks in each plot the moment of
// the film that moved last, a click into a plot goes there. Without a film they
// simply stand.
(() => {
  const films = [...document.querySelectorAll("video")];
  if (!films.length) return;
  let film = films[0];
  // Idle moments are left out of a film: each part has its begin in the film and in the run.
  const cuts = (film.dataset.cuts ?? "0,0").split(" ").map((pair) => pair.split(",").map(Number));
  const runTime = (s) => {
    const [begin, t] = cuts.findLast(([at]) => at <= s) ?? cuts[0];
    return t + s - begin;
  };
  // A moment that is left out is shown by the first one after it.
  const filmTime = (t) => {
    const part = cuts.findLastIndex(([, from]) => from <= t);
    if (part < 0) return cuts[0][0];
    const [next] = cuts[part + 1] ?? [Infinity];
    return Math.min(cuts[part][0] + t - cuts[part][1], next);
  };
  const seek = (t) => {
    for (const each of films) each.currentTime = filmTime(t);
  };
  const marks = [...document.querySelectorAll(".canvas")].map((canvas) => {
    const svg = canvas.querySelector("svg");
    const { left, right, from, to } = canvas.dataset;
    const height = svg.viewBox.baseVal.height;
    const line = document.createElementNS(svg.namespaceURI, "line");
    line.setAttribute("class", "now");
    line.setAttribute("y1", "10");
    line.setAttribute("y2", String(height - 44));
    svg.append(line);
    canvas.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * svg.viewBox.baseVal.width;
      const share = Math.min(1, Math.max(0, (x - left) / (right - left)));
      seek(Number(from) + share * (to - from));
    });
    return { line, left: Number(left), right: Number(right), from: Number(from), to: Number(to) };
  });
  const show = () => {
    for (const { line, left, right, from, to } of marks) {
      const share = Math.min(1, Math.max(0, (runTime(film.currentTime) - from) / (to - from)));
      line.setAttribute("x1", String(left + share * (right - left)));
      line.setAttribute("x2", String(left + share * (right - left)));
    }
    if (!film.paused) requestAnimationFrame(show);
  };
  for (const each of films)
    for (const name of ["play", "seeked", "timeupdate"])
      each.addEventListener(name, () => {
        film = each;
        show();
      });
  show();
  const goTo = (fragment) => {
    const [, t] = fragment.match(/^#t=(\d+(?:\.\d+)?)$/) ?? [];
    if (t === undefined) return;
    seek(Number(t));
    // On a narrow page the film is far above the words.
    films[0].scrollIntoView({ block: "nearest" });
  };
  // A second click on the same link changes no address.
  for (const link of document.querySelectorAll("a.moment"))
    link.addEventListener("click", () => goTo(link.hash));
  addEventListener("hashchange", () => goTo(location.hash));
  goTo(location.hash);
})();
