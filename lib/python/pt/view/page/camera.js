// Camera movements by mouse, fingers and keys. A camera is a section of a scene file. Each function returns a new camera.

const add = (a, b, scale = 1) => a.map((value, i) => value + scale * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => a.map(value => value / Math.hypot(...a));

function axes(camera) {
  const forward = unit(add(camera.look_at, camera.position, -1));
  const right = unit(cross(forward, camera.up));
  return [right, cross(right, forward), forward];
}

// Moves look_at, the center of rotation, to this depth. The focus of a lens stays.
export function turnsAbout(camera, depth) {
  const forward = axes(camera)[2];
  const moved = {...camera, look_at: add(camera.position, forward, depth)};
  if (camera.aperture && !camera.focus)
    moved.focus = Math.hypot(...add(camera.look_at, camera.position, -1));
  return moved;
}

// Turns to the right about `up`, and upwards, but not over the poles.
export function orbit(camera, toRight, upwards) {
  const up = unit(camera.up);
  const back = add(camera.position, camera.look_at, -1), distance = Math.hypot(...back);
  const level = unit(cross(up, back));
  const ahead = cross(level, up);
  const height = Math.asin(Math.min(Math.max(dot(back, up) / distance, -1), 1));
  const limit = Math.PI / 2 - 0.01;
  const angle = Math.min(Math.max(height + upwards, -limit), limit);
  const flat = add(ahead.map(value => value * Math.cos(toRight)), level, Math.sin(toRight));
  const offset = add(flat.map(value => value * Math.cos(angle)), up, Math.sin(angle));
  return {...camera, position: add(camera.look_at, offset, distance)};
}

export function pan(camera, toRight, upwards) {
  const [right, above] = axes(camera);
  const distance = Math.hypot(...add(camera.look_at, camera.position, -1));
  const extent = camera.vertical_extent ?? 2 * distance * Math.tan((camera.vertical_fov ?? 45) * Math.PI / 360);
  const way = add(right.map(value => value * toRight * extent), above, upwards * extent);
  return {...camera, position: add(camera.position, way), look_at: add(camera.look_at, way)};
}

// A factor below 1 moves closer.
export function zoom(camera, factor) {
  if (camera.vertical_extent)
    return {...camera, vertical_extent: camera.vertical_extent * factor};
  return {...camera, position: add(camera.look_at, add(camera.position, camera.look_at, -1), factor)};
}
