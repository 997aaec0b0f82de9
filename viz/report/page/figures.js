// The figures of a panorama: how they are called, read, shown, and asked for in the filter.

function element(kind, className, text) {
  const made = document.createElement(kind);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

// A number that people read: three decimals, fewer for large ones, a power of ten for very large and
// very small ones.
function figureText(value) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  let text;
  if (size !== 0 && (size < 5e-4 || size >= 1e6)) text = value.toExponential(2);
  else text = value.toFixed(size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3);
  return text.replaceAll('-', '−');
}

// Of a part of one. What is there at all is never told as nothing.
function percentText(value) {
  if (value === null || value === undefined) return '–';
  if (value === 0) return '0\u00A0%';
  if (value < 5e-5) return '<\u00A00.01\u00A0%';
  return `${(100 * value).toFixed(value < 0.1 ? 2 : value < 1 ? 1 : 0)}\u00A0%`;
}

function kelvinText(value) {
  return value === null || value === undefined ? '–' : `${Math.round(value)} K`;
}

function sizeText(pixels) {
  return pixels ? `${pixels.width} × ${pixels.height}` : '–';
}

const kSides = ['ahead', 'ahead right', 'right', 'behind right', 'behind', 'behind left', 'left', 'ahead left'];
const kAlmostVertical = 85;  // degrees of elevation from where on a side says nothing

// Where a direction lies for one who looks at the picture's centre: an eighth of the horizon a word.
function sideText({elevation, azimuth}) {
  if (Math.abs(elevation) >= kAlmostVertical) return elevation > 0 ? 'above' : 'below';
  return kSides[(Math.round(azimuth / 45) + 8) % 8];
}

function degreesText(value) {
  return `${Math.round(value)}°`.replace('-', '−').replace('−0°', '0°');
}

function directionText(figures) {
  if (figures.elevation === undefined) return '–';
  return `${degreesText(figures.elevation)}\n${sideText(figures)}`;
}

// The same in full.
function directionSentence(figures) {
  const height = Math.round(figures.elevation);
  const side = sideText(figures);
  if (side === 'above' || side === 'below') return `straight ${side}`;
  const level = height === 0 ? 'at the horizon' : `${Math.abs(height)}° ${height > 0 ? 'above' : 'below'} the horizon`;
  return `${level}, ${side} (azimuth ${degreesText(figures.azimuth)})`;
}

// In the order of the table's columns. `title`: of the column, which a figure without one does not have;
// columns are left out where no panorama has the figure. `width` in pixels is the least; all together
// leave room for the names in a window that is 1280 wide. Titles may break, and so may what `show` gives.
const kFigures = [
  {name: 'mean', title: 'Mean', width: 66, help: 'Mean luminance of the radiance over the sphere',
   value: p => p.figures.mean, show: figureText},
  {name: 'contrast', title: 'Contrast', width: 66, help: '(max − min) / (max + min) of the irradiance',
   value: p => p.figures.contrast, show: figureText},
  {name: 'directionality', title: 'Direction\u00ADality', width: 72,
   help: 'How much of the light comes from one side: 0 evenly, 1 one point',
   value: p => p.figures.directionality, show: figureText},
  {name: 'elevation', title: 'Light from', width: 90,
   help: 'Where the dominant light is: degrees above the horizon, and the side for one who looks at the picture’s centre',
   value: p => p.figures.elevation, show: (value, p) => directionText(p.figures)},
  {name: 'azimuth', value: p => p.figures.azimuth},
  {name: 'minimum_irradiance', title: 'Least irradiance', width: 76,
   help: 'Least irradiance in any direction and channel, by the channel’s mean; below zero where the sum rings',
   value: p => p.figures.minimum_irradiance, show: figureText, bad: value => value < 0},
  {name: 'negative_fraction', title: 'Below\nzero', width: 74, help: 'Part of the sphere where the irradiance is below zero',
   value: p => p.figures.negative_fraction, show: percentText, bad: value => value > 0},
  {name: 'rms_error', title: 'RMS error', width: 60,
   help: 'Of the irradiance against the exact one, over the sphere and the channels',
   value: p => p.figures.rms_error, show: percentText},
  {name: 'max_error', title: 'Max. error', width: 60,
   help: 'Largest error of the irradiance in any direction and channel, by the channel’s mean',
   value: p => p.figures.max_error, show: percentText},
  {name: 'key_temperature', title: 'Key\ncolour', width: 70, help: 'Colour temperature of the dominant light',
   value: p => p.figures.key_temperature, show: kelvinText},
  {name: 'fill_temperature', title: 'Fill\ncolour', width: 70, help: 'Colour temperature of what is left without the dominant light',
   value: p => p.figures.fill_temperature, show: kelvinText},
  {name: 'degree', title: 'Degree', width: 56, help: 'To which the coefficients go', value: p => p.degree, show: String},
  {name: 'width', title: 'Pixels', width: 60, help: 'Of the panorama’s own picture',
   value: p => p.pixels ? p.pixels.width : null, show: (value, p) => sizeText(p.pixels).replace(' ×', '\n×')},
  {name: 'warnings', title: 'Warn\u00ADings', width: 56, value: p => p.warnings.length, show: value => value ? String(value) : '',
   bad: value => value > 0, isPresent: p => p.warnings.length > 0},
];

function hasFigure(figure, panorama) {
  return figure.isPresent ? figure.isPresent(panorama) : Number.isFinite(figure.value(panorama));
}

const kComparisons = {
  '<': (a, b) => a < b, '>': (a, b) => a > b, '<=': (a, b) => a <= b, '>=': (a, b) => a >= b,
  '=': (a, b) => a === b,
};

// The figures that a word may mean: the one of this name, else all whose names begin so.
function figuresCalled(word) {
  const exact = kFigures.filter(({name}) => name === word);
  return exact.length ? exact : kFigures.filter(({name}) => name.startsWith(word));
}

// What is wrong with FIGURE<NUMBER; empty where nothing is.
function comparisonFault(name, number, panoramas) {
  const figures = figuresCalled(name);
  const all = kFigures.map(figure => figure.name).join(', ');
  if (figures.length === 0) return `No figure is called “${name}”. There are: ${all}.`;
  if (figures.length > 1) return `“${name}” may be ${figures.map(figure => figure.name).join(' or ')}.`;
  if (!Number.isFinite(number)) return `${figures[0].name} is compared with a number, such as ${figures[0].name}>0.5.`;
  if (!panoramas.some(p => Number.isFinite(figures[0].value(p)))) {
    const errors = figures[0].name.endsWith('_error') ? ' “quality:” in the manifest makes it.' : '';
    return `No panorama here has the figure ${figures[0].name}.${errors}`;
  }
  return '';
}

function textTest(word) {
  return p => [p.name, p.variant, ...p.tags].some(part => part.toLowerCase().includes(word));
}

function readComparison([, name, sign, digits], panoramas) {
  const [, part, percent] = /^(.*?)(%?)$/.exec(digits);
  const number = part === '' ? NaN : Number(part) / (percent ? 100 : 1);
  const fault = comparisonFault(name, number, panoramas);
  if (fault) return {fault};
  const [figure] = figuresCalled(name);
  return {test: p => Number.isFinite(figure.value(p)) && kComparisons[sign](figure.value(p), number)};
}

// A filter's words as tests of a panorama, and what to tell of those that say nothing. A word is
// FIGURE<NUMBER and the like, the number with % for parts of a hundred; tag:TAG; or text that the name,
// the variant or a tag holds.
function readFilter(text, panoramas) {
  const tests = [], faults = [];
  for (const word of text.toLowerCase().split(/\s+/).filter(Boolean)) {
    const comparison = /^([a-z_]+)(<=|>=|<|>|=)([^<>=]*)$/.exec(word);
    const {test, fault} = comparison ? readComparison(comparison, panoramas) : {};
    if (test) tests.push(test);
    else if (word.startsWith('tag:')) tests.push(p => p.tags.some(tag => tag.toLowerCase() === word.slice(4)));
    else if (!fault || panoramas.some(textTest(word))) tests.push(textTest(word));
    else faults.push(fault);
  }
  return {tests, faults};
}
