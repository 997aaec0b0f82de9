// Coefficients as text to copy. Numbers are the texts that shoal wrote, digit for digit.
//
// A record is {title, name, variant, quantity, degree, frame, texts}: texts[3 i + c] is channel c of
// coefficient i; `title` is for people, name and variant are the tables'.

function csvQuoted(text) {
  return /[",\r\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
}

function forEachCoefficient(degree, take) {
  for (let l = 0; l <= degree; ++l) {
    for (let m = -l; m <= l; ++m) take(l, m, coefficientIndex(l, m));
  }
}

// As `shoal run` writes tables: panorama,variant,quantity,l,m,r,g,b.
function csvText({name, variant, quantity, degree, texts}) {
  const names = [name, variant, quantity].map(csvQuoted).join(',');
  let out = 'panorama,variant,quantity,l,m,r,g,b\n';
  forEachCoefficient(degree, (l, m, i) => {
    out += [names, l, m, ...texts.slice(3 * i, 3 * i + 3)].join(',') + '\n';
  });
  return out;
}

// Readers take -0 for an integer.
function jsonNumber(text) {
  return text === '-0' ? '-0.0' : text;
}

// One record of shoal's JSON tables.
function jsonText({name, variant, quantity, degree, frame, texts}) {
  const rows = [];
  forEachCoefficient(degree, (l, m, i) => {
    rows.push('  [' + texts.slice(3 * i, 3 * i + 3).map(jsonNumber).join(', ') + ']');
  });
  const head = [['panorama', name], ['variant', variant], ['quantity', quantity], ['frame', frame]]
      .map(([key, value]) => JSON.stringify(key) + ': ' + JSON.stringify(value));
  return `{${head.join(', ')}, "degree": ${degree}, "coefficients": [\n${rows.join(',\n')}\n]}\n`;
}

// The polynomials whose sum, weighted by the coefficients, is the function (Ramamoorthi & Hanrahan
// 2001).
const kGlslBasis = [
  '0.28209479177387814', '0.48860251190291992 * n.y', '0.48860251190291992 * n.z',
  '0.48860251190291992 * n.x', '1.0925484305920792 * n.x * n.y', '1.0925484305920792 * n.y * n.z',
  '0.31539156525252005 * (3.0 * n.z * n.z - 1.0)', '1.0925484305920792 * n.x * n.z',
  '0.54627421529603959 * (n.x * n.x - n.y * n.y)',
];

// What may stand in a comment of GLSL: printable ASCII without the backslash, which continues lines.
function glslComment(text) {
  return text.replace(/[^ -[\]-~]/g, '?');
}

// A function of a unit vector in the frame, for GLSL 3.30 and GLSL ES 3.00, from irradiance to degree 2.
function glslText({title, degree, frame, texts}) {
  const shown = Math.min(degree, 2);
  const rows = [];
  const terms = [];
  forEachCoefficient(shown, (l, m, i) => {
    rows.push(`  vec3(${texts.slice(3 * i, 3 * i + 3).join(', ')})`);
    terms.push(`shoal_E[${i}] * (${kGlslBasis[i]})`);
  });
  return `// Irradiance of ${glslComment(title)}, degree ${shown}, linear Rec.709; divide by pi
// for the light that leaves a white diffuse surface. n is the unit normal in the frame
// ${frame}: the axes along which the panorama's centre, right and up lie.
const vec3 shoal_E[${rows.length}] = vec3[${rows.length}](
${rows.join(',\n')});

vec3 shoal_irradiance(vec3 n) {
  return ${terms.join('\n       + ')};
}
`;
}

