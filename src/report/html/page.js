"use strict";
// Sorting, filtering and copying. The page reads without them.
(() => {
  const value = (row, column) => {
    const cell = row.cells[column];
    const given = cell.dataset.v;
    return given === undefined ? cell.textContent.trim() : Number(given);
  };
  const compare = (a, b) =>
    typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });

  for (const table of document.querySelectorAll("table.sortable")) {
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const ascending = head.getAttribute("aria-sort") !== "ascending";
        heads.forEach((other) => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
        const body = table.tBodies[0];
        const rows = [...body.rows].map((row, at) => ({ row, at, key: value(row, column) }));
        rows.sort((a, b) => (ascending ? 1 : -1) * compare(a.key, b.key) || a.at - b.at);
        body.append(...rows.map((r) => r.row));
      });
    });
  }

  for (const table of document.querySelectorAll("table.filterable")) {
    const input = document.createElement("input");
    input.type = "search";
    input.placeholder = "Filter rows, such as cotan fails";
    input.setAttribute("aria-label", "Filter the rows of this table");
    table.parentElement.before(input);
    input.addEventListener("input", () => {
      const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const row of table.tBodies[0].rows) {
        const text = row.textContent.toLowerCase();
        row.hidden = !words.every((word) => text.includes(word));
      }
    });
  }

  if (navigator.clipboard) {
    for (const block of document.querySelectorAll("pre.replay")) {
      const command = block.textContent;
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = "copy";
      button.addEventListener("click", () =>
        navigator.clipboard.writeText(command).then(() => { button.textContent = "copied"; }, () => {}));
      block.append(button);
    }
  }
})();
