"use strict";
// Moving the picture by buttons, keys, mouse and touch, and choosing what it shows.

const PAN = 0.2;
const ZOOM = 2;
const MOVES = [
  ["◀", "Left (arrow left)", () => move(-PAN)],
  ["▶", "Right (arrow right)", () => move(PAN)],
  ["+", "Zoom in (+)", () => zoom(1 / ZOOM)],
  ["−", "Zoom out (-)", () => zoom(ZOOM)],
  ["All", "Show all (0)", () => showAll()],
];
const KEYS = {
  ArrowLeft: MOVES[0][2],
  ArrowRight: MOVES[1][2],
  "+": MOVES[2][2],
  "=": MOVES[2][2],
  "-": MOVES[3][2],
  0: MOVES[4][2],
  Home: MOVES[4][2],
  u: () => choose("units", shown.units === "si" ? "us" : "si"),
  a: () => axes().length > 1 && choose("axis", shown.axis === "time" ? "distance" : "time"),
};

function showPart(begin, end) {
  const [low, high] = wholeSpan();
  const least = (high - low) * 1e-7;
  const length = Math.min(Math.max(end - begin, least), high - low);
  const middle = (begin + end) / 2;
  shown.begin = Math.min(Math.max(middle - length / 2, low), high - length);
  shown.end = shown.begin + length;
  redraw();
}

function showAll() {
  showPart(...wholeSpan());
}

function move(part) {
  const by = part * (shown.end - shown.begin);
  showPart(shown.begin + by, shown.end + by);
}

function zoom(factor, at = (shown.begin + shown.end) / 2) {
  showPart(at - (at - shown.begin) * factor, at + (shown.end - at) * factor);
}

function choose(what, value) {
  if (what === "axis" && value !== shown.axis) {
    const ends = [shown.begin, shown.end];
    const before = shown.axis;
    shown.axis = value;
    [shown.begin, shown.end] = ends.map((place) => toShown(place, before));
  }
  shown[what] = value;
  makeChoices();
  drawTables();
  showPart(shown.begin, shown.end);
}

function makeMoves() {
  const bar = document.getElementById("moves");
  for (const [text, title, act] of MOVES) {
    const found = bar.appendChild(document.createElement("button"));
    Object.assign(found, { textContent: text, title, onclick: act });
    found.setAttribute("aria-label", title);
  }
}

function makeChoices() {
  const box = document.getElementById("choices");
  box.replaceChildren();
  if (axes().length > 1) box.append(selection("axis", axes()));
  box.append(selection("units", ["si", "us"], { si: "metric", us: "US" }));
  if (paths.length > 1) paths.forEach((path) => box.append(toggle(path, shown.hiddenPaths, path)));
  if (page.runs.length > 1) page.runs.forEach((run, k) => box.append(runChoice(run, k)));
  const lines = page.panels.flatMap((panel) => panel.lines);
  for (const [name, text] of [["sigma", "±1 σ"], ["others", "not valid"]]) {
    if (lines.some((line) => line.levels[0][name])) box.append(flag(name, text));
  }
}

function selection(what, values, names = {}) {
  const label = document.createElement("label");
  label.append(`${what} `);
  const found = label.appendChild(document.createElement("select"));
  for (const value of values) found.add(new Option(names[value] || value, value, false, value === shown[what]));
  found.onchange = () => choose(what, found.value);
  return label;
}

function checkbox(text, isOn, onchange) {
  const label = document.createElement("label");
  const found = label.appendChild(document.createElement("input"));
  found.type = "checkbox";
  found.checked = isOn;
  found.onchange = () => {
    onchange(found.checked);
    redraw();
  };
  label.append(` ${text}`);
  return label;
}

function toggle(text, hidden, key) {
  return checkbox(text, !hidden.has(key), (isOn) => (isOn ? hidden.delete(key) : hidden.add(key)));
}

function flag(name, text) {
  return checkbox(text, shown[name], (isOn) => (shown[name] = isOn));
}

// A run was moved to its place on the road; there it lies `lag` farther along than the reference,
// and its shift moves it back.
function runChoice(run, number) {
  const box = document.createElement("span");
  box.className = "run";
  box.append(toggle(number ? run.name : `${run.name} (reference)`, shown.hiddenRuns, number));
  if (!number) return box;
  const unit = unitOf("distance");
  if (run.moved) box.append(` moved by ${(run.moved * unit.factor).toFixed(3)} ${unit.text},`);
  const shift = document.createElement("input");
  Object.assign(shift, { type: "number", step: "any", value: (shown.shifts[number] * unit.factor).toFixed(3) });
  shift.setAttribute("aria-label", `Shift of ${run.name} in ${unit.text}`);
  shift.onchange = () => {
    shown.shifts[number] = shift.valueAsNumber / unit.factor || 0;
    redraw();
  };
  box.append(" shift ", shift, ` ${unit.text} `);
  if (run.note) box.append(`(${run.lag === null ? "place not sure: " : ""}${run.note}) `);
  if (run.lag === null) return box;
  const align = box.appendChild(document.createElement("button"));
  align.textContent = `lag ${(run.lag * unit.factor).toFixed(3)} ${unit.text}: remove`;
  align.onclick = () => {
    shown.shifts[number] = -run.lag;
    makeChoices();
    redraw();
  };
  return box;
}

function listen(picture) {
  document.addEventListener("keydown", (event) => {
    const isText = event.target.matches("select, input:not([type=checkbox])");
    const act = KEYS[event.key] || (/^[1-9]$/.test(event.key) && (() => togglePath(event.key - 1)));
    if (!act || isText || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  picture.addEventListener("wheel", (event) => onWheel(picture, event), { passive: false });
  listenToPointers(picture);
}

function togglePath(number) {
  const path = paths[number];
  if (!path) return;
  if (!shown.hiddenPaths.delete(path)) shown.hiddenPaths.add(path);
  makeChoices();
  redraw();
}

// The wheel zooms after a click on the picture, or with Ctrl; else it scrolls the page.
function onWheel(picture, event) {
  const isOurs = event.ctrlKey || picture.contains(document.activeElement);
  if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
    event.preventDefault();
    move(event.deltaX / panels[0].width);
  } else if (isOurs) {
    event.preventDefault();
    zoom(1.0015 ** event.deltaY, placeUnder(event.clientX));
  }
}

function placeUnder(clientX) {
  const box = panels[0].plot.over.getBoundingClientRect();
  return shown.begin + ((clientX - box.left) / box.width) * (shown.end - shown.begin);
}

// One finger, or the mouse with Shift, pans; two fingers zoom.
function listenToPointers(picture) {
  const down = new Map();
  picture.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse" && !event.shiftKey) return picture.focus({ preventScroll: true });
    down.set(event.pointerId, event.clientX);
  });
  picture.addEventListener("pointermove", (event) => {
    if (!down.has(event.pointerId)) return;
    const before = [...down.values()].map(placeUnder);
    down.set(event.pointerId, event.clientX);
    const after = [...down.values()].map(placeUnder);
    if (before.length === 1) showPart(shown.begin + before[0] - after[0], shown.end + before[0] - after[0]);
    else pinch(before, after);
  });
  for (const kind of ["pointerup", "pointercancel"]) {
    document.addEventListener(kind, (event) => down.delete(event.pointerId));
  }
}

function pinch(before, after) {
  const factor = Math.abs(before[1] - before[0]) / Math.max(Math.abs(after[1] - after[0]), 1e-12);
  if (Number.isFinite(factor) && factor > 0) zoom(Math.min(Math.max(factor, 0.5), 2), (after[0] + after[1]) / 2);
}
