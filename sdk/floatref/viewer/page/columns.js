"use strict";
// From the levels of a line the points to draw: of every column of the picture the lowest and the
// highest value. Where a column has less than one bin of the finest level, the bins themselves.

function levelFor(line, begin, end, width) {
  const enough = line.levels.filter((level) => inside(line, level, begin, end) >= 2 * width);
  return enough.length ? enough[enough.length - 1] : line.levels[0];
}

function indexOf(line, level, place) {
  if (level.at === undefined) return (place - line.start) / (line.step * level.samples);
  const at = array(level.at);
  return firstWhere(0, at.length, (k) => at[k] + line.start >= place);
}

function inside(line, level, begin, end) {
  const first = Math.max(0, indexOf(line, level, begin));
  return Math.max(0, Math.min(level.bins, indexOf(line, level, end)) - first);
}

function placeOf(line, level, bin) {
  if (level.at !== undefined) return line.start + array(level.at)[bin];
  return line.start + line.step * level.samples * bin;
}

// Returns xs, and for "values", "others" and "sigma" the lows and highs there; null is a gap,
// undefined a place between points. `marks` are the stretches in which not all is valid.
function pointsOf(line, begin, end, width) {
  const shift = shown.shifts[line.run] || 0;
  const from = fromShown(begin - shift, line.domain);
  const to = lastFromShown(end - shift, line.domain);
  const level = levelFor(line, from, to, width);
  const first = Math.max(0, Math.floor(indexOf(line, level, from)) - 1);
  const last = Math.min(level.bins, Math.ceil(indexOf(line, level, to)) + 2);
  const parts = ["values", "others", "sigma"].filter((name) => level[name]);
  const dense = last - first > 2 * width || (line.domain === "time" && shown.axis === "distance");
  const found = dense
    ? inColumns(line, level, first, last, begin, end, width, shift)
    : inBins(line, level, first, last, shift);
  const points = { xs: found.xs, marks: found.marks, samples: level.samples };
  for (const name of parts) points[name] = found.fill(level[name].map(array), line.base);
  return points;
}

function inBins(line, level, first, last, shift) {
  const single = level.samples === 1;
  const xs = [];
  const marks = [];
  const marked = level.marked === undefined ? null : array(level.marked);
  for (let bin = first; bin < last; bin++) {
    const at = toShown(placeOf(line, level, bin), line.domain) + shift;
    const next = bin + 1 < level.bins ? toShown(placeOf(line, level, bin + 1), line.domain) + shift : at;
    xs.push(at);
    if (!single) xs.push((at + next) / 2);
    // A sample without a place of its own stands for half a step on either side.
    const half = single && level.at === undefined && line.domain === shown.axis ? line.step / 2 : 0;
    if (marked && marked[bin]) addMark(marks, at - half, half ? at + half : next);
  }
  const fill = ([low, high], base) => {
    const lows = [];
    const highs = [];
    for (let bin = first; bin < last; bin++) {
      const empty = Number.isNaN(low[bin]);
      lows.push(empty ? null : base + low[bin]);
      highs.push(empty ? null : base + high[bin]);
      if (!single) {
        lows.push(lows[lows.length - 1]);
        highs.push(highs[highs.length - 1]);
      }
    }
    return { lows, highs };
  };
  return { xs, marks, fill };
}

function inColumns(line, level, first, last, begin, end, width, shift) {
  const column = new Int32Array(last - first);
  const scale = width / (end - begin);
  for (let bin = first; bin < last; bin++) {
    const x = toShown(placeOf(line, level, bin), line.domain) + shift;
    column[bin - first] = Math.floor((x - begin) * scale);
  }
  const marks = [];
  const marked = level.marked === undefined ? null : array(level.marked);
  for (let bin = first; marked && bin < last; bin++) {
    const at = begin + column[bin - first] / scale;
    const next = begin + (bin + 1 < last ? column[bin + 1 - first] : column[bin - first]) / scale;
    if (marked[bin]) addMark(marks, at, Math.max(next, at + 1 / scale), 0.5 / scale);
  }
  const fill = ([low, high], base) => {
    const lows = new Array(2 * width).fill(undefined);
    const highs = new Array(2 * width).fill(undefined);
    for (let bin = first; bin < last; bin++) {
      const at = 2 * column[bin - first];
      if (at < 0 || at >= 2 * width) continue;
      if (Number.isNaN(low[bin])) {
        if (lows[at] === undefined) lows[at] = highs[at] = null;
        continue;
      }
      const known = typeof lows[at] === "number";
      lows[at] = known ? Math.min(lows[at], base + low[bin]) : base + low[bin];
      highs[at] = known ? Math.max(highs[at], base + high[bin]) : base + high[bin];
    }
    for (let at = 2, before = lows[0], from = 2; at < 2 * width; at += 2) {
      if (lows[at] === undefined) continue;
      if (before === null || lows[at] === null) for (let k = from; k < at; k += 2) lows[k] = highs[k] = null;
      before = lows[at];
      from = at + 2;
    }
    for (let at = 0; at < 2 * width; at += 2) {
      lows[at + 1] = lows[at];
      highs[at + 1] = highs[at];
    }
    return { lows, highs };
  };
  return { xs: columnPlaces(begin, end, width), marks, fill };
}

// Lines of one picture share their columns, and so the array of places.
let places = { key: "", xs: [] };
function columnPlaces(begin, end, width) {
  const key = `${begin} ${end} ${width}`;
  if (places.key !== key) {
    const step = (end - begin) / width;
    const xs = Array.from({ length: 2 * width }, (_, k) => begin + step * ((k >> 1) + (k & 1 ? 0.75 : 0.25)));
    places = { key, xs };
  }
  return places.xs;
}

// Marks that are no farther apart than `slack` become one.
function addMark(marks, begin, end, slack = 0) {
  const last = marks[marks.length - 1];
  if (last && begin <= last[1] + slack) last[1] = Math.max(last[1], end);
  else marks.push([begin, end]);
}

// A line that goes through every lowest and highest value: low, high, low, high …
function zigzag({ lows, highs }) {
  return lows.map((low, k) => (k & 1 ? highs[k] : low));
}
