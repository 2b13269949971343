"use strict";
// The track of the vehicle as a plain drawing: north up, no tiles. The part that is shown is thick.

const track = page.map && {
  time: array(page.map.time),
  latitude: array(page.map.latitude),
  longitude: array(page.map.longitude),
};
let pointed = null;

function pointAt(place) {
  pointed = place;
  if (track) drawMap();
}

function drawMap() {
  const figure = document.getElementById("map");
  figure.hidden = false;
  const canvas = figure.querySelector("canvas");
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = width * devicePixelRatio;
  canvas.height = height * devicePixelRatio;
  const context = canvas.getContext("2d");
  context.scale(devicePixelRatio, devicePixelRatio);
  const project = projection(width, height);
  const [from, to] = [fromShown(shown.begin, "time"), lastFromShown(shown.end, "time")];
  stroke(context, project, -Infinity, Infinity, "#8a8a8a", 1);
  stroke(context, project, from, to, "#0072B2", 3);
  if (pointed !== null) dot(context, project, fromShown(pointed, "time"));
  scaleBar(context, project, height);
}

// Places in pixels; one degree of longitude is shorter than one of latitude.
function projection(width, height) {
  const known = Array.from(track.time.keys()).filter((k) => !Number.isNaN(track.latitude[k] + track.longitude[k]));
  const ends = (values) => known.reduce(([a, b], k) => [Math.min(a, values[k]), Math.max(b, values[k])], [Infinity, -Infinity]);
  const [south, north] = ends(track.latitude);
  const [west, east] = ends(track.longitude);
  const shrink = Math.cos(((south + north) / 2) * (Math.PI / 180));
  const margin = 16;
  const scale = Math.min((width - 2 * margin) / Math.max((east - west) * shrink, 1e-7), (height - 2 * margin) / Math.max(north - south, 1e-7));
  const middle = [(west + east) / 2, (south + north) / 2];
  const project = (k) => [
    width / 2 + (track.longitude[k] - middle[0]) * shrink * scale,
    height / 2 - (track.latitude[k] - middle[1]) * scale,
  ];
  project.pixelsPerMetre = scale / 111195;
  return project;
}

function stroke(context, project, from, to, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineCap = "round";
  context.beginPath();
  let isDown = false;
  for (let k = 0; k < track.time.length; k++) {
    const [x, y] = project(k);
    const isIn = track.time[k] >= from && track.time[k] <= to && !Number.isNaN(x + y);
    if (isIn && isDown) context.lineTo(x, y);
    if (isIn && !isDown) context.moveTo(x, y);
    isDown = isIn;
  }
  context.stroke();
}

function dot(context, project, time) {
  const after = firstWhere(0, track.time.length - 1, (k) => track.time[k] >= time);
  const [x, y] = project(after);
  if (Number.isNaN(x + y)) return;
  context.fillStyle = "#D55E00";
  context.beginPath();
  context.arc(x, y, 5, 0, 2 * Math.PI);
  context.fill();
}

function scaleBar(context, project, height) {
  const unit = unitOf("distance");
  const most = (100 / project.pixelsPerMetre) * unit.factor;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = power * [5, 2, 1].find((n) => n * power <= most);
  const pixels = (length / unit.factor) * project.pixelsPerMetre;
  context.fillStyle = "#222";
  context.fillRect(12, height - 12, pixels, 3);
  context.font = "12px system-ui, sans-serif";
  context.fillText(`${length} ${unit.text}`, 12, height - 17);
}
