"use strict";
// One panel of the picture: the lines of one quantity, by uPlot, with marks and events behind them.

const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#B07800"];
// Of the kinds of event that have a strip of colour at the top of every panel.
const EVENT_COLOURS = { stop: "#7030a0", slow: "#9a9a9a", braking: "#b8860b" };
const FROM_ZERO = ["roughness", "speed"];
const MARK = "#F0C9C0";
const paths = [...new Set(page.panels.flatMap((panel) => panel.lines.map((line) => line.path)))].filter(Boolean);
const panels = [];

function colourOf(line) {
  const path = Math.max(0, paths.indexOf(line.path));
  return COLOURS[(line.run * Math.max(1, paths.length) + path) % COLOURS.length];
}

function isHidden(line) {
  return shown.hiddenPaths.has(line.path) || shown.hiddenRuns.has(line.run);
}

function nameOf(line) {
  return page.runs.length > 1 && line.label !== page.runs[line.run].name
    ? `${page.runs[line.run].name}: ${line.label}`
    : line.label;
}

class Panel {
  constructor(entry, parent) {
    this.entry = entry;
    this.lines = entry.lines;
    this.range = [0, 1];
    this.marks = [];
    this.element = parent.appendChild(document.createElement("section"));
    this.element.className = "panel";
    this.head = this.element.appendChild(document.createElement("h2"));
    this.head.textContent = entry.title;
    this.legend = this.element.appendChild(document.createElement("p"));
    this.legend.className = "legend";
    this.values = this.lines.map((line) => this.legendOf(line));
    this.plot = null;
    this.isSeen = false;
  }

  legendOf(line) {
    const item = this.legend.appendChild(document.createElement("span"));
    item.style.color = colourOf(line);
    item.append("■ ");
    item.appendChild(document.createElement("span")).textContent = nameOf(line);
    return { item, value: item.appendChild(document.createElement("b")) };
  }

  get width() {
    return Math.max(200, this.element.clientWidth);
  }

  // Columns are the pixels of the screen inside the axes.
  get columns() {
    return Math.max(50, Math.round((this.width - 70) * Math.min(devicePixelRatio, 2)));
  }

  draw() {
    const data = this.data();
    const unit = unitOf(this.kind);
    this.head.textContent = unit.text ? `${this.entry.title} (${unit.text})` : this.entry.title;
    this.values.forEach(({ item }, k) => (item.hidden = isHidden(this.lines[k])));
    if (!this.plot) this.plot = new uPlot(this.options(), data, this.element);
    else this.plot.setData(data, true);
  }

  resize() {
    if (this.plot) this.plot.setSize({ width: this.width, height: this.height });
  }

  get height() {
    return window.innerWidth < 600 ? 150 : 190;
  }

  // The data of uPlot: places, then for each line its values, the others, and both ends of the band.
  data() {
    const xUnit = unitOf(shown.axis).factor;
    const [begin, end] = [shown.begin, shown.end];
    this.marks = [];
    this.samples = 0;
    const tables = this.lines.map((line) => {
      if (isHidden(line)) return null;
      const points = pointsOf(line, begin, end, this.columns);
      this.marks.push(...points.marks);
      this.samples = Math.max(this.samples, points.samples);
      return points;
    });
    const range = rangeOf(tables, begin, end, FROM_ZERO.includes(this.entry.kind));
    this.kind = kindFor(this.entry.kind, range);
    const unit = unitOf(this.kind).factor;
    this.range = range.map((y) => y * unit);
    const rows = tables.map((points) => this.rowsOf(points, unit));
    return joined(tables, rows, xUnit);
  }

  rowsOf(points, unit) {
    if (!points) return null;
    const scaled = (row) => row.map((y) => (typeof y === "number" ? y * unit : y));
    const empty = () => new Array(points.xs.length).fill(null);
    const band = shown.sigma && points.sigma;
    return [
      scaled(zigzag(points.values)),
      shown.others && points.others ? scaled(zigzag(points.others)) : empty(),
      band ? scaled(points.sigma.lows) : empty(),
      band ? scaled(points.sigma.highs) : empty(),
    ];
  }

  options() {
    const series = [{}];
    const bands = [];
    for (const line of this.lines) {
      const stroke = colourOf(line);
      const plain = { stroke, width: 1, points: { show: line.levels[0].bins < 2 }, spanGaps: false };
      series.push(plain, { ...plain, dash: [2, 3], stroke: `${stroke}90` });
      series.push({ width: 0, points: { show: false } }, { width: 0, points: { show: false } });
      bands.push({ series: [series.length - 1, series.length - 2], fill: `${stroke}30` });
    }
    return {
      width: this.width,
      height: this.height,
      series,
      bands,
      legend: { show: false },
      scales: {
        x: { time: false, range: () => [shown.begin, shown.end].map((x) => x * unitOf(shown.axis).factor) },
        y: { range: () => this.range },
      },
      axes: [{ size: 32 }, { size: 58 }],
      cursor: {
        sync: { key: "floatref" },
        drag: { x: true, y: false, setScale: false },
        bind: { dblclick: () => showAll, mousedown: (_, __, handler) => (event) => event.shiftKey || handler(event) },
      },
      hooks: {
        drawClear: [(plot) => this.drawBehind(plot)],
        setSelect: [(plot) => this.zoomTo(plot)],
        setCursor: [(plot) => this.readOut(plot)],
      },
    };
  }

  zoomTo(plot) {
    if (plot.select.width < 4) return;
    const ends = [plot.select.left, plot.select.left + plot.select.width];
    const factor = unitOf(shown.axis).factor;
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    showPart(...ends.map((x) => plot.posToVal(x, "x") / factor));
  }

  drawBehind(plot) {
    const { left, top, width, height } = plot.bbox;
    const context = plot.ctx;
    const factor = unitOf(shown.axis).factor;
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    const fill = (begin, end, colour, depth) => {
      const from = plot.valToPos(begin * factor, "x", true);
      const to = plot.valToPos(end * factor, "x", true);
      context.fillStyle = colour;
      context.fillRect(from, top, Math.max(to - from, 2), depth);
    };
    this.marks.forEach(([begin, end]) => fill(begin, end, MARK, height));
    for (const event of page.events) {
      const colour = EVENT_COLOURS[event.kind];
      if (!colour) continue;
      const ends = [event.begin, event.end].map((place) => toShown(place, event.domain));
      fill(...ends, colour, 6 * devicePixelRatio);
    }
    context.restore();
  }

  readOut(plot) {
    const index = plot.cursor.idx;
    this.values.forEach(({ value }, k) => {
      const row = plot.data[1 + 4 * k];
      let y = index == null ? null : row[index];
      for (let back = 1; y === undefined && back < 20; back++) y = row[index - back];
      value.textContent = typeof y === "number" ? ` ${y.toPrecision(5)}` : "";
    });
    if (index != null) pointAt(plot.posToVal(plot.cursor.left, "x") / unitOf(shown.axis).factor);
  }
}

// Lengths are shown in small units where what is in sight is small.
function kindFor(kind, [low, high]) {
  if (!kind.endsWith("distance")) return kind;
  const isSmall = high - low < page.small.range && Math.max(-low, high) < page.small.largest;
  return isSmall ? "small distance" : "distance";
}

// The range of all valid values in sight, or of the others where there is no valid one. The points
// next to what is in sight count too: lines go to them.
function rangeOf(tables, begin, end, fromZero) {
  for (const name of ["values", "others"]) {
    let [low, high] = [Infinity, -Infinity];
    for (const points of tables) {
      if (!points || !points[name]) continue;
      const count = points.xs.length;
      const first = firstWhere(0, count, (k) => points.xs[k] >= begin) - 1;
      const last = firstWhere(0, count, (k) => points.xs[k] > end);
      points.xs.forEach((x, k) => {
        if (k < first || k > last || typeof points[name].lows[k] !== "number") return;
        low = Math.min(low, points[name].lows[k]);
        high = Math.max(high, points[name].highs[k]);
      });
    }
    if (low > high) continue;
    if (fromZero) low = Math.min(0, low);
    const margin = 0.08 * (high - low) || Math.abs(high) * 0.01 || 0.001;
    return [fromZero ? low : low - margin, high + margin];
  }
  return [0, 1];
}

// Lines on the same places stay side by side; others are merged, with undefined between points.
function joined(tables, rows, xUnit) {
  const known = tables.map((points, k) => points && [points.xs.map((x) => x * xUnit), ...rows[k]]);
  const present = known.filter(Boolean);
  const same = tables.filter(Boolean).every((points, _, all) => points.xs === all[0].xs);
  if (!present.length) return [[], ...tables.flatMap(() => [[], [], [], []])];
  const merged = same ? [present[0][0], ...present.flatMap((table) => table.slice(1))] : uPlot.join(present, present.map((t) => t.map(() => 2)));
  const count = merged[0].length;
  let at = 1;
  const filled = known.flatMap((table) => {
    if (!table) return [0, 1, 2, 3].map(() => new Array(count).fill(null));
    at += 4;
    return merged.slice(at - 4, at);
  });
  return [merged[0], ...filled];
}
