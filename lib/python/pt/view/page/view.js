import {orbit, pan, turnsAbout, zoom} from "./camera.js";
import {PathView} from "./path.js";

const $ = id => document.getElementById(id);

let socket, editor;
let state = {};
let pixels; // RGBA bytes
let display; // exposure (a number or "auto"), tonemap, gamma (null: the sRGB curve)
let camera; // the camera that was sent last
let pointer; // the place under the pointer, 0 to 1 across the picture
let held; // the place that was clicked
let isWhole = false;
let asks = false;

function send(message) {
  if (socket.readyState === WebSocket.OPEN)
    socket.send(JSON.stringify(message));
}

function receive(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const next = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  if (buffer.byteLength > 4 + length)
    pixels = new Uint8ClampedArray(buffer, 4 + length);
  const isFirst = display === undefined;
  state = next;
  if (isFirst)
    begin();
  if (!drag && performance.now() > settled)
    camera = state.camera;
  paint();
  tell();
  askPixel();
  requestAnimationFrame(() => send({next: state.frame}));
}

function paint() {
  if (!pixels || pixels.length !== 4 * state.width * state.height)
    return;
  const canvas = $("picture");
  if (canvas.width !== state.width || canvas.height !== state.height)
    [canvas.width, canvas.height] = [state.width, state.height];
  canvas.getContext("2d").putImageData(new ImageData(pixels, state.width), 0, 0);
  canvas.dataset.frame = state.frame;
  fit();
  $("stops").value = `${state.stops.toFixed(2)} EV`;
  if (display.exposure === "auto")
    $("exposure").value = state.stops;
}

function fit() {
  const stage = $("stage"), canvas = $("picture");
  const [width, height] = state.size;
  stage.classList.toggle("whole", isWhole);
  stage.style.setProperty("--ratio", height / width);
  const factor = isWhole ? 1 / devicePixelRatio : Math.min(stage.clientWidth / width, stage.clientHeight / height);
  canvas.style.width = `${width * factor}px`;
  canvas.style.height = `${height * factor}px`;
  canvas.style.imageRendering = isWhole || factor * devicePixelRatio >= 2 ? "pixelated" : "auto";
  $("fit").setAttribute("aria-pressed", !isWhole);
  $("whole").setAttribute("aria-pressed", isWhole);
  mark();
}

function mark() {
  if (!pixels)
    return;
  const outline = held && `M${Math.floor(held.x * state.width)},${Math.floor(held.y * state.height)}h1v1h-1z`;
  const unit = state.width / $("picture").clientWidth;
  $("marks").setAttribute("viewBox", `0 0 ${state.width} ${state.height}`);
  $("marks").innerHTML = (held ? `<path class="under" d="${outline}"/><path d="${outline}"/>` : "")
    + path.drawn(state.width, state.height, unit);
}

const pixelOf = (place, [width, height]) => [Math.floor(place.x * width), Math.floor(place.y * height)];
const path = new PathView(() => ask("trace", [...pixelOf(held, state.size), path.sample]), mark);

const percent = share => share == null ? "unknown" : `${(100 * share).toPrecision(3)}%`;

function tell() {
  const isFilm = !state.camera;
  $("play").textContent = state.playing ? "Stop" : "Go on";
  $("play").hidden = isFilm;
  document.body.classList.toggle("film", isFilm);
  const seconds = state.seconds == null ? "" : `, ${state.seconds.toFixed(1)} s`;
  $("progress").textContent = `${Math.round(state.samples)} samples${seconds}`;
  const doubt = state.uncertain?.length ? ", uncertain" : "";
  $("error").textContent = state.moving ? "" : state.error == null ? "error from 16 samples on"
    : `error ${percent(state.error)} (${percent(state.low)} to ${percent(state.high)}${doubt})`;
  $("verdict").textContent = state.moving ? "" : state.verdict ?? "";
  $("verdict").classList.toggle("differs", $("verdict").textContent.startsWith("different"));
  $("device").textContent = state.device ?? "";
  for (const button of $("layers").children)
    button.setAttribute("aria-pressed", button.textContent === state.layer);
  for (const name of ["sampler", "estimator", "max_path_length"])
    show($(name), state[name]);
  show($("width"), state.size[0]);
  show($("height"), state.size[1]);
  if (camera)
    $("camera").value = line(camera);
  const atLines = state.faults.filter(fault => editor?.has(fault.file));
  const loose = atLines.length ? [] : state.faults;
  const places = state.spoilt ? ` They are in ${state.spoilt} pixels, in magenta.` : "";
  const rejected = state.rejected ? `${state.rejected} samples were left out: not finite, negative or too bright.${places}` : "";
  $("note").textContent = [...loose.map(fault => (fault.file ? `${fault.file}:${fault.line}: ` : "") + fault.text), rejected]
    .filter(Boolean).join("\n");
  editor?.tell(state.faults);
  editor?.look(state.revision);
  if (state.is_course)
    editor?.judge(state.course);
  path.look(state);
  chart();
}

const refusalOf = field => document.querySelector(`[data-of=${CSS.escape(field)}]`);

function ask(field, value) {
  refusalOf(field).textContent = "";
  send({[field]: value});
}

function show(input, value) {
  if (document.activeElement !== input)
    input.value = value;
}

const rounded = value => Array.isArray(value) ? value.map(rounded) : typeof value === "number" ? +value.toPrecision(9) : value;
const line = section => `"camera": ${JSON.stringify(Object.fromEntries(Object.entries(section).map(
  ([name, value]) => [name, rounded(value)])))}`;

function chart() {
  const points = state.history.filter(point => point[0] > 0 && point[1] > 0);
  const box = {left: 48, right: 252, top: 8, bottom: 100};
  if (points.length < 2) {
    $("chart").innerHTML = '<text x="130" y="60" text-anchor="middle">from 16 samples on</text>';
    return;
  }
  const times = points.map(point => Math.log10(point[0]));
  const errors = points.flatMap(point => [point[1], point[3], Math.max(point[2], point[1] / 8)]).map(Math.log10);
  const [first, last] = [Math.min(...times), Math.max(...times)];
  const [least, greatest] = [Math.min(...errors), Math.max(...errors)];
  const x = time => box.left + (box.right - box.left) * (Math.log10(time) - first) / (last - first || 1);
  const y = error => box.bottom - (box.bottom - box.top) * (Math.log10(error) - least) / (greatest - least || 1);
  const path = index => points.map(point => `${x(point[0]).toFixed(1)},${y(Math.max(point[index], 10 ** least)).toFixed(1)}`);
  const text = (words, left, top, anchor) => `<text x="${left}" y="${top}" text-anchor="${anchor}">${words}</text>`;
  const time = value => `${(10 ** value).toPrecision(2).replace(/e.*/, "")} s`;
  $("chart").innerHTML =
    `<path class="axis" d="M${box.left},${box.top}V${box.bottom}H${box.right}"/>` +
    `<path class="band" d="M${path(3).join("L")}L${path(2).reverse().join("L")}Z"/>` +
    `<path class="curve" d="M${path(1).join("L")}"/>` +
    text(percent(10 ** greatest), box.left - 4, box.top + 6, "end") + text(percent(10 ** least), box.left - 4, box.bottom, "end") +
    text(time(first), box.left, box.bottom + 14, "start") + text(time(last), box.right, box.bottom + 14, "end");
}

function askPixel() {
  const place = pointer ?? held;
  if (place && !asks && pixels) {
    asks = true;
    send({pixel: pixelOf(place, [state.width, state.height])});
  }
}

function tellPixel(pixel) {
  asks = false;
  if (pixel.radiance === undefined)
    return;
  const shown = number => number?.toPrecision(5) ?? "infinite";
  const [r, g, b] = pixel.shown;
  const layer = ["radiance", "standard error", "sample count"].includes(state.layer) ? ""
    : `${state.layer} ${pixel.layer.slice(0, state.layer === "depth" ? 1 : 3).map(shown).join(" ")}`;
  const parts = [`(${pixel.x}, ${pixel.y})`, `radiance ${pixel.radiance.map(shown).join(" ")}`,
                 `standard error ${pixel.error ? pixel.error.map(number => number.toPrecision(2)).join(" ") : "unknown"}`,
                 `sRGB ${r} ${g} ${b}`, `${pixel.samples} samples`, layer];
  $("pixel").replaceChildren(Object.assign(document.createElement("i"), {style: `background: rgb(${r} ${g} ${b})`}),
                             ...parts.filter(Boolean).map(text => Object.assign(document.createElement("span"), {textContent: text})));
  $("pixel").dataset.value = JSON.stringify(pixel);
}

function hold(place) {
  held = place;
  $("trace").hidden = !held || !camera;
  path.changes(held);
  mark();
  askPixel();
}

let drag;
let settled = 0; // frames before this time may show an older camera

function move(next) {
  camera = next;
  settled = performance.now() + 300;
  send({camera, moving: true});
  $("camera").value = line(camera);
}

// Rotations are about the middle of the picture, which stays fixed while the camera moves.
function pivoted() {
  return state.pivot && camera === state.camera && !state.moving ? turnsAbout(camera, state.pivot) : camera;
}

function watchPointers() {
  const stage = $("stage"), canvas = $("picture");
  const down = new Map();
  const middle = () => [...down.values()].reduce((sum, at) => [sum[0] + at.x / down.size, sum[1] + at.y / down.size], [0, 0]);
  const spread = () => {
    const [a, b] = [...down.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };
  const placeOf = event => {
    const box = canvas.getBoundingClientRect();
    const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    return x >= 0 && x < 1 && y >= 0 && y < 1 ? {x, y} : undefined;
  };
  const clickPixels = 4; // shorter movements are clicks
  let click;
  stage.addEventListener("pointerdown", event => {
    click = down.size ? undefined : {x: event.clientX, y: event.clientY};
    if (!camera)
      return;
    stage.setPointerCapture(event.pointerId);
    if (!down.size)
      camera = pivoted();
    down.set(event.pointerId, {x: event.clientX, y: event.clientY});
    drag = down;
  });
  stage.addEventListener("pointermove", event => {
    const box = canvas.getBoundingClientRect();
    pointer = placeOf(event);
    askPixel();
    if (click && Math.hypot(event.clientX - click.x, event.clientY - click.y) < clickPixels)
      return;
    click = undefined;
    if (!down.has(event.pointerId))
      return;
    const [before, apart] = [middle(), spread()];
    down.set(event.pointerId, {x: event.clientX, y: event.clientY});
    const after = middle();
    const [right, below] = [(after[0] - before[0]) / box.height, (after[1] - before[1]) / box.height];
    const pans = event.shiftKey || event.buttons & 6 || down.size > 1;
    let next = pans ? pan(camera, -right, below) : orbit(camera, -Math.PI * right, Math.PI * below);
    if (apart)
      next = zoom(next, apart / Math.max(spread(), 1));
    move(next);
  });
  for (const name of ["pointerup", "pointercancel"])
    stage.addEventListener(name, event => {
      if (click && name === "pointerup")
        hold(placeOf(event));
      click = undefined;
      down.delete(event.pointerId);
      if (!down.size)
        drag = undefined;
    });
  stage.addEventListener("pointerleave", () => {
    pointer = undefined;
    askPixel();
  });
  stage.addEventListener("contextmenu", event => event.preventDefault());
  stage.addEventListener("wheel", event => {
    event.preventDefault();
    if (camera)
      move(zoom(pivoted(), 2 ** (Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) / 400)));
  }, {passive: false});
}

function watchKeys() {
  const step = 0.05;
  const moves = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, #editor"))
      return;
    const way = moves[event.key];
    if (event.key === " " && event.target.tagName !== "BUTTON")
      play();
    else if (!camera)
      return;
    else if (way)
      move(event.shiftKey ? pan(pivoted(), step * way[0], step * way[1]) : orbit(pivoted(), 2 * step * way[0], 2 * step * way[1]));
    else if (event.key === "+" || event.key === "=" || event.key === "-")
      move(zoom(pivoted(), event.key === "-" ? 1.1 : 1 / 1.1));
    else if (event.key === "0")
      back();
    else
      return;
    event.preventDefault();
  });
}

const play = () => send({playing: !state.playing});
const back = () => move(state.first_camera);

function begin() {
  document.title = $("name").textContent = state.name;
  display = state.display;
  fill($("curve"), state.choices.curve, display.tonemap);
  for (const name of ["sampler", "estimator"])
    fill($(name), state.choices[name]);
  $("gamma").value = display.gamma ?? "";
  $("automatic").checked = display.exposure === "auto";
  $("exposure").value = state.stops;
  for (const layer of state.choices.layer.slice(0, state.camera ? undefined : 3))
    choice($("layers"), layer, () => send({layer}));
  const [width, height] = state.size;
  for (const part of [1, 2, 4, 8, 16])
    choice($("sizes"), part === 1 ? "full" : `1/${part}`,
           () => ask("size", [Math.max(Math.floor(width / part), 1), Math.max(Math.floor(height / part), 1)]));
  const redisplay = () => {
    const gamma = +$("gamma").value;
    display = {exposure: $("automatic").checked ? "auto" : +$("exposure").value, tonemap: $("curve").value,
               gamma: gamma >= 0.1 && gamma <= 10 ? gamma : null};
    send({display});
  };
  for (const name of ["curve", "gamma", "automatic"])
    $(name).addEventListener("input", redisplay);
  $("exposure").addEventListener("input", () => {
    $("automatic").checked = false;
    redisplay();
  });
  for (const name of ["sampler", "estimator"])
    $(name).addEventListener("input", () => send({[name]: $(name).value}));
  $("max_path_length").addEventListener("change", () => ask("max_path_length", +$("max_path_length").value));
  for (const name of ["width", "height"])
    $(name).addEventListener("change", () => ask("size", [+$("width").value, +$("height").value]));
  $("play").addEventListener("click", play);
  for (const name of ["fit", "whole"])
    $(name).addEventListener("click", () => {
      isWhole = name === "whole";
      fit();
    });
  $("back").addEventListener("click", back);
  $("copy").addEventListener("click", () => {
    $("camera").select();
    document.execCommand("copy"); // navigator.clipboard needs a secure context
  });
  $("png").addEventListener("click", () => $("picture").toBlob(blob => {
    const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: "picture.png"});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }));
  new ResizeObserver(fit).observe($("stage"));
  watchPointers();
  watchKeys();
}

function fill(select, names, chosen) {
  select.replaceChildren(...names.map(name => new Option(name, name, false, name === chosen)));
}

function choice(parent, text, act) {
  const button = Object.assign(document.createElement("button"), {textContent: text, onclick: act});
  parent.append(button);
}

async function edit(names) {
  if (!names.length || editor)
    return;
  const {Editor} = await import("./editor.js");
  $("editor").hidden = false;
  editor = new Editor(names, send);
  editor.tell(state.faults ?? []);
}

function connect() {
  socket = new WebSocket(new URL("socket", location.href).href.replace(/^http/, "ws"));
  socket.binaryType = "arraybuffer";
  socket.onopen = () => {
    asks = false;
    path.forget();
    if (display)
      send({display});
    send({list: true});
    send({next: 0});
  };
  socket.onmessage = event => {
    if (typeof event.data !== "string")
      return receive(event.data);
    const {pixel, files, opened, text, trace, refused, fields} = JSON.parse(event.data);
    if (pixel)
      tellPixel(pixel);
    else if (trace)
      path.take(trace);
    else if (files)
      edit(files);
    else if (opened)
      editor.open(opened, text);
    else if (refused)
      (fields.map(refusalOf).find(Boolean) ?? $("note")).textContent = refused;
  };
  socket.onclose = () => {
    $("progress").textContent = "pt view has ended, or cannot be reached";
    setTimeout(connect, 2000);
  };
}

connect();
