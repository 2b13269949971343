"use strict";
// The document of the page, and its arrays: numbers as base64, decoded when first drawn.

const page = JSON.parse(document.getElementById("document").textContent);
const FORMS = { f4: Float32Array, f8: Float64Array, u1: Uint8Array };
const decoded = new Map();

function array(number) {
  if (!decoded.has(number)) {
    const element = document.getElementById(`array-${number}`);
    decoded.set(number, new FORMS[page.arrays[number]](bytes(element.textContent).buffer));
    element.remove();
  }
  return decoded.get(number);
}

function bytes(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const raw = atob(text);
  const found = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) found[k] = raw.charCodeAt(k);
  return found;
}

// The first index from `low` on at which `isBeyond` holds, for what holds from some index on.
function firstWhere(low, high, isBeyond) {
  while (low < high) {
    const middle = (low + high) >> 1;
    if (isBeyond(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}
