'use strict';
// The real spherical harmonics of shoal: orthonormal, without the Condon-Shortley phase, index
// l(l+1)+m, polar axis +z; Y_lm = Pbar_l|m|(cos theta) times cos(m phi), or sin(|m| phi) for m < 0.

function coefficientCount(degree) {
  return (degree + 1) * (degree + 1);
}

function coefficientIndex(l, m) {
  return l * (l + 1) + m;
}

function legendreIndex(l, m) {
  return l * (l + 1) / 2 + m;
}

// The normalised associated Legendre functions by the recurrence in l at fixed m, which is stable
// upwards; the constants once for a degree.
class Legendre {
  constructor(degree) {
    this.degree = degree;
    const count = legendreIndex(degree + 1, 0);
    this.near = new Float64Array(count);
    this.far = new Float64Array(count);
    this.sectoral = new Float64Array(degree + 1);
    for (let m = 0; m <= degree; ++m) {
      // sqrt(3) holds the sqrt(2) of all m != 0.
      this.sectoral[m] = m === 1 ? Math.sqrt(3) : Math.sqrt((2 * m + 1) / (2 * m));
      for (let l = m + 1; l <= degree; ++l) {
        const below = l * l - m * m;
        this.near[legendreIndex(l, m)] = Math.sqrt((4 * l * l - 1) / below);
        this.far[legendreIndex(l, m)] =
            l < m + 2 ? 0 : Math.sqrt((2 * l + 1) * ((l - 1) * (l - 1) - m * m) / ((2 * l - 3) * below));
      }
    }
  }

  // values[legendreIndex(l, m)], 0 <= m <= l <= degree.
  evaluate(cosTheta, sinTheta, values) {
    let start = Math.sqrt(1 / (4 * Math.PI));
    for (let m = 0; m <= this.degree; ++m) {
      if (m > 0) start *= this.sectoral[m] * sinTheta;
      let twoBelow = 0;
      let below = start;
      values[legendreIndex(m, m)] = start;
      for (let l = m + 1; l <= this.degree; ++l) {
        const i = legendreIndex(l, m);
        const value = this.near[i] * cosTheta * below - this.far[i] * twoBelow;
        values[i] = value;
        twoBelow = below;
        below = value;
      }
    }
    return values;
  }
}

// Y_lm at a unit direction, in index order.
function basisValues(degree, [x, y, z]) {
  const sinTheta = Math.hypot(x, y);
  const phi = Math.atan2(y, x);
  const pbar = new Legendre(degree).evaluate(z, sinTheta, new Float64Array(legendreIndex(degree + 1, 0)));
  const values = new Float64Array(coefficientCount(degree));
  for (let l = 0; l <= degree; ++l) {
    values[coefficientIndex(l, 0)] = pbar[legendreIndex(l, 0)];
    for (let m = 1; m <= l; ++m) {
      values[coefficientIndex(l, m)] = pbar[legendreIndex(l, m)] * Math.cos(m * phi);
      values[coefficientIndex(l, -m)] = pbar[legendreIndex(l, m)] * Math.sin(m * phi);
    }
  }
  return values;
}

// A_l of the clamped cosine: pi, 2 pi/3, pi/4, 0, -pi/24 ...
function clampedCosineGain(l) {
  if (l === 1) return 2 * Math.PI / 3;
  if (l % 2 === 1) return 0;
  let gain = 2 / ((l + 2) * (l - 1));
  for (let k = 1; k <= l / 2; ++k) gain *= -(2 * k - 1) / (2 * k);
  return -Math.PI * gain;
}

// sum of c_lm Y_lm to `degree` where the circles of theta meet those of phi. `channels` are arrays in
// index order; the values come as (thetas, phis, channels), channels fastest.
function synthesise(channels, degree, thetas, phis) {
  const legendre = new Legendre(degree);
  const pbar = new Float64Array(legendreIndex(degree + 1, 0));
  const orders = degree + 1;
  const cosines = phis.map(phi => Float64Array.from({length: orders}, (_, m) => Math.cos(m * phi)));
  const sines = phis.map(phi => Float64Array.from({length: orders}, (_, m) => Math.sin(m * phi)));
  const values = new Float32Array(thetas.length * phis.length * channels.length);
  const even = new Float64Array(orders);
  const odd = new Float64Array(orders);
  thetas.forEach((theta, row) => {
    legendre.evaluate(Math.cos(theta), Math.sin(theta), pbar);
    channels.forEach((channel, c) => {
      for (let m = 0; m <= degree; ++m) {
        even[m] = odd[m] = 0;
        for (let l = m; l <= degree; ++l) {
          const p = pbar[legendreIndex(l, m)];
          even[m] += p * channel[coefficientIndex(l, m)];
          if (m > 0) odd[m] += p * channel[coefficientIndex(l, -m)];
        }
      }
      for (let column = 0; column < phis.length; ++column) {
        let value = even[0];
        for (let m = 1; m <= degree; ++m) {
          value += even[m] * cosines[column][m] + odd[m] * sines[column][m];
        }
        values[(row * phis.length + column) * channels.length + c] = value;
      }
    });
  });
  return values;
}

// Texel centres of an equirect picture of `rows` rows.
function texelAngles(rows) {
  return {
    thetas: Array.from({length: rows}, (_, i) => Math.PI * (i + 0.5) / rows),
    phis: Array.from({length: 2 * rows}, (_, i) => Math.PI * (i + 0.5) / rows),
  };
}

