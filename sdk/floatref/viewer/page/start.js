"use strict";
// Makes the page, and draws it again, once for each frame, when something has changed.

let isWaiting = false;

function redraw() {
  if (isWaiting) return;
  isWaiting = true;
  requestAnimationFrame(drawNow);
}

function drawNow() {
  isWaiting = false;
  const drawn = panels.filter((panel) => panel.isSeen);
  drawn.forEach((panel) => panel.draw());
  panels.forEach((panel) => (panel.isOld = !panel.isSeen));
  if (track) drawMap();
  sayPlace(Math.max(1, ...drawn.map((panel) => panel.samples || 1)));
  if (drawn.length) performance.mark("drawn");
}

function sayPlace(samples) {
  const unit = unitOf(shown.axis);
  const [begin, end] = [shown.begin, shown.end].map((x) => (x * unit.factor).toFixed(shown.end - shown.begin < 10 ? 3 : 1));
  const drawn = samples > 1 ? `bins of up to ${samples} ${page.finest.of}` : `every one of the ${page.finest.of}`;
  document.getElementById("place").textContent = `${begin} to ${end} ${unit.text}, drawn: ${drawn}`;
}

function sayFinest() {
  const { samples, of } = page.finest;
  const whole = "Every one of the " + of + " is in this page.";
  const part = `Finest: the lowest and the highest of every ${samples} ${of}; floatref view with --from and --to writes a part down to each one.`;
  document.getElementById("finest").textContent = `${samples > 1 ? part : whole} Made by ${page.made}.`;
}

// What the colours mean that are not those of lines.
function explainColours() {
  const kinds = page.events.map((event) => event.kind);
  const isMarked = page.panels.some((panel) => panel.lines.some((line) => line.levels[0].marked !== undefined));
  const others = page.panels.some((panel) => panel.lines.some((line) => line.levels[0].others));
  const entries = Object.entries(EVENT_COLOURS).filter(([kind]) => kinds.includes(kind));
  if (isMarked) entries.push([others ? "shaded and dotted: not valid" : "shaded: samples are missing", MARK]);
  for (const [text, colour] of entries) {
    const item = document.getElementById("key").appendChild(document.createElement("span"));
    item.appendChild(document.createElement("i")).style.background = colour;
    item.append(text);
  }
}

function start() {
  const picture = document.getElementById("picture");
  page.panels.forEach((entry) => panels.push(new Panel(entry, picture)));
  sayFinest();
  explainColours();
  makeMoves();
  makeChoices();
  listen(picture);
  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const panel = panels.find(({ element }) => element === entry.target);
      panel.isSeen = entry.isIntersecting;
      if (panel.isSeen && panel.isOld) redraw();
    }
  }, { rootMargin: "200px" });
  panels.forEach((panel) => {
    panel.isOld = true;
    watcher.observe(panel.element);
  });
  window.addEventListener("resize", () => {
    panels.forEach((panel) => panel.resize());
    redraw();
  });
  window.addEventListener("beforeprint", () => panels.forEach((panel) => panel.draw()));
  showAll();
  // A table of thousands of rows waits until the picture is there.
  requestAnimationFrame(() => requestAnimationFrame(drawTables));
}

start();
