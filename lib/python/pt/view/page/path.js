// The path of one sample: a list of its vertices, and lines over the picture.

const $ = id => document.getElementById(id);
const shown = numbers => numbers.map(number => number == null ? "not finite" : +number.toPrecision(5)).join(" ");

export class PathView {
  constructor(request, redraw) {
    this.request = request;
    this.redraw = redraw;
    $("trace").addEventListener("click", () => {
      $("path").hidden = false;
      this.ask();
    });
    $("untrace").addEventListener("click", () => this.changes(undefined));
    $("sample").addEventListener("input", () => this.ask());
  }

  get sample() {
    return +$("sample").value;
  }

  ask() {
    this.seen = this.picture;
    this.request();
  }

  // Called when another or no pixel is held.
  changes(held) {
    this.trace = undefined;
    $("path").hidden ||= !held;
    if (!$("path").hidden)
      this.ask();
    this.redraw();
  }

  // Traces again once scene, camera, method or kernels have changed.
  look(state) {
    this.picture = JSON.stringify([state.camera, state.size, state.sampler, state.estimator, state.max_path_length, state.revision]);
    if (!$("path").hidden && this.seen !== this.picture && !state.moving)
      this.ask();
  }

  forget() {
    this.seen = undefined;
  }

  take(trace) {
    this.trace = trace;
    $("found").textContent = `radiance ${shown(trace.radiance)}${trace.is_whole ? "" : "; the picture is too small for the whole path"}`;
    $("vertices").replaceChildren(...trace.vertices.map(vertex => row(
      `${vertex.number}`, {position: vertex.position, throughput: vertex.throughput, numbers: vertex.numbers})),
      ...trace.numbers.length ? [row("then", {numbers: trace.numbers})] : []);
    this.redraw();
  }

  // unit is the size of a screen pixel in pixels of the picture.
  drawn(width, height, unit) {
    if (!this.trace || $("path").hidden || this.seen !== this.picture)
      return "";
    const at = (x, y) => `${(x * width).toFixed(2)},${(y * height).toFixed(2)}`;
    const lines = this.trace.lines.map(([a, b, c, d]) => `M${at(a, b)}L${at(c, d)}`).join("");
    const places = this.trace.vertices.filter(vertex => vertex.place);
    return `<path class="under" d="${lines}"/><path d="${lines}"/>` + places.map(({number, place: [x, y]}) =>
      `<circle cx="${x * width}" cy="${y * height}" r="${3 * unit}"/>`
      + `<text x="${x * width + 6 * unit}" y="${y * height - 5 * unit}" font-size="${13 * unit}">${number}</text>`).join("");
  }
}

function row(title, facts) {
  const item = document.createElement("li");
  item.append(title);
  for (const [name, numbers] of Object.entries(facts).filter(fact => fact[1].length)) {
    const line = document.createElement("div"), value = Object.assign(document.createElement("b"), {textContent: shown(numbers)});
    line.append(`${name} `, value);
    item.append(line);
  }
  return item;
}
