"use strict";
(() => {
  const EVERY_MS = 1000, LIMIT_MS = 4000, UNKNOWN = "–";
  const at = (id) => document.getElementById(id);
  const show = (value, digits = 0) => (value === null || value === undefined ? UNKNOWN : value.toFixed(digits));
  let heard = null, ended = false, events = 0;

  // Names and lines come from other programs: they become text, never markup.
  function cell(text, kind = "") {
    const made = document.createElement("td");
    made.textContent = text;
    made.className = kind;
    return made;
  }

  // A long name may go on in the next line, after a point or an underscore.
  function nameCell(name) {
    const made = document.createElement("th");
    made.scope = "row";
    made.append(...name.split(/(?<=[._])/).flatMap((part) => [part, document.createElement("wbr")]));
    return made;
  }

  function row(cells, kind = "") {
    const made = document.createElement("tr");
    made.className = kind;
    made.append(...cells);
    return made;
  }

  function describeHealth(sensor) {
    if (sensor.health === "missing") return Math.round(100 * sensor.missing_share) + " % missing";
    if (sensor.health === "stuck") return "stuck for " + Math.round(sensor.unchanged_s) + " s";
    if (sensor.health === "silent") return "silent for " + show(sensor.silent_s) + " s";
    return sensor.health;
  }

  function describeIri(track) {
    const spread = track.sigma_m_per_km === null ? "" : " ± " + show(track.sigma_m_per_km, 3);
    return show(track.iri_m_per_km, 3) + spread + ", " + Math.floor(100 * track.counted_share) + " %";
  }

  function showFigures(state) {
    const kmh = state.speed_mps === null ? null : 3.6 * state.speed_mps;
    at("speed").textContent = show(kmh, 1);
    at("distance").textContent = show(state.distance_m, 1);
    at("final").textContent = show(state.final_m, 1);
    const to = state.to_final;
    const due = to !== null && to.travel_m === 0;
    at("next").textContent = to === null ? UNKNOWN : due ? "due" : show(to.travel_m) + " m";
    at("then").textContent = to === null || due ? "" : ", or " + to.latency.standing_s + " s at a standstill";
    for (const name of ["dropped", "late"]) {
      at(name).textContent = state[name];
      at(name).className = state[name] > 0 ? "some" : "";
    }
  }

  function showSensors(state) {
    at("sensors").replaceChildren(...state.sensors.map((each) => row([
      nameCell(each.name), cell(describeHealth(each), each.health), cell(show(each.silent_s, 1), "number"),
      ...["samples", "missing", "dropped", "late"].map((name) => cell(each[name], "number")),
    ])));
  }

  function showSections(state) {
    const all = state.running === null ? state.sections : [...state.sections, state.running];
    const names = all.length ? all[all.length - 1].tracks.map((track) => track.name) : [];
    const head = at("tracks");
    while (head.children.length > 2) head.lastChild.remove();
    for (const name of names) {
      const made = document.createElement("th");
      made.scope = "col";
      made.className = "number";
      made.textContent = name + ": IRI ± 1-σ, valid";
      head.append(made);
    }
    at("sections").replaceChildren(...all.reverse().map((each) => {
      const kind = each.is_final ? "final" : "provisional";
      const text = each.is_running ? kind + ", " + show(each.length_m) + " m" : kind;
      const figures = each.tracks.map((track) => cell(describeIri(track), "number"));
      const changes = each.is_final && !each.is_running ? "final" : "provisional";
      return row([cell(show(each.start_m, 1), "number"), cell(text), ...figures], changes);
    }));
  }

  // Lines that are already there stay, so that a screen reader reads new ones alone.
  function showEvents(state) {
    const list = at("events");
    for (const each of state.events.filter((event) => event.number > events)) {
      const made = document.createElement("li");
      made.textContent = (each.at_m === null ? "" : "at " + show(each.at_m) + " m: ") + each.text;
      list.prepend(made);
      events = each.number;
    }
    while (list.children.length > 10) list.lastChild.remove();
  }

  function showState(state) {
    document.title = state.name + " – floatref live";
    at("name").textContent = state.name;
    const status = at("status");
    const text = [
      state.status + (state.reason ? ": " + state.reason : ""), state.pipeline,
      state.calculates_s > 1 ? "calculates for " + show(state.calculates_s) + " s" : "",
    ].filter(Boolean);
    // An unchanged line is not read aloud again.
    if (status.textContent !== text.join(", ")) status.textContent = text.join(", ");
    status.className = state.status;
    showFigures(state);
    showSensors(state);
    showSections(state);
    showEvents(state);
    at("made").textContent = "floatref " + state.floatref + (state.fault ? "; the display has failed: " + state.fault : "");
  }

  function showLost(text) {
    const lost = at("lost");
    if (lost.textContent !== text) lost.textContent = text;
    lost.hidden = text === "";
    document.body.classList.toggle("stale", text !== "");
  }

  async function poll() {
    try {
      const answer = await fetch("state.json", { cache: "no-store", signal: AbortSignal.timeout(LIMIT_MS) });
      if (!answer.ok) throw new Error(answer.statusText);
      const state = await answer.json();
      showState(state);
      heard = new Date();
      ended = state.closing;
      showLost(ended ? "The command has ended; this is its last state." : "");
    } catch {
      const since = heard === null ? "" : " Last state: " + heard.toLocaleTimeString() + ".";
      showLost("Connection lost; trying again." + since);
    }
    if (!ended) setTimeout(poll, EVERY_MS);
  }

  poll();
})();
