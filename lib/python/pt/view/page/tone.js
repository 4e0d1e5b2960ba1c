// The display transform of `pt tonemap`. cli/image/tone_map.cpp names the papers.

export const curves = {
  none() {},
  reinhard(c) {
    const divisor = 1 + (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
    for (let i = 0; i < 3; ++i)
      c[i] /= divisor;
  },
  aces(c) {
    for (let i = 0; i < 3; ++i)
      c[i] = c[i] * (2.51 * c[i] + 0.03) / (c[i] * (2.43 * c[i] + 0.59) + 0.14);
  },
  agx(c) {
    multiply(inset, c);
    for (let i = 0; i < 3; ++i) {
      const x = (Math.min(Math.max(Math.log2(c[i]), lowest), highest) - lowest) / (highest - lowest);
      let sum = 0;
      for (const coefficient of sigmoid)
        sum = sum * x + coefficient;
      c[i] = sum;
    }
    multiply(outset, c);
    for (let i = 0; i < 3; ++i)
      c[i] = Math.pow(Math.min(Math.max(c[i], 0), 1), 2.2);
  },
  neutral(c) {
    const start = 0.76, range = 1 - start;
    const least = Math.min(c[0], c[1], c[2]);
    const offset = least < 0.08 ? least - least * least / 0.16 : 0.04;
    for (let i = 0; i < 3; ++i)
      c[i] -= offset;
    const peak = Math.max(c[0], c[1], c[2]);
    if (peak < start)
      return;
    const newPeak = 1 - range * range / (peak + range - start);
    const white = 1 - 1 / (0.15 * (peak - newPeak) + 1);
    for (let i = 0; i < 3; ++i) {
      const scaled = c[i] * newPeak / peak;
      c[i] = scaled + white * (newPeak - scaled);
    }
  },
};

const inset = [0.842479062253094, 0.0784335999999992, 0.0792237451477643,
               0.0423282422610123, 0.878468636469772, 0.0791661274605434,
               0.0423756549057051, 0.0784336, 0.879142973793104];
const outset = [1.19687900512017, -0.0980208811401368, -0.0990297440797205,
                -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
                -0.0529716355144438, -0.0980434501171241, 1.15107367264116];
const sigmoid = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];
const lowest = -12.47393, highest = 4.026069;

function multiply(rows, c) {
  const [r, g, b] = c;
  for (let i = 0; i < 3; ++i)
    c[i] = rows[3 * i] * r + rows[3 * i + 1] * g + rows[3 * i + 2] * b;
}

function encode(light, gamma) {
  if (gamma)
    return Math.pow(light, 1 / gamma);
  return light <= 0.0031308 ? 12.92 * light : 1.055 * Math.pow(light, 1 / 2.4) - 0.055;
}

// Returns RGBA bytes. exposure: stops; gamma: 0 for the sRGB curve.
export function toBytes(radiance, {exposure, curve, gamma}) {
  const bytes = new Uint8ClampedArray(radiance.length / 3 * 4);
  const scale = 2 ** exposure, apply = curves[curve], c = [0, 0, 0];
  for (let i = 0, j = 0; i < radiance.length; i += 3, j += 4) {
    for (let k = 0; k < 3; ++k)
      c[k] = radiance[i + k] * scale;
    apply(c);
    for (let k = 0; k < 3; ++k)
      bytes[j + k] = Math.floor(encode(Math.min(Math.max(c[k], 0), 1), gamma) * 255 + 0.5);
    bytes[j + 3] = 255;
  }
  return bytes;
}

export function automaticExposure(radiance) {
  const means = [];
  for (let i = 0; i < radiance.length; i += 3) {
    const mean = (radiance[i] + radiance[i + 1] + radiance[i + 2]) / 3;
    if (mean > 0 && mean < Infinity)
      means.push(mean);
  }
  if (!means.length)
    return 0;
  let level = Infinity;
  for (let cut = 0; cut < 4; ++cut)
    level = means.reduce((sum, mean) => sum + Math.min(mean, level), 0) / means.length;
  let sum = 0, weights = 0;
  for (const mean of means) {
    const weight = mean / (mean + level / 128);
    sum += weight * Math.log2(mean);
    weights += weight;
  }
  const hundredths = 100 * (Math.log2(0.18) - sum / weights);
  return Math.min(Math.max(Math.sign(hundredths) * Math.floor(Math.abs(hundredths) + 0.5) / 100, -64), 64);
}

// Shows the first number of each pixel from black (least) to white (greatest). Infinity and NaN are black.
function toGreys(values, isNearBright) {
  let least = Infinity, greatest = -Infinity;
  for (let i = 0; i < values.length; i += 3)
    if (Number.isFinite(values[i])) {
      least = Math.min(least, values[i]);
      greatest = Math.max(greatest, values[i]);
    }
  return values.map((value, index) => {
    const number = values[index - index % 3];
    const share = greatest > least ? (number - least) / (greatest - least) : 0.5;
    return Number.isFinite(number) ? (isNearBright ? 1 - 0.9 * share : share) : 0;
  });
}

const plain = {exposure: 0, curve: "none", gamma: 1};

export function layerBytes(layer, pixels, display) {
  switch (layer) {
  case "depth":
    return toBytes(toGreys(pixels, true), plain);
  case "samples":
    return toBytes(toGreys(pixels, false), plain);
  case "normal":
    return toBytes(pixels.map(value => 0.5 + 0.5 * value), plain);
  case "albedo":
    return toBytes(pixels, {...plain, gamma: 0});
  case "standard error":
    return toBytes(pixels, {...plain, exposure: automaticExposure(pixels), gamma: 0});
  }
  return toBytes(pixels, display);
}
