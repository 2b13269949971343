"use strict";
// The tables under the picture. A row with a place has a button that shows this place.

const NOTE = { true: "* not all points are valid, or samples are missing", false: "" };

function drawTables() {
  const section = document.getElementById("tables");
  section.replaceChildren(...page.tables.map(tableOf));
}

function tableOf(entry) {
  const box = document.createElement("div");
  box.className = "table";
  const table = box.appendChild(document.createElement("table"));
  table.createCaption().textContent = entry.caption;
  const head = table.createTHead().insertRow();
  for (const column of entry.columns) {
    const cell = head.appendChild(document.createElement("th"));
    cell.scope = "col";
    const unit = column.kind ? unitOf(column.kind).text : "";
    cell.textContent = unit ? `${column.name} (${unit})` : column.name;
  }
  const body = table.createTBody();
  entry.rows.forEach((row) => addRow(body, entry.columns, row));
  const note = box.appendChild(document.createElement("p"));
  note.textContent = NOTE[entry.rows.some((row) => row.marked)];
  return box;
}

function addRow(body, columns, row) {
  const line = body.insertRow();
  line.classList.toggle("marked", Boolean(row.marked));
  line.classList.toggle("whole", Boolean(row.whole));
  const kindOf = (cell, k) => (isOwn(cell) ? cell.kind : columns[k].kind);
  const place = row.cells.findIndex((cell, k) => kindOf(cell, k) === row.domain);
  row.cells.forEach((cell, k) => {
    const column = line.insertCell();
    const isText = typeof cell === "string";
    column.className = isText ? "" : "number";
    const text = isText ? cell : numberText(cell, columns[k].kind);
    if (k === place && row.place) column.append(button(row, text));
    else column.textContent = text;
  });
  if (row.marked) line.cells[0].append(" *");
}

// Whether the unit is that of the cell, not of its column.
function isOwn(cell) {
  return cell !== null && typeof cell === "object";
}

function numberText(cell, kind) {
  const own = isOwn(cell);
  const value = own ? cell.value : cell;
  if (value === null) return "–";
  const unit = unitOf(own ? cell.kind : kind);
  return (value * unit.factor).toFixed(2) + (own ? ` ${unit.text}` : "");
}

function button(row, text) {
  const found = document.createElement("button");
  found.textContent = text;
  found.title = "Show this place";
  found.onclick = () => {
    const [begin, end] = row.place.map((place) => toShown(place, row.domain));
    const margin = row.whole ? 0 : Math.max(0.05 * (end - begin), shown.axis === "time" ? 0.5 : 5);
    showPart(begin - margin, end + margin);
    document.getElementById("picture").scrollIntoView({ block: "nearest" });
  };
  return found;
}
