// Light as arrays of numbers: decoded, measured, painted.

const kLuminance = [0.2126, 0.7152, 0.0722];

function bytesOfBase64(text) {
  return Uint8Array.from(atob(text), character => character.charCodeAt(0));
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Linear RGB of planes R, G, B, E whose bytes are differences to their left neighbours (the first
// column's to the one above).
async function decodedPicture(base64, width, height) {
  const planes = await inflated(bytesOfBase64(base64));
  for (let i = 1; i < planes.length; ++i) {
    const step = i % width === 0 ? width : 1;
    if (i >= step) planes[i] += planes[i - step];
  }
  const count = width * height;
  const rgb = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const scale = planes[3 * count + i] === 0 ? 0 : 2 ** (planes[3 * count + i] - 136);
    for (let c = 0; c < 3; ++c) rgb[3 * i + c] = planes[c * count + i] * scale;
  }
  return {width, height, rgb};
}

// Three channels in index order from little-endian doubles, r g b of every coefficient.
function decodedCoefficients(base64) {
  const bytes = bytesOfBase64(base64);
  const view = new DataView(bytes.buffer);
  const count = bytes.length / 24;
  return [0, 1, 2].map(c => Float64Array.from({length: count}, (_, i) => view.getFloat64(8 * (3 * i + c), true)));
}

function withGains(channels, gainOf) {
  return channels.map(channel => {
    const out = Float64Array.from(channel);
    for (let l = 0; coefficientIndex(l, 0) < out.length; ++l) {
      for (let m = -l; m <= l; ++m) out[coefficientIndex(l, m)] *= gainOf(l);
    }
    return out;
  });
}

function irradianceOf(radiance) {
  return withGains(radiance, clampedCosineGain);
}

function degreeOf(channels) {
  return Math.round(Math.sqrt(channels[0].length)) - 1;
}

// An equirect picture of the function to a degree.
function synthesisedPicture(channels, degree, height) {
  const {thetas, phis} = texelAngles(height);
  return {width: 2 * height, height, rgb: synthesise(channels, degree, thetas, phis)};
}

// Sums of squares of the coefficients over the channels, a degree each.
function energies(channels) {
  return Array.from({length: degreeOf(channels) + 1}, (_, l) => {
    const parts = channels.map(channel => channel.subarray(coefficientIndex(l, -l), coefficientIndex(l, l) + 1));
    return parts.reduce((sum, part) => part.reduce((total, value) => total + value * value, sum), 0);
  });
}

// Eight-bit sRGB of linear values in [0, 1] by a table of 4096 steps; it errs by 0.84 at most.
const kSrgb = Uint8Array.from({length: 4097}, (_, i) => {
  const v = i / 4096;
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
});

function srgbByte(linear) {
  return kSrgb[Math.max(0, Math.min(4096, Math.round(4096 * linear)))];
}

// Where the light is negative there is nothing to show: such texels get blue stripes.
const kNegativeStripe = [38, 84, 160];

function paint(canvas, picture, exposure) {
  const {width, height, rgb} = picture;
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  const image = context.createImageData(width, height);
  const stripe = Math.max(4, width >> 5);
  for (let i = 0; i < width * height; ++i) {
    const r = rgb[3 * i], g = rgb[3 * i + 1], b = rgb[3 * i + 2];
    const isNegative = kLuminance[0] * r + kLuminance[1] * g + kLuminance[2] * b < 0;
    if (isNegative && (i % width + Math.floor(i / width)) % stripe < stripe / 2) {
      image.data.set(kNegativeStripe, 4 * i);
    } else {
      image.data[4 * i] = srgbByte(exposure * r);
      image.data[4 * i + 1] = srgbByte(exposure * g);
      image.data[4 * i + 2] = srgbByte(exposure * b);
    }
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

// A white ball in the panorama's middle as one sees it who looks at the picture's centre. `factors`
// are of the polynomials 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2, native frame, as many as there are.
function paintBall(canvas, factors, exposure) {
  const size = canvas.width;
  const context = canvas.getContext('2d');
  const image = context.createImageData(size, size);
  const weights = Array.from({length: 9}, (_, k) => (factors[k] ?? [0, 0, 0]).map(f => exposure * f));
  const [one, fy, fz, fx, fxy, fyz, fzz, fxz, fxx] = weights;
  const at = (c, x, y, z) => one[c] + fy[c] * y + fz[c] * z + fx[c] * x + fxy[c] * x * y + fyz[c] * y * z +
      fzz[c] * (3 * z * z - 1) + fxz[c] * x * z + fxx[c] * (x * x - y * y);
  for (let i = 0; i < size * size; ++i) {
    const u = (2 * (i % size) + 1) / size - 1, v = 1 - (2 * Math.floor(i / size) + 1) / size;
    const distance = Math.sqrt(u * u + v * v);
    if (distance >= 1) continue;
    const x = Math.sqrt(1 - distance * distance);
    for (let c = 0; c < 3; ++c) image.data[4 * i + c] = srgbByte(at(c, x, -u, v));
    image.data[4 * i + 3] = 255 * Math.min(1, (1 - distance) * size / 2);
  }
  context.putImageData(image, 0, 0);
}

