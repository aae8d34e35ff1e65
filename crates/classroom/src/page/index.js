"use strict";
const body = document.querySelector(".index tbody");
const heads = document.querySelectorAll(".index th");
heads.forEach((head, column) => {
  head.firstChild.addEventListener("click", () => {
    const ascending = head.ariaSort !== "ascending";
    const value = (row) => row.cells[column].dataset.value ?? row.cells[column].textContent;
    const rows = [...body.rows].sort((a, b) =>
      value(a).localeCompare(value(b), undefined, { numeric: true }));
    if (!ascending) rows.reverse();
    body.append(...rows);
    heads.forEach((other) => { other.ariaSort = null; });
    head.ariaSort = ascending ? "ascending" : "descending";
  });
});
document.querySelector("input").addEventListener("input", (event) => {
  const words = event.target.value.toLowerCase();
  for (const row of body.rows) row.hidden = !row.innerText.toLowerCase().includes(words);
  const shown = [...body.rows].filter((row) => !row.hidden).length;
  document.querySelector("output").textContent = `${shown} of ${body.rows.length} shown`;
});
