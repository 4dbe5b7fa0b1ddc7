// SPDX-License-Identifier: MIT
// Images of a study at the precision they were kept in: flip between techniques, split, error map, zoom and pan in step, exposure, values.
// The page holds <script type="application/json" id="images"> with, scene by scene, images of half floats (see images.py).
"use strict";
(() => {
const root = document.querySelector(".viewer"), source = document.getElementById("images");
if (!root || !source) return;
const data = JSON.parse(source.textContent);
const $ = name => root.querySelector("." + name);
const panes = [...root.querySelectorAll(".pane")], canvases = panes.map(pane => pane.querySelector("canvas"));
const REFERENCE = 0; // place of the reference among a scene's images
// image: what is looked at; other: what it is split with; x, y: what is in the middle, of the image.
const state = { image: 1, other: REFERENCE, showsError: true, stops: 0, split: null, zoom: 1, x: 0.5, y: 0.5, loaded: null };

// Half floats as numbers, by their bits (IEEE 754 binary16).
const numbers = new Float32Array(65536);
for (let bits = 0; bits < 65536; ++bits) {
    const exponent = bits >> 10 & 31, fraction = bits & 1023;
    const size = exponent === 31 ? (fraction ? NaN : Infinity) : exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
    numbers[bits] = bits >> 15 ? -size : size;
}

function bytesOf(text) {
    const binary = atob(text), bytes = new Uint8Array(binary.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

// Red, green, blue of each pixel; the file has all high bytes first, then all low ones, because that packs better.
async function halvesOf(text) {
    const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer()), count = bytes.length / 2, halves = new Uint16Array(count);
    for (let i = 0; i < count; ++i) halves[i] = bytes[i] << 8 | bytes[count + i];
    return halves;
}

async function load(scene) {
    if (typeof DecompressionStream === "undefined") {
        $("values").textContent = "This browser cannot unpack the images (it has no DecompressionStream).";
        return;
    }
    const { width, height, exposure, images } = data.scenes[scene];
    const pixels = await Promise.all(images.map(image => image.data ? halvesOf(image.data) : null));
    const known = image => image < images.length && pixels[image] ? image : pixels.findIndex(halves => halves);
    Object.assign(state, { image: known(state.image), other: known(state.other), zoom: 1, x: 0.5, y: 0.5 });
    kept.clear();
    state.loaded = { width, height, exposure, images, pixels };
    for (const pane of panes) pane.style.aspectRatio = `${width} / ${height}`;
    buttons();
    draw();
}

const luminance = (halves, i) => (numbers[halves[i]] + numbers[halves[i + 1]] + numbers[halves[i + 2]]) / 3;

// What "relmse" is the mean of: squared differences over the square of the reference's mean of colours + 0.01, at the study's exposure.
function errorAt(test, reference, i, exposure) {
    let sum = 0;
    for (let c = 0; c < 3; ++c) sum += ((numbers[test[i + c]] - numbers[reference[i + c]]) * exposure) ** 2;
    return sum / 3 / ((luminance(reference, i) * exposure) ** 2 + 0.01);
}

function shown(halves, width, height) {
    const table = new Uint8ClampedArray(65536), gain = state.loaded.exposure * 2 ** state.stops;
    for (let bits = 0; bits < 65536; ++bits) {
        const value = Math.min(Math.max(numbers[bits] * gain, 0), 1); // NaN stays
        table[bits] = 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
    }
    const image = new ImageData(width, height);
    for (let i = 0, j = 0; i < halves.length; i += 3, j += 4) {
        const bad = Number.isNaN(luminance(halves, i)); // magenta
        image.data[j] = bad ? 255 : table[halves[i]];
        image.data[j + 1] = bad ? 0 : table[halves[i + 1]];
        image.data[j + 2] = bad ? 255 : table[halves[i + 2]];
        image.data[j + 3] = 255;
    }
    return image;
}

const map = bytesOf(data.colors); // of the error map, from 10^low to 10^high
const [low, high] = data.errors;
function colorOf(error) {
    const share = Math.min(Math.max((Math.log10(error) - low) / (high - low), 0), 1);
    return 3 * Math.round(share * (map.length / 3 - 1));
}

function errorMap(test, reference, width, height) {
    const image = new ImageData(width, height);
    for (let i = 0, j = 0; i < test.length; i += 3, j += 4) {
        const error = errorAt(test, reference, i, state.loaded.exposure), at = colorOf(error);
        image.data.set(Number.isNaN(error) ? [255, 0, 255, 255] : [map[at], map[at + 1], map[at + 2], 255], j);
    }
    return image;
}

// A canvas of what `make` gives, made once: moving about needs no new colours.
const kept = new Map();
function bitmap(name, make) {
    if (!kept.has(name)) {
        const image = make(), canvas = new OffscreenCanvas(image.width, image.height);
        canvas.getContext("2d").putImageData(image, 0, 0);
        if (kept.size > 24) kept.clear();
        kept.set(name, canvas);
    }
    return kept.get(name);
}

// Where the image lies in a pane, in the canvas's pixels.
function place(canvas) {
    const scale = canvas.width / state.loaded.width * state.zoom;
    return { scale, left: canvas.width / 2 - state.x * state.loaded.width * scale, top: canvas.height / 2 - state.y * state.loaded.height * scale };
}

function paint(canvas, image, from, to) {
    const context = canvas.getContext("2d"), { scale, left, top } = place(canvas);
    context.save();
    context.beginPath();
    context.rect(from * canvas.width, 0, (to - from) * canvas.width, canvas.height);
    context.clip();
    context.imageSmoothingEnabled = false;
    context.drawImage(image, left, top, image.width * scale, image.height * scale);
    context.restore();
}

function draw() {
    const { loaded } = state;
    if (!loaded) return;
    const { width, height, images, pixels } = loaded, test = pixels[state.image], reference = pixels[REFERENCE];
    for (const [i, canvas] of canvases.entries()) {
        canvas.width = Math.round(panes[i].clientWidth * devicePixelRatio);
        canvas.height = Math.round(panes[i].clientHeight * devicePixelRatio);
    }
    const picture = i => bitmap(`${i} ${state.stops}`, () => shown(pixels[i], width, height));
    const split = state.split ?? 1, showsError = state.showsError && reference;
    paint(canvases[0], picture(state.image), 0, split);
    if (split < 1) paint(canvases[0], picture(state.other), split, 1);
    paint(canvases[1], showsError ? bitmap(`${state.image} error`, () => errorMap(test, reference, width, height)) : picture(state.other), 0, 1);
    $("split").hidden = panes[0].querySelector(".right").hidden = state.split === null;
    $("split").style.left = 100 * split + "%";
    panes[0].querySelector(".left").textContent = images[state.image].name;
    panes[0].querySelector(".right").textContent = images[state.other].name;
    panes[1].querySelector(".left").textContent = showsError ? "error of " + images[state.image].name : images[state.other].name;
    $("stops").textContent = (state.stops > 0 ? "+" : state.stops < 0 ? "−" : "") + Math.abs(state.stops).toFixed(1) + " EV";
    $("exposure").value = state.stops;
    $("zoom").textContent = state.zoom.toFixed(state.zoom < 10 ? 1 : 0) + "×";
    for (const button of $("techniques").children) {
        button.setAttribute("aria-pressed", Number(button.value) === state.image);
        button.classList.toggle("other", Number(button.value) === state.other);
    }
    $("toggle-split").setAttribute("aria-pressed", state.split !== null);
    $("toggle-error").setAttribute("aria-pressed", state.showsError);
}

function buttons() {
    const group = $("techniques");
    group.replaceChildren();
    state.loaded.images.forEach((image, i) => {
        const button = document.createElement("button"), key = document.createElement("kbd");
        button.value = i;
        key.textContent = i === REFERENCE ? "0" : i <= 9 ? i : "";
        button.append(key, image.name);
        button.disabled = !state.loaded.pixels[i];
        button.onclick = event => choose(i, event.shiftKey);
        group.append(button);
    });
}

function choose(image, asOther) {
    if (!state.loaded || !state.loaded.pixels[image]) return;
    state[asOther ? "other" : "image"] = image;
    draw();
    if (state.pointer) tell(...state.pointer);
}

const toggleSplit = () => { state.split = state.split === null ? 0.5 : null; draw(); };
const toggleError = () => { state.showsError = !state.showsError; draw(); };
const setStops = stops => { state.stops = Math.min(Math.max(Math.round(stops * 10) / 10, -10), 10); draw(); };
const step = by => choose(state.image + by);
const reset = () => { Object.assign(state, { zoom: 1, x: 0.5, y: 0.5 }); draw(); };

// The pixel under a point of a pane, as places of the image that may lie outside.
function pixelAt(pane, clientX, clientY) {
    const box = panes[pane].getBoundingClientRect(), canvas = canvases[pane], { scale, left, top } = place(canvas);
    return [((clientX - box.left) * canvas.width / box.width - left) / scale, ((clientY - box.top) * canvas.height / box.height - top) / scale];
}

function short(value) {
    const size = Math.abs(value);
    if (!Number.isFinite(value) || size === 0) return String(value);
    return size >= 1e-3 && size < 1e5 ? value.toPrecision(4) : value.toExponential(2);
}
function tell(pane, clientX, clientY) {
    const { loaded } = state;
    if (!loaded) return;
    const [x, y] = pixelAt(pane, clientX, clientY).map(Math.floor);
    if (x < 0 || y < 0 || x >= loaded.width || y >= loaded.height) {
        $("values").textContent = "";
        return;
    }
    const i = 3 * (y * loaded.width + x), test = loaded.pixels[state.image], reference = loaded.pixels[REFERENCE];
    const colour = image => `${loaded.images[image].name}: ${[0, 1, 2].map(c => short(numbers[loaded.pixels[image][i + c]])).join(" ")}`;
    let text = `(${x}, ${y})  ${colour(state.image)}\n${colour(state.other)}`;
    if (reference) text += `   relative squared error: ${short(errorAt(test, reference, i, loaded.exposure))}`;
    $("values").textContent = text;
}

panes.forEach((pane, index) => {
    pane.addEventListener("wheel", event => {
        if (!state.loaded) return;
        event.preventDefault();
        const [x, y] = pixelAt(index, event.clientX, event.clientY), before = state.zoom;
        state.zoom = Math.min(Math.max(state.zoom * 2 ** (-event.deltaY / 240), 1), 64);
        const kept = before / state.zoom; // what is under the pointer stays there
        state.x = x / state.loaded.width + (state.x - x / state.loaded.width) * kept;
        state.y = y / state.loaded.height + (state.y - y / state.loaded.height) * kept;
        if (state.zoom === 1) state.x = state.y = 0.5;
        draw();
        tell(index, event.clientX, event.clientY);
    }, { passive: false });
    pane.addEventListener("pointerdown", event => {
        if (event.target === $("split")) return;
        pane.setPointerCapture(event.pointerId);
        state.drag = [event.clientX, event.clientY];
    });
    pane.addEventListener("pointermove", event => {
        state.pointer = [index, event.clientX, event.clientY];
        if (state.drag && state.loaded) {
            const { scale } = place(canvases[index]), ratio = canvases[index].width / pane.clientWidth;
            state.x -= (event.clientX - state.drag[0]) * ratio / scale / state.loaded.width;
            state.y -= (event.clientY - state.drag[1]) * ratio / scale / state.loaded.height;
            state.drag = [event.clientX, event.clientY];
            draw();
        }
        tell(index, event.clientX, event.clientY);
    });
    pane.addEventListener("pointerup", () => { state.drag = null; });
    pane.addEventListener("pointerleave", () => { state.pointer = null; $("values").textContent = ""; });
    pane.addEventListener("dblclick", reset);
});

$("split").addEventListener("pointerdown", event => { $("split").setPointerCapture(event.pointerId); state.sliding = true; event.stopPropagation(); });
$("split").addEventListener("pointermove", event => {
    if (!state.sliding) return;
    const box = panes[0].getBoundingClientRect();
    state.split = Math.min(Math.max((event.clientX - box.left) / box.width, 0.02), 0.98);
    draw();
});
$("split").addEventListener("pointerup", () => { state.sliding = false; });

$("toggle-split").onclick = toggleSplit;
$("toggle-error").onclick = toggleError;
$("reset").onclick = reset;
$("exposure").oninput = event => setStops(Number(event.target.value));
$("scene").replaceChildren(...data.scenes.map((scene, i) => new Option(scene.name, i)));
$("scene").hidden = data.scenes.length < 2;
$("scene").onchange = event => {
    load(Number(event.target.value));
    event.target.blur(); // keys are the viewer's again
};
addEventListener("resize", draw);
addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, textarea, input:not([type=range])")) return;
    const digit = /^(Digit|Numpad)([0-9])$/.exec(event.code);
    if (digit) choose(Number(digit[2]), event.shiftKey);
    else if (event.key === "[") step(-1);
    else if (event.key === "]") step(1);
    else if (event.key === "s") toggleSplit();
    else if (event.key === "e") toggleError();
    else if (event.key === "+" || event.key === "=") setStops(state.stops + 0.5);
    else if (event.key === "-") setStops(state.stops - 0.5);
    else if (event.key === "r") reset();
    else return;
    event.preventDefault();
});

const bar = root.querySelector(".legend canvas"), strip = new ImageData(map.length / 3, 1);
for (let i = 0; i < map.length / 3; ++i) strip.data.set([map[3 * i], map[3 * i + 1], map[3 * i + 2], 255], 4 * i);
bar.width = strip.width;
bar.height = 1;
bar.getContext("2d").putImageData(strip, 0, 0);
load(0);
})();
