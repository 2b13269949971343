"use strict";
// What is shown: which part, over distance or over time, and in which units.
// Places are in m or s; `shift` of a run moves it along the road.

const travel = page.travel && { ...page.travel, distance: array(page.travel.distance) };
const shown = {
  axis: page.axis,
  units: page.units,
  begin: 0,
  end: 1,
  hiddenPaths: new Set(),
  hiddenRuns: new Set(),
  shifts: page.runs.map(() => 0),
  sigma: true,
  others: true,
};

function unitOf(kind) {
  const [text, factor] = page.shown[kind][shown.units];
  return { text, factor };
}

function distanceAt(time) {
  const place = (time - travel.start) / travel.step;
  const last = travel.distance.length - 1;
  if (!(place > 0)) return travel.distance[0];
  if (place >= last) return travel.distance[last];
  const before = Math.floor(place);
  const part = place - before;
  return travel.distance[before] * (1 - part) + travel.distance[before + 1] * part;
}

// The time at which a distance is first reached.
function timeAt(distance) {
  const d = travel.distance;
  const after = firstWhere(0, d.length - 1, (k) => d[k] >= distance);
  if (after === 0) return travel.start;
  const step = d[after] - d[after - 1];
  const part = step > 0 ? Math.min((distance - d[after - 1]) / step, 1) : 1;
  return travel.start + travel.step * (after - 1 + part);
}

function toShown(place, domain) {
  if (domain === shown.axis) return place;
  return domain === "time" ? distanceAt(place) : timeAt(place);
}

function fromShown(place, domain) {
  if (domain === shown.axis) return place;
  return domain === "time" ? timeAt(place) : distanceAt(place);
}

// Beyond a stop one distance belongs to many times: the last of them.
function lastFromShown(place, domain) {
  if (domain === shown.axis || domain === "distance") return fromShown(place, domain);
  const d = travel.distance;
  return travel.start + travel.step * firstWhere(0, d.length, (k) => d[k] > place);
}

function wholeSpan() {
  const domain = page.span[shown.axis] ? shown.axis : Object.keys(page.span)[0];
  return page.span[domain].map((place) => toShown(place, domain));
}

function axes() {
  return travel ? ["distance", "time"] : Object.keys(page.span);
}
