// Ties the plots to the film: a line marks the film's moment in each plot, a
// click into a plot goes there. Without a film the plots simply stand.
(() => {
  const film = document.querySelector("video");
  if (!film) return;
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
      film.currentTime = Number(from) + share * (to - from);
    });
    return { line, left: Number(left), right: Number(right), from: Number(from), to: Number(to) };
  });
  const show = () => {
    for (const { line, left, right, from, to } of marks) {
      const share = Math.min(1, Math.max(0, (film.currentTime - from) / (to - from)));
      line.setAttribute("x1", String(left + share * (right - left)));
      line.setAttribute("x2", String(left + share * (right - left)));
    }
    if (!film.paused) requestAnimationFrame(show);
  };
  for (const name of ["play", "seeked", "timeupdate"]) film.addEventListener(name, show);
  show();
})();
