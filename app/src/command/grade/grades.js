// A click on a column's head sorts the rows by it, a second one the other way round.
(() => {
  const table = document.querySelector("table.grades");
  const heads = [...table.tHead.rows[0].cells];
  const body = table.tBodies[0];
  const words = new Intl.Collator(document.documentElement.lang, { numeric: true });
  const compared = (column) => {
    if ("number" in heads[column].dataset) {
      const value = (row) => Number(row.cells[column].dataset.sort);
      // Equal infinities have no difference.
      return (a, b) => value(a) - value(b) || 0;
    }
    const text = (row) => row.cells[column].textContent.trim();
    return (a, b) => words.compare(text(a), text(b));
  };
  heads.forEach((head, column) =>
    head.querySelector("button").addEventListener("click", () => {
      const falling = head.ariaSort === "ascending";
      for (const each of heads) each.ariaSort = "none";
      head.ariaSort = falling ? "descending" : "ascending";
      const compare = compared(column);
      // Stable both ways: equal rows stay in their order.
      body.append(...[...body.rows].sort((a, b) => (falling ? compare(b, a) : compare(a, b))));
    }),
  );
})();
